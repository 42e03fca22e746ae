use catalogue::EffectKind;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;

use crate::effects::spec::EffectSpec;
use crate::effects::surroundings::{JointLevel, Surroundings};
use crate::error::SimulatorError;
use crate::run::follow::{ArmCauses, ControlRow, Following, follow, simulator};
use crate::scenario::check::{Scenario, ScenarioRun};
use crate::scenario::spec::HiddenSpec;
use crate::sensors::{JointSensor, Sensors};
use crate::simulator::Simulator;
use crate::strangers::kind::StrangerKind;
use crate::strangers::spec::StrangerSpec;

/// Longest part of the first run on which sizes are measured (s).
const MEASURED_S: f64 = 10.0;

/// Draws of one effect before giving up.
const TRIES: usize = 40;

/// Sizes tried for one effect. Most torques are proportional to the size, a few are almost a step.
const CORRECTIONS: usize = 8;

/// Tolerance of the logarithm of the size.
const TOLERANCE: f64 = 0.1;

/// Sizes effects and strangers on the first 10 s of a scenario's first run, simulated without noise and
/// without hidden effects.
pub struct EffectSizer<'a> {
    scenario: &'a Scenario,
    run: ScenarioRun,
    nominal: Vec<ControlRow>,
    /// Torque and speed of each joint; the torque includes the noise of its sensor.
    levels: Vec<JointLevel>,
    /// Apparent inertia of each joint at the start of the run (kg m² or kg).
    inertia: Vec<f64>,
}

impl<'a> EffectSizer<'a> {
    /// Simulates the run with the effects and strangers that the scenario states.
    ///
    /// # Errors
    ///
    /// [`SimulatorError`] when the arm cannot be simulated.
    pub fn new(scenario: &'a Scenario) -> Result<Self, SimulatorError> {
        Self::on(scenario, 0)
    }

    /// The same on the first 10 s of another run.
    ///
    /// # Errors
    ///
    /// As [`new`](Self::new).
    ///
    /// # Panics
    ///
    /// When the scenario has no run of this index.
    pub fn on(scenario: &'a Scenario, run: usize) -> Result<Self, SimulatorError> {
        let run = scenario.runs()[run].clone();
        let (nominal, levels, inertia) = (Vec::new(), Vec::new(), Vec::new());
        let mut bench = Self { scenario, run, nominal, levels, inertia };
        bench.nominal = bench.rows(&[])?;
        let mut simulator = bench.simulator(&[])?;
        simulator.start(&bench.run.motion.at(0.0).q);
        bench.inertia = simulator.inertia();
        let noise = &scenario.spec().sensors.effort_noise_nm;
        let level = |(j, name): (usize, &str)| {
            let torque = rms(bench.nominal.iter().map(|r| r.reading.effort[j]));
            let torque_rms = torque.hypot(noise.get(name).copied().unwrap_or(0.0));
            let speed_rms = rms(bench.nominal.iter().map(|r| r.reference.qd[j]));
            JointLevel { torque_rms, speed_rms }
        };
        bench.levels = scenario.robot().joint_names().enumerate().map(level).collect();
        Ok(bench)
    }

    /// An effect at a joint whose torque is about `share` of the joint's. The size is the estimate of
    /// [`ScenarioEffect::draw`](crate::effects::ScenarioEffect::draw), not checked by simulation.
    ///
    /// # Panics
    ///
    /// When the arm has no joint of this index.
    pub fn effect(&self, kind: EffectKind, joint: usize, share: f64, seed: u64) -> EffectSpec {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        EffectSpec::draw(kind, &self.surroundings(joint), share, &mut random)
    }

    /// A stranger at a joint, sized as in [`effect`](Self::effect).
    ///
    /// # Panics
    ///
    /// When the arm has no joint of this index.
    pub fn stranger(
        &self,
        kind: StrangerKind,
        joint: usize,
        share: f64,
        seed: u64,
    ) -> StrangerSpec {
        let mut random = ChaCha8Rng::seed_from_u64(seed);
        StrangerSpec::draw(kind, &self.surroundings(joint), share, &mut random)
    }

    /// Torque and speed of every joint.
    pub fn levels(&self) -> &[JointLevel] {
        &self.levels
    }

    /// The arm with the scenario's effects and `more`, with noise-free sensors.
    fn simulator(&self, more: &[EffectSpec]) -> Result<Simulator, SimulatorError> {
        let scenario = self.scenario;
        let effects = [scenario.effects(), more].concat();
        let joints = scenario.robot().joint_count();
        let silent = JointSensor { resolution: 0.0, position_noise: 0.0, effort_noise: 0.0 };
        let seen = &scenario.spec().sensors;
        let silent = vec![silent; joints];
        let sensors = Sensors::new(seen.position, seen.effort, seen.velocity, silent, 0);
        let causes = ArmCauses { effects: &effects, strangers: scenario.strangers() };
        simulator(scenario.robot(), causes, sensors, scenario.stepping())
    }

    /// The run with the scenario's effects and `more`.
    fn rows(&self, more: &[EffectSpec]) -> Result<Vec<ControlRow>, SimulatorError> {
        let scenario = self.scenario;
        let mut simulator = self.simulator(more)?;
        let (gains, robot) = (scenario.gains(), scenario.robot());
        let servo = scenario.spec().control.servo;
        let following = Following { gains, robot, run: &self.run, servo, longest_s: MEASURED_S };
        follow(&mut simulator, &following, &|| {})
            .map_err(|fault| SimulatorError::Fault { run: self.run.name.clone(), fault })
    }

    /// Share of torque that an effect adds; `None` if the arm runs away.
    fn share(&self, effect: &EffectSpec) -> Option<f64> {
        let rows = self.rows(std::slice::from_ref(effect)).ok()?;
        let added = |j: usize| {
            let pairs = rows.iter().zip(&self.nominal);
            rms(pairs.map(|(with, without)| with.reading.effort[j] - without.reading.effort[j]))
        };
        let robot = self.scenario.robot();
        let own = effect.truth().joint.and_then(|name| robot.joint_index(&name));
        let joints = own.map_or(0..robot.joint_count(), |j| j..j + 1);
        let square = |sum: f64, value: f64| sum + value * value;
        let added = joints.clone().map(added).fold(0.0, square);
        let torque = joints.map(|j| self.levels[j].torque_rms).fold(0.0, square);
        Some((added / torque).sqrt()).filter(|share| share.is_finite())
    }

    pub(crate) fn draw(
        &self,
        hidden: &HiddenSpec,
        kinds: &[EffectKind],
        drawn: &[EffectSpec],
        random: &mut ChaCha8Rng,
    ) -> Result<EffectSpec, SimulatorError> {
        let [least, largest] = hidden.torque_share;
        let mut last = "and none could be put into this arm".to_owned();
        for _ in 0..TRIES {
            let kind = kinds[random.random_range(0..kinds.len())];
            let joint = random.random_range(0..self.levels.len());
            let goal = least * (largest / least).powf(random.random::<f64>());
            let seed = random.random::<u64>();
            let Some((effect, share)) = self.effect_of_share(kind, joint, goal, seed) else {
                continue;
            };
            last = format!("the last was {} {kind} at {share:.3} of the torque", kind.code());
            let truth = effect.truth();
            let taken = drawn.iter().any(|d| {
                let other = d.truth();
                (other.effect, other.joint, other.link)
                    == (truth.effect, truth.joint.clone(), truth.link.clone())
            });
            if !taken && (least..=largest).contains(&share) {
                return Ok(effect);
            }
        }
        Err(SimulatorError::NothingDrawn { tried: TRIES, least, largest, last })
    }

    /// An effect whose torque share is near the goal, with its simulated share.
    fn effect_of_share(
        &self,
        kind: EffectKind,
        joint: usize,
        goal: f64,
        seed: u64,
    ) -> Option<(EffectSpec, f64)> {
        let at = self.surroundings(joint);
        let (mut asked, mut bracket) = (goal, Bracket::default());
        let mut best: Option<(EffectSpec, f64)> = None;
        let off = |share: f64| (share / goal).ln().abs();
        for _ in 0..CORRECTIONS {
            let mut random = ChaCha8Rng::seed_from_u64(seed);
            let effect = EffectSpec::draw(kind, &at, asked, &mut random);
            // Beyond what is drawn at all nothing grows.
            if best.as_ref().is_some_and(|(known, _)| *known == effect) {
                break;
            }
            let share = effect.inject(at.robot).ok().and_then(|_| self.share(&effect));
            // An arm that runs away has more than enough.
            let share = share.unwrap_or(f64::INFINITY);
            if share.is_finite() && best.as_ref().is_none_or(|(_, b)| off(share) < off(*b)) {
                best = Some((effect, share));
            }
            let hopeless = share <= 0.0 && asked >= 1.0;
            if off(share) < TOLERANCE || hopeless {
                break;
            }
            asked = bracket.next(asked, goal / share);
        }
        best
    }

    fn surroundings(&self, joint: usize) -> Surroundings<'_> {
        let rows = &self.nominal;
        let of = |value: &dyn Fn(&ControlRow) -> f64| rms(rows.iter().map(value));
        let positions = rows.iter().map(|r| r.reference.q[joint]);
        let period_s =
            self.scenario.stepping().step_s * self.scenario.stepping().steps_per_period as f64;
        let rate = rows
            .windows(2)
            .map(|w| (w[1].reading.effort[joint] - w[0].reading.effort[joint]) / period_s);
        Surroundings {
            robot: self.scenario.robot(),
            joint,
            torque_rms: self.levels[joint].torque_rms,
            speed_rms: self.levels[joint].speed_rms,
            acceleration_rms: of(&|r| r.reference.qdd[joint]),
            range: (
                positions.clone().fold(f64::INFINITY, f64::min),
                positions.fold(f64::NEG_INFINITY, f64::max),
            ),
            torque_rate_rms: rms(rate),
            inertia: self.inertia[joint],
            joints: &self.levels,
        }
    }
}

/// Bounds of the size sought, for a torque that grows with the size.
struct Bracket {
    too_small: f64,
    too_large: f64,
}

impl Default for Bracket {
    fn default() -> Self {
        Self { too_small: 0.0, too_large: f64::INFINITY }
    }
}

impl Bracket {
    /// The next size to try after `asked`, whose torque should have been `factor` times as large.
    fn next(&mut self, asked: f64, factor: f64) -> f64 {
        if factor > 1.0 {
            self.too_small = asked;
        } else {
            self.too_large = asked;
        }
        let proportional = asked * factor.clamp(0.2, 5.0);
        if self.too_small < proportional && proportional < self.too_large {
            return proportional;
        }
        (self.too_small * self.too_large).sqrt()
    }
}

/// Root mean square; zero for no values.
fn rms(values: impl Iterator<Item = f64>) -> f64 {
    let (count, sum) = values.fold((0_usize, 0.0), |(n, s), v| (n + 1, s + v * v));
    (sum / count.max(1) as f64).sqrt()
}
