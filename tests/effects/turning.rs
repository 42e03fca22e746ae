//! Friction of a joint that turns, sampled too seldom to show the instant.

use catalogue::EffectKind;
use checks::arms::wam;
use effects::{Hypothesis, Place, RunMotion};
use robot::Robot;

use crate::frame;

const JOINT: usize = 3;
const LEVELS_NM: [f64; 2] = [0.686, 0.376];
const PERIOD_S: f64 = 0.02;

/// 200 samples, ten times to and fro, with some samples below the speed of rest around every turn. The state of all other
/// joints is zero.
fn to_and_fro(robot: &Robot) -> [Vec<Vec<f64>>; 3] {
    let rate = std::f64::consts::TAU / (20.0 * PERIOD_S);
    let of = |amplitude: f64, phase: f64| {
        let at = |t: i32| amplitude * (rate * PERIOD_S * (f64::from(t) + 5.25) + phase).cos();
        (0..200).map(at).collect::<Vec<f64>>()
    };
    let turn = std::f64::consts::FRAC_PI_2;
    let moving = [of(0.002, 0.0), of(0.002 * rate, turn), of(0.002 * rate * rate, 2.0 * turn)];
    moving.map(|signal| {
        let mut all = vec![vec![0.0; signal.len()]; robot.joint_count()];
        all[JOINT] = signal;
        all
    })
}

fn mean_effort(robot: &Robot) -> f64 {
    let motion = RunMotion::new(robot, &frame(robot), to_and_fro(robot), PERIOD_S);
    motion.effort[JOINT].iter().sum::<f64>() / motion.effort[JOINT].len() as f64
}

/// A motion to and fro is half the time in either direction: its mean friction is half the difference of the levels, by
/// what a robot with them says as by the column of one without.
#[test]
fn a_joint_that_turns_has_both_levels_of_its_friction_in_equal_shares() {
    let plain = wam();
    let mut skewed = wam();
    let drive = &mut skewed.link_mut(JOINT).unwrap().actuator;
    [drive.coulomb_forward, drive.coulomb_backward] = LEVELS_NM;
    let expected = 0.5 * (LEVELS_NM[0] - LEVELS_NM[1]);
    let found = mean_effort(&skewed) - mean_effort(&plain);
    assert!((found - expected).abs() < 1e-3 * expected, "{found}, not {expected}");

    let asymmetric =
        Hypothesis { kind: EffectKind::AsymmetricFriction, place: Place::Joint(JOINT) };
    let motion = RunMotion::new(&plain, &frame(&plain), to_and_fro(&plain), PERIOD_S);
    let skew = &asymmetric.columns(&motion)[1][0].values;
    let found = expected * skew.iter().sum::<f64>() / skew.len() as f64;
    assert!((found - expected).abs() < 1e-3 * expected, "{found}, not {expected}");
}
