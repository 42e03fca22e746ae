use std::path::Path;

use motion::{MotionError, State};
use rand_chacha::ChaCha8Rng;
use robot::{JointKind, Robot};
use simulator::scenario::RunSpec;

use crate::dice::{between, round_to_digits};
use crate::rigid::torque;
use crate::trial::background::{Friction, MOST_DRY};

/// Coulomb friction over the RMS effort, inside of a tenth to a third: the effort of the logs is not that of the
/// plan to the last per cent. A UR10's large joints have 14, 17 and 9 N m.
const SHARE_OF_EFFORT: [f64; 2] = [0.12, 0.3];

/// Torque of a large joint over that of the joint of its kind that has most.
const LARGE: f64 = 0.25;

/// Time between two samples of a planned motion (s).
const SAMPLED_S: f64 = 0.05;

/// Speed above which a joint moves (rad/s or m/s).
const MOVES: f64 = 1e-3;

/// What a joint does in the planned motions.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct PlannedLoad {
    /// RMS torque of bodies, rotor and spring (N m or N).
    rms: f64,
    /// Share of the time in which it moves.
    moving: f64,
}

/// Coulomb friction of a tenth to a third of the RMS effort at the large joints, `None` at all others:
///
/// ```text
/// rms_effort^2 = rms_plan^2 + moving F^2,   F = share rms_effort
/// F            = share rms_plan / sqrt(1 - moving share^2)
/// ```
///
/// # Errors
///
/// [`MotionError`] for a motion that cannot be built.
pub(crate) fn strong(
    robot: &Robot,
    runs: &[RunSpec],
    random: &mut ChaCha8Rng,
) -> Result<Vec<Option<f64>>, MotionError> {
    let loads = planned_loads(robot, runs)?;
    let slides = |i: usize| robot.links()[i].joint.kind == JointKind::Prismatic;
    let most = |kind: bool| {
        let same = loads.iter().enumerate().filter(|(i, _)| slides(*i) == kind);
        same.map(|(_, load)| load.rms).fold(0.0, f64::max)
    };
    let most = [most(false), most(true)];
    let level = |(i, load): (usize, &PlannedLoad)| {
        let share = between(random, SHARE_OF_EFFORT);
        let level = share * load.rms / (1.0 - load.moving * share * share).sqrt();
        let is_large = load.rms >= LARGE * most[usize::from(slides(i))];
        (is_large && level > 0.0).then(|| round_to_digits(level.min(MOST_DRY), 4))
    };
    Ok(loads.iter().enumerate().map(level).collect())
}

/// Everyday friction with other Coulomb levels where there are some; viscous friction keeps its proportion.
pub(crate) fn with_levels(everyday: Vec<Friction>, levels: &[Option<f64>]) -> Vec<Friction> {
    let mut all = everyday;
    for (friction, level) in all.iter_mut().zip(levels) {
        if let Some(level) = level {
            friction.viscous *= level / friction.coulomb.max(1e-9);
            friction.coulomb = *level;
        }
    }
    all
}

fn planned_loads(robot: &Robot, runs: &[RunSpec]) -> Result<Vec<PlannedLoad>, MotionError> {
    let mut loads = vec![PlannedLoad::default(); robot.joint_count()];
    let (mut state, mut samples) = (State::default(), 0_u32);
    for run in runs {
        let motion = run.motion.build(robot, Path::new(""))?;
        for k in 0..(motion.duration_s() / SAMPLED_S) as usize {
            motion.sample(SAMPLED_S * k as f64, &mut state);
            samples += 1;
            for (i, tau) in torque(robot, &state.q, &state.qd, &state.qdd).iter().enumerate() {
                loads[i].rms += tau * tau;
                loads[i].moving += f64::from(state.qd[i].abs() > MOVES);
            }
        }
    }
    let samples = f64::from(samples.max(1));
    loads.iter_mut().for_each(|load| {
        load.rms = (load.rms / samples).sqrt();
        load.moving /= samples;
    });
    Ok(loads)
}
