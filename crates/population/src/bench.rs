use motion::MotionSpec;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use simulator::scenario::{ControlSpec, RunSpec, SensorSpec};

use crate::arms::arm::SampledArm;
use crate::arms::make::Make;
use crate::corner::{ArmClass, EffortClass, MotionClass};
use crate::dice::{between, happens, log_uniform_between, weighted_index};
use crate::error::PopulationError;
use crate::instruments::{Instrument, Instruments};
use crate::motions::ground::Ground;
use crate::motions::log_plan::LogPlan;
use crate::robot_files::RobotFiles;
use crate::{motions, sensors};

/// Arms drawn before the draw of a bench fails.
const TRIES: usize = 40;
/// Time for which an arm is held before a log begins (s).
const LEAD_IN_S: f64 = 1.0;

/// An arm with its controller, sensors and motions, before any effect is hidden in it.
#[derive(Debug, Clone, PartialEq)]
pub struct LabBench {
    /// Kind of arm.
    pub class: ArmClass,
    /// The true arm: bodies, rotors, gravity, gains, limits, sensing; no friction.
    pub truth: RobotFiles,
    /// The user's model: bodies off by up to 5 % and some mm, with or without rotors, and a URDF without friction
    /// or with dummy values.
    pub nominal: RobotFiles,
    /// The controller.
    pub control: ControlSpec,
    /// The sensors of the logs.
    pub sensors: SensorSpec,
    /// The logs given to the diagnosis.
    pub runs: Vec<RunSpec>,
    /// Another draw of the same kind of motion.
    pub held_out: RunSpec,
    /// Kind of motion; the first of a mixture.
    pub motion: MotionClass,
    /// Source of the effort.
    pub effort: EffortClass,
    /// Whether all logs are of one motion.
    pub repeats: bool,
    /// Typical Coulomb friction of each joint's drive (N m or N).
    pub friction: Vec<f64>,
}

/// Ranges from which benches are drawn.
#[derive(Debug, Clone, PartialEq)]
pub struct BenchWishes {
    /// Kinds of arm, equally likely.
    pub classes: Vec<ArmClass>,
    /// Kinds of motion, equally likely.
    pub motions: Vec<MotionClass>,
    /// Least and largest number of logs.
    pub logs: [usize; 2],
    /// Least and largest length of a log (s).
    pub log_s: [f64; 2],
    /// What the logs are read with, where it is not what arms of the class have.
    pub instruments: Option<Instruments>,
}

/// Draws a bench.
///
/// # Errors
///
/// [`PopulationError::NothingToDraw`], or [`PopulationError::NoBench`] where no arm can follow a motion of the
/// drawn kind.
pub fn draw_bench(
    wishes: &BenchWishes,
    random: &mut ChaCha8Rng,
) -> Result<LabBench, PopulationError> {
    let class = pick("classes", &wishes.classes, random)?;
    let motion = pick("motions", &wishes.motions, random)?;
    // Settled once, so that arms which are hard to move are not rare.
    let count = 1 + weighted_index(random, &Make::of(class).joints);
    let instrument =
        wishes.instruments.as_ref().map_or_else(Instrument::default, |all| all.draw(random));
    for _ in 0..TRIES {
        let arm = SampledArm::draw(class, count, instrument, random)?;
        let sensors = sensors::draw(class, &arm, random);
        let friction = arm.friction(class, random);
        if let Some(moved) = draw_runs(&arm, motion, wishes, random)? {
            return Ok(LabBench {
                class,
                control: ControlSpec::default(),
                sensors,
                runs: moved.runs,
                held_out: moved.held_out,
                motion,
                effort: arm.electronics.effort,
                repeats: moved.repeats,
                friction,
                truth: arm.truth,
                nominal: arm.nominal,
            });
        }
    }
    Err(PopulationError::NoBench { arm: class, motion, tries: TRIES })
}

/// The runs of a bench.
struct BenchRuns {
    runs: Vec<RunSpec>,
    held_out: RunSpec,
    repeats: bool,
}

/// Draws the runs of an arm; `None` where it can follow no such motion.
fn draw_runs(
    arm: &SampledArm,
    motion: MotionClass,
    wishes: &BenchWishes,
    random: &mut ChaCha8Rng,
) -> Result<Option<BenchRuns>, PopulationError> {
    let ground = Ground::new(arm, between(random, [0.2, 1.0]));
    let logs = log_count(ground.count(), motion, wishes, random);
    let repeats = motion == MotionClass::Repeated && logs > 1;
    let typical_s = log_uniform_between(random, wishes.log_s);
    let mixed = happens(random, 0.2)
        && !matches!(motion, MotionClass::Repeated | MotionClass::JointByJoint);
    let mut runs: Vec<RunSpec> = Vec::with_capacity(logs);
    for log in 0..logs {
        if let (true, Some(first)) = (repeats, runs.first()) {
            let again = RunSpec { name: name(log), ..first.clone() };
            runs.push(again);
            continue;
        }
        let class = match mixed && log > 0 {
            true => other(wishes, motion, random),
            false => motion,
        };
        let place = LogPlan { log, logs, length_s: length(typical_s, wishes, random) };
        let Some(spec) = motions::draw::draw(class, &ground, place, random)? else {
            return Ok(None);
        };
        runs.push(run(name(log), spec));
    }
    // What all joints do in one log says most of a model.
    let place = LogPlan { log: 0, logs: 1, length_s: length(typical_s, wishes, random) };
    let held_out = motions::draw::draw(motion, &ground, place, random)?;
    Ok(held_out.map(|spec| BenchRuns { runs, held_out: run("held_out".to_owned(), spec), repeats }))
}

fn log_count(
    joints: usize,
    motion: MotionClass,
    wishes: &BenchWishes,
    random: &mut ChaCha8Rng,
) -> usize {
    let [least, most] = [wishes.logs[0].max(1), wishes.logs[1].max(1)];
    let one_each = motion == MotionClass::JointByJoint && (least..=most).contains(&joints);
    if one_each && happens(random, 0.6) {
        return joints;
    }
    // What repeats does so at least once, where that is allowed.
    let least = if motion == MotionClass::Repeated { least.max(2).min(most) } else { least };
    random.random_range(least.min(most)..=most)
}

/// Another kind of motion for one log of a mixture.
fn other(wishes: &BenchWishes, motion: MotionClass, random: &mut ChaCha8Rng) -> MotionClass {
    let single = |m: &&MotionClass| !matches!(m, MotionClass::Repeated | MotionClass::JointByJoint);
    let kinds: Vec<MotionClass> = wishes.motions.iter().filter(single).copied().collect();
    pick("motions", &kinds, random).unwrap_or(motion)
}

fn length(typical_s: f64, wishes: &BenchWishes, random: &mut ChaCha8Rng) -> f64 {
    let [least, most] = wishes.log_s;
    let length = (typical_s * between(random, [0.8, 1.2])).clamp(least, most);
    (10.0 * length).round() / 10.0
}

fn name(log: usize) -> String {
    format!("log_{}", log + 1)
}

fn run(name: String, motion: MotionSpec) -> RunSpec {
    RunSpec { name, motion, lead_in_s: LEAD_IN_S, effect: Vec::new() }
}

fn pick<T: Copy>(
    key: &'static str,
    from: &[T],
    random: &mut ChaCha8Rng,
) -> Result<T, PopulationError> {
    if from.is_empty() {
        return Err(PopulationError::NothingToDraw { key });
    }
    from.get(random.random_range(0..from.len()))
        .copied()
        .ok_or(PopulationError::NothingToDraw { key })
}
