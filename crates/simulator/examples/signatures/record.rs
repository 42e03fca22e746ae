use std::path::Path;

use document::Document;
use logs::{Channels, Run};
use nalgebra::Complex;
use robot::Robot;
use simulator::effects::EffectSpec;
use simulator::scenario::{Scenario, ScenarioSpec, SensorSpec};
use simulator::{EffortSource, VelocitySource};

/// What keeps a scenario from being drawn.
pub type Unusable = Box<dyn std::error::Error + Send + Sync>;

/// Time at constant speed before a sample counts (s): until then the arm still swings.
const SETTLED_S: f64 = 0.5;

/// One run of a scenario with its effect and without, under the same controller.
pub struct Record {
    pub effect: EffectSpec,
    pub robot: Robot,
    pub with: Run,
    pub without: Run,
}

impl Record {
    /// Simulates the scenario of an effect: effort is the motor's, nothing is rounded or noisy.
    pub fn of(folder: &Path, name: &str) -> Result<Self, Unusable> {
        let written =
            Scenario::from_document(&Document::read(folder.join(format!("{name}.toml")))?)?;
        let mut spec: ScenarioSpec = toml::from_str(written.self_contained_text())?;
        spec.sensors = SensorSpec {
            effort: EffortSource::Motor,
            velocity: VelocitySource::Ideal,
            log_rate_hz: spec.sensors.log_rate_hz,
            ..SensorSpec::default()
        };
        let is_shown = |effect: &EffectSpec| effect.kind().name() == name;
        let shown = spec.effect.iter().find(|effect| is_shown(effect)).cloned();
        let with = first_run(&spec)?;
        spec.effect.retain(|effect| !is_shown(effect));
        let without = first_run(&spec)?;
        let effect = shown.ok_or_else(|| format!("{name}.toml does not put {name} in"))?;
        Ok(Self { effect, robot: written.robot().clone(), with, without })
    }

    /// The index of a joint that the effect names, or else carries the link that it names.
    pub fn joint(&self, name: &str) -> usize {
        let links = self.robot.links();
        links.iter().position(|l| l.joint.name == name || l.name == name).unwrap_or_default()
    }

    /// Rows in which every joint has gone at constant speed for a while.
    pub fn steady(&self) -> Vec<usize> {
        let mut since = 0.0;
        let mut rows = Vec::new();
        for row in 0..self.rows() {
            let of = |channel: &Option<Vec<f64>>| channel.as_ref().map_or(0.0, |c| c[row]);
            let joints = &self.with.joints;
            let turns = joints.iter().any(|j| of(&j.desired_acceleration).abs() > 1e-9);
            let rests = joints.iter().all(|j| of(&j.desired_velocity).abs() < 1e-9);
            if turns || rests {
                since = self.with.time[row];
            } else if self.with.time[row] - since > SETTLED_S {
                rows.push(row);
            }
        }
        rows
    }

    pub fn rows(&self) -> usize {
        self.with.time.len().min(self.without.time.len())
    }

    /// Effort with the effect less that without (N m).
    pub fn added(&self, joint: usize) -> Vec<f64> {
        let pairs = self.with.joints[joint].effort.iter().zip(&self.without.joints[joint].effort);
        pairs.map(|(with, without)| with - without).collect()
    }
}

fn first_run(spec: &ScenarioSpec) -> Result<Run, Unusable> {
    let document = Document::from_text("scenario", &toml::to_string(spec)?)?;
    let scenario = Scenario::from_document(&document)?;
    let simulation = simulator::simulate(&scenario, &|| {})?;
    simulation.runs.into_iter().next().ok_or_else(|| "no run".into())
}

/// Velocity as measured (rad/s).
pub fn velocity(joint: &Channels) -> &[f64] {
    joint.velocity.as_deref().unwrap_or_default()
}

/// Derivative by time of a signal, by central differences.
pub fn rate(time: &[f64], signal: &[f64]) -> Vec<f64> {
    let last = signal.len().saturating_sub(1);
    let of = |i: usize| {
        let (a, b) = (i.saturating_sub(1), (i + 1).min(last));
        (signal[b] - signal[a]) / (time[b] - time[a])
    };
    (0..signal.len()).map(of).collect()
}

/// The Fourier integral of a signal that ends where it begins, which is exact for how a linear
/// system answers: the chirp starts and stops at rest.
pub fn spectrum(time: &[f64], signal: &[f64], hz: f64) -> Complex<f64> {
    let start = signal.first().copied().unwrap_or_default();
    let turn = |t: f64| Complex::from_polar(1.0, -std::f64::consts::TAU * hz * t);
    time.iter().zip(signal).map(|(&t, x)| turn(t) * (x - start)).sum()
}

/// Frequencies from 2 to 45 Hz in equal ratios, within the band of the chirp.
pub fn frequencies() -> Vec<f64> {
    let count = 90;
    (0..=count).map(|k| 2.0 * 22.5_f64.powf(f64::from(k) / f64::from(count))).collect()
}
