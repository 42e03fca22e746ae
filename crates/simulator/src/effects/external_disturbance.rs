use std::f64::consts::TAU;

use catalogue::EffectKind;
use nalgebra::Vector3;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use robot::Robot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::effects::mistake::{Mistake, joint_of, link_of, within};
use crate::effects::scenario_effect::ScenarioEffect;
use crate::effects::surroundings::Surroundings;
use crate::effects::truth::Truth;
use crate::mechanics::inject::{Efforts, Inject, Moment};

/// What the world around does to the arm, whatever the arm does.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum ExternalDisturbance {
    /// A torque on a link, such as from a pump or the mains:
    ///
    /// ```text
    /// torque = amplitude sin(2 pi frequency t + phase)
    /// ```
    Periodic {
        /// The joint.
        joint: String,
        /// Amplitude (N m; N for a prismatic joint), 0 to 1000.
        amplitude_nm: f64,
        /// Frequency (Hz), 0.001 to 1000.
        frequency_hz: f64,
        /// Phase at the start of the log (rad), -2 pi to 2 pi.
        #[serde(default)]
        phase_rad: f64,
    },
    /// A force on a link at its origin, for a while:
    ///
    /// ```text
    /// torque = J^T force  for start <= t < start + duration
    /// ```
    Push {
        /// The link.
        link: String,
        /// Force (N), in the frame of the base, up to 1e4 along each axis.
        force_n: [f64; 3],
        /// Time from the start of the log to the push (s), 0 to 1e6.
        start_s: f64,
        /// How long it lasts (s), 0 to 1e6.
        duration_s: f64,
    },
}

impl ScenarioEffect for ExternalDisturbance {
    const KIND: EffectKind = EffectKind::ExternalDisturbance;

    fn truth(&self) -> Truth {
        match self {
            Self::Periodic { joint, amplitude_nm, frequency_hz, phase_rad } => {
                let parameters = [
                    ("amplitude", *amplitude_nm),
                    ("frequency", *frequency_hz),
                    ("phase", *phase_rad),
                ];
                Truth::at_joint(Self::KIND, joint, &parameters)
            }
            Self::Push { link, force_n: [x, y, z], start_s, duration_s } => {
                let parameters = [
                    ("force_x", *x),
                    ("force_y", *y),
                    ("force_z", *z),
                    ("start", *start_s),
                    ("duration", *duration_s),
                ];
                Truth::at_link(Self::KIND, link, &parameters)
            }
        }
    }

    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        match *self {
            Self::Periodic { ref joint, amplitude_nm, frequency_hz, phase_rad } => {
                let joint =
                    joint_of(robot, joint).map_err(|m| Mistake { key: "periodic.joint", ..m })?;
                within("periodic.amplitude_nm", amplitude_nm, 0.0, 1000.0)?;
                within("periodic.frequency_hz", frequency_hz, 0.001, 1000.0)?;
                within("periodic.phase_rad", phase_rad, -TAU, TAU)?;
                let omega = TAU * frequency_hz;
                Ok(Box::new(Periodic { joint, amplitude: amplitude_nm, omega, phase: phase_rad }))
            }
            Self::Push { ref link, force_n, start_s, duration_s } => {
                let link = link_of(robot, link).map_err(|m| Mistake { key: "push.link", ..m })?;
                for f in force_n {
                    within("push.force_n", f, -1e4, 1e4)?;
                }
                within("push.start_s", start_s, 0.0, 1e6)?;
                within("push.duration_s", duration_s, 0.0, 1e6)?;
                let end_s = start_s + duration_s;
                let force = Vector3::from(force_n);
                Ok(Box::new(Push { link, force, start_s, end_s, first: true }))
            }
        }
    }

    /// The periodic one, of a frequency from 0.5 to 20 Hz.
    fn draw(at: &Surroundings<'_>, share: f64, random: &mut ChaCha8Rng) -> Self {
        Self::Periodic {
            joint: at.joint_name(),
            amplitude_nm: (2.0_f64.sqrt() * share * at.torque_rms).min(1000.0),
            frequency_hz: 0.5 * 40.0_f64.powf(random.random_range(0.0..1.0)),
            phase_rad: random.random_range(-0.5 * TAU..0.5 * TAU),
        }
    }
}

struct Periodic {
    joint: usize,
    amplitude: f64,
    omega: f64,
    phase: f64,
}

impl Inject for Periodic {
    fn on_substep(&mut self, moment: &Moment<'_>, efforts: &mut Efforts) {
        efforts.link[self.joint] +=
            self.amplitude * (self.omega * moment.time_s + self.phase).sin();
    }
}

struct Push {
    link: usize,
    force: Vector3<f64>,
    start_s: f64,
    end_s: f64,
    /// No step has been taken yet.
    first: bool,
}

impl Inject for Push {
    fn on_start(&mut self, _: &[f64]) {
        self.first = true;
    }

    /// The mean from half a step before to half a step after (at the start from the start), so
    /// that the impulse is whole whatever the times.
    fn on_substep(&mut self, moment: &Moment<'_>, efforts: &mut Efforts) {
        let half = 0.5 * moment.step_s;
        let from = if self.first { moment.time_s } else { moment.time_s - half };
        let to = moment.time_s + half;
        self.first = false;
        let pushed = to.min(self.end_s) - from.max(self.start_s);
        if pushed > 0.0 {
            efforts.push(self.link, self.force * (pushed / (to - from)), Vector3::zeros());
        }
    }
}
