//! What the robot's description says acts as the effect of the same name that is put in.

use robot::{Actuator, Reading, Robot};

use crate::rig::{FINE, Row, STEPPING, flywheel, run, simulator};

const INERTIA: f64 = 0.4;
const ROTOR: f64 = 0.1;
const STIFFNESS: f64 = 2000.0;

/// What a description says of a drive.
type Describe = fn(&mut Actuator);

fn wheel(describe: impl Fn(&mut Actuator)) -> Robot {
    let mut robot = flywheel(INERTIA, ROTOR);
    describe(&mut robot.link_mut(0).unwrap().actuator);
    robot
}

/// Rows under a torque that turns the wheel to and fro.
fn rows(robot: &Robot, effects: &str) -> Vec<Row> {
    let mut wheel = simulator(robot, effects, STEPPING).unwrap();
    wheel.start(&[0.0]);
    let torque = |r: &Reading| vec![2.0 * (20.0 * r.time_s).sin() - 3.0 * r.q[0]];
    run(&mut wheel, 1.0, torque).unwrap()
}

/// `d = 2 x 0.02 sqrt(k J)` is what a described transmission is damped with.
#[test]
fn a_described_arm_moves_bit_for_bit_as_one_with_the_effect_put_in() {
    let damping = 2.0 * 0.02 * (STIFFNESS * ROTOR).sqrt();
    let gap = "backlash = { joint = 'joint', gap_rad = 0.01 }".to_owned();
    let delay = "actuator_delay = { joint = 'joint', delay_ms = 3.37 }".to_owned();
    let spring = format!(
        "joint_elasticity = {{ joint = 'joint', stiffness_nm_per_rad = {STIFFNESS}, \
         damping_nm_s_per_rad = {damping} }}"
    );
    let cases: [(&[&String], Describe); 4] = [
        (&[&gap], |a| a.backlash = 0.01),
        (&[&delay], |a| a.delay_s = 1e-3 * 3.37),
        (&[&spring], |a| a.elasticity = Some(STIFFNESS)),
        (&[&gap, &delay, &spring], |a| {
            (a.backlash, a.delay_s, a.elasticity) = (0.01, 1e-3 * 3.37, Some(STIFFNESS));
        }),
    ];
    let ideal = rows(&wheel(|_| ()), "effect = []");
    for (effects, describe) in cases {
        let toml: String = effects.iter().map(|e| format!("[[effect]]\n{e}\n")).collect();
        let injected = rows(&wheel(|_| ()), &toml);
        assert_eq!(rows(&wheel(describe), "effect = []"), injected, "{toml}");
        let apart = (injected[499].q_true[0] - ideal[499].q_true[0]).abs();
        assert!(apart > 1e-4, "{toml} moves the wheel by {apart} rad only");
    }
}

#[test]
fn an_effect_put_into_a_described_arm_adds_to_what_is_described() {
    let gap = "[[effect]]\nbacklash = { joint = 'joint', gap_rad = 0.004 }";
    let half = wheel(|a| a.backlash = 0.006);
    let mut play = simulator(&half, gap, FINE).unwrap();
    play.start(&[0.0]);
    let tau = 0.5;
    let rows = run(&mut play, 0.1, |_| vec![tau]).unwrap();
    // The motor leans on the end of a gap of 0.010 rad in all.
    let last = rows.last().unwrap();
    let twist = last.motor_q_true[0] - last.q_true[0];
    assert!((twist - 0.005).abs() < 3e-5, "{twist}");
}
