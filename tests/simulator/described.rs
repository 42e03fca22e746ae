//! What the robot's description says acts as the effect of the same name that is put in.

use robot::{Actuator, FrictionWave, Reading, Ripple, Robot, Stribeck, Warming};

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

/// What a drive says, and the effects that do the same.
const DESCRIBED: [(&str, Describe); 9] = [
    (
        "stribeck_friction = { joint = 'joint', coulomb_nm = 0.5, breakaway_nm = 0.75, \
         stribeck_velocity_rad_per_s = 0.25 }",
        |a| a.stribeck = Some(Stribeck { excess: 0.25, velocity: 0.25 }),
    ),
    (
        "load_dependent_friction = { joint = 'joint', coefficient = 0.3 }\n[[effect]]\n\
         coulomb_friction = { joint = 'joint', level_nm = 0.5 }",
        |a| a.load_friction = 0.3,
    ),
    (
        "presliding_friction = { joint = 'joint', stiffness_nm_per_rad = 64.0, \
         damping_nm_s_per_rad = 2.5298221281347035, level_nm = 0.5 }",
        |a| a.presliding = Some(0.5 / 64.0),
    ),
    (
        "presliding_friction = { joint = 'joint', stiffness_nm_per_rad = 64.0, \
         damping_nm_s_per_rad = 1.5, level_nm = 0.5 }",
        |a| (a.presliding, a.presliding_damping) = (Some(0.5 / 64.0), Some(1.5)),
    ),
    (
        "position_dependent_friction = { joint = 'joint', level_nm = 0.5, share = 0.4, \
         periods_per_turn = 40.0, phase_rad = 0.7 }",
        |a| a.friction_wave = Some(FrictionWave { share: 0.4, periods: 40.0, phase: 0.7 }),
    ),
    (
        "coulomb_friction = { joint = 'joint', level_nm = 0.5 }\n[[effect]]\n\
         torque_ripple = { joint = 'joint', amplitude_nm = 0.3, periods_per_turn = 50.0, \
         phase_rad = 0.7 }",
        |a| a.ripple = Some(Ripple { amplitude: 0.3, periods: 50.0, phase: 0.7 }),
    ),
    (
        "coulomb_friction = { joint = 'joint', level_nm = 0.5 }\n[[effect]]\n\
         actuator_lag = { joint = 'joint', time_constant_ms = 4.0 }",
        |a| a.lag_s = 0.004,
    ),
    (
        "coulomb_friction = { joint = 'joint', level_nm = 0.5 }\n[[effect]]\n\
         encoder_offset = { joint = 'joint', offset_rad = 0.1 }",
        |a| a.encoder_offset = 0.1,
    ),
    (
        "coulomb_friction = { joint = 'joint', level_nm = 0.5 }\n[[effect]]\n\
         transmission_ratio = { joint = 'joint', ratio = 1.1 }\n[[effect]]\n\
         encoder_offset = { joint = 'joint', offset_rad = 0.1 }",
        |a| (a.transmission_ratio, a.encoder_offset) = (1.1, 0.1),
    ),
];

/// All that a drive can say beside its transmission and its delay, next to the scenario's way of
/// saying it; the wheel has Coulomb friction of 0.5 N m where both have it.
#[test]
fn what_a_drive_says_moves_the_wheel_as_the_effect_put_in_does() {
    let rough = |a: &mut Actuator| (a.coulomb_forward, a.coulomb_backward) = (0.5, 0.5);
    let ideal = rows(&wheel(rough), "effect = []");
    for (effects, describe) in DESCRIBED {
        let injected = rows(&wheel(|_| ()), &format!("[[effect]]\n{effects}"));
        let described = wheel(|a| {
            rough(a);
            describe(a);
        });
        assert_eq!(rows(&described, "effect = []"), injected, "{effects}");
        let apart = |k: usize| (injected[k].q_true[0] - ideal[k].q_true[0]).abs();
        let apart = (0..injected.len()).map(apart).fold(0.0, f64::max);
        assert!(apart > 1e-3, "{effects} moves the wheel by {apart} rad only");
    }
}

/// A wheel that is described to lose what an effect has its friction lose, within two seconds.
#[test]
fn friction_that_is_described_to_fall_moves_the_wheel_as_the_effect_put_in_does() {
    let rough = |a: &mut Actuator| {
        (a.coulomb_forward, a.coulomb_backward) = (0.5, 0.5);
        a.viscous = 0.4;
    };
    let effect = "friction_temperature_drift = { share = 0.6, time_constant_s = 0.5 }";
    let injected = rows(&wheel(rough), &format!("[[effect]]\n{effect}"));
    let described = wheel(|a| {
        rough(a);
        let [viscous_lost, coulomb_lost] = [0.6 * 0.4, 0.6 * 0.5];
        a.warming = Some(Warming { viscous_lost, coulomb_lost, time_constant_s: 0.5 });
    });
    let apart = |robot: &Robot| {
        let rows = rows(robot, "effect = []");
        let pairs = rows.iter().zip(&injected);
        pairs.map(|(a, b)| (a.q_true[0] - b.q_true[0]).abs()).fold(0.0, f64::max)
    };
    assert!(apart(&described) < 1e-9, "{} rad apart", apart(&described));
    assert!(apart(&wheel(rough)) > 1e-3, "it moves the wheel by {} rad only", apart(&wheel(rough)));
}

/// What the plant has of a cable and what acts beside it are one cable.
#[test]
fn a_described_cable_moves_the_wheel_as_the_effect_put_in_does() {
    let cable = "cable_spring = { joint = 'joint', stiffness_nm_per_rad = 4.0, rest_rad = 0.1, \
                 cubic_nm_per_rad3 = 20.0, hysteresis_nm = 0.3 }";
    let injected = rows(&wheel(|_| ()), &format!("[[effect]]\n{cable}"));
    let described = |a: &mut Actuator| {
        (a.spring_stiffness, a.spring_rest) = (4.0, 0.1);
        (a.spring_cubic, a.spring_hysteresis) = (20.0, 0.3);
    };
    let linear = |a: &mut Actuator| (a.spring_stiffness, a.spring_rest) = (4.0, 0.1);
    let apart = |described: fn(&mut Actuator)| {
        let rows = rows(&wheel(described), "effect = []");
        let pairs = rows.iter().zip(&injected);
        pairs.map(|(a, b)| (a.q_true[0] - b.q_true[0]).abs()).fold(0.0, f64::max)
    };
    assert!(apart(described) < 1e-9, "{} rad apart", apart(described));
    assert!(apart(linear) > 1e-3, "the loop moves the wheel by {} rad only", apart(linear));
}

/// A wheel that has slid holds the sum of its levels while it turns on at constant speed:
/// `tau = coulomb (1 + share) + excess / e` at the Stribeck velocity, where the wave has its top.
#[test]
fn oracle_described_dry_friction_adds_up_behind_one_set_of_bristles() {
    let speed = 0.2;
    let robot = wheel(|a| {
        (a.coulomb_forward, a.coulomb_backward) = (0.5, 0.3);
        a.friction_wave = Some(FrictionWave { share: 0.4, periods: 0.0, phase: 0.0 });
        a.stribeck = Some(Stribeck { excess: 0.25, velocity: speed });
        a.presliding = Some(0.002);
    });
    for (side, coulomb) in [(1.0, 0.5), (-1.0, 0.3)] {
        let mut wheel = simulator(&robot, "effect = []", STEPPING).unwrap();
        wheel.start_moving(&[0.0], &[side * speed]);
        // Stiff enough against the fall of the friction with speed.
        let hold = |r: &Reading| vec![40.0 * (side * speed - r.qd[0])];
        let rows = run(&mut wheel, 2.0, hold).unwrap();
        let last = rows.last().unwrap();
        let excess = 0.25 * (-(last.qd_true[0] / speed).powi(2)).exp();
        let expected = side * (1.4 * coulomb + excess);
        let found = last.motor_torque_true[0];
        assert!((found - expected).abs() < 1e-6, "{found}, not {expected} N m");
        // It had slid from the start: it was never pushed without friction.
        let fastest = rows.iter().map(|r| r.qd_true[0].abs()).fold(0.0, f64::max);
        assert!(fastest <= speed * (1.0 + 1e-9), "{fastest} rad/s");
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
