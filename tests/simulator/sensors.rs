use std::f64::consts::TAU;

use nalgebra::Complex;
use simulator::scenario::Scenario;
use simulator::{EffortSource, JointSensor, LinkEncoder, PositionSide, Sensors, VelocitySource};

use crate::rig::{GRAVITY, Row, STEPPING, flywheel, pendulum, phasor, run, sensing};
use crate::scenario::document;

const EXACT: JointSensor = JointSensor { resolution: 0.0, position_noise: 0.0, effort_noise: 0.0 };

fn sensors(side: PositionSide, effort: EffortSource, joint: JointSensor) -> Sensors {
    Sensors::new(side, effort, VelocitySource::Ideal, vec![joint], 7)
}

/// A sagging arm: 2 kg at 0.5 m on an elastic transmission, its motor held by friction of 4 N m and
/// a command of -7 N m.
const MASS: f64 = 2.0;
const DISTANCE: f64 = 0.5;
const STIFFNESS: f64 = 500.0;
const COMMAND: f64 = -7.0;
const SAGGING: &str = "
[[effect]]
rotor_inertia = { joint = 'joint', inertia_kg_m2 = 0.1 }
[[effect]]
joint_elasticity = { joint = 'joint', stiffness_nm_per_rad = 500.0, damping_nm_s_per_rad = 5.0 }
[[effect]]
coulomb_friction = { joint = 'joint', level_nm = 4.0 }
[[effect]]
torque_saturation = { joint = 'joint', limit_nm = 6.5 }
";

fn sagging(side: PositionSide, effort: EffortSource) -> Row {
    let robot = pendulum(MASS, DISTANCE);
    let mut arm = sensing(&robot, SAGGING, STEPPING, sensors(side, effort, EXACT)).unwrap();
    arm.start(&[0.0]);
    run(&mut arm, 5.0, |_| vec![COMMAND]).unwrap().pop().unwrap()
}

#[test]
fn oracle_a_sensor_at_the_motor_does_not_see_the_link_sag_and_one_at_the_link_does() {
    let motor = sagging(PositionSide::Motor, EffortSource::Motor);
    let link = sagging(PositionSide::Link, EffortSource::Motor);
    let sag = MASS * GRAVITY * DISTANCE * link.q_true[0].cos() / STIFFNESS;
    assert!((motor.logged.q[0] - motor.motor_q_true[0]).abs() < 1e-15);
    assert!((link.logged.q[0] - motor.logged.q[0] - sag).abs() < 1e-8, "{}", link.logged.q[0]);
}

/// At rest: what was asked for; what the drive gave, its limit; what the link hangs on. The last
/// two differ by friction, which the motor does not need to give.
#[test]
fn oracle_at_rest_command_motor_and_link_each_show_their_own_torque() {
    let effort = |source| sagging(PositionSide::Link, source).logged.effort[0];
    let link = sagging(PositionSide::Link, EffortSource::Link);
    let holding = -MASS * GRAVITY * DISTANCE * link.q_true[0].cos();
    assert!((effort(EffortSource::Commanded) - COMMAND).abs() < 1e-12);
    assert!((effort(EffortSource::Motor) + 6.5).abs() < 1e-12);
    assert!((link.logged.effort[0] - holding).abs() < 1e-5, "{:?}, not {holding}", link.logged);
}

/// A rigid transmission, too, carries gravity to a sensor behind its friction, and in motion the
/// inertia of the link but not the rotor's.
#[test]
fn oracle_a_link_torque_sensor_behind_a_rigid_transmission_sees_the_link_alone() {
    let friction = "[[effect]]\ncoulomb_friction = { joint = 'joint', level_nm = 4.0 }";
    let link = || sensors(PositionSide::Link, EffortSource::Link, EXACT);
    let mut arm = sensing(&pendulum(MASS, DISTANCE), friction, STEPPING, link()).unwrap();
    arm.start(&[0.3]);
    let last = run(&mut arm, 0.5, |_| vec![COMMAND]).unwrap().pop().unwrap();
    let holding = -MASS * GRAVITY * DISTANCE * f64::cos(0.3);
    assert!((last.logged.effort[0] - holding).abs() < 1e-6, "{:?}, not {holding}", last.logged);

    let mut wheel = sensing(&flywheel(0.4, 0.1), friction, STEPPING, link()).unwrap();
    wheel.start(&[0.0]);
    let last = run(&mut wheel, 0.5, |_| vec![6.0]).unwrap().pop().unwrap();
    let carried = 0.4 / 0.5 * (6.0 - 4.0);
    assert!((last.logged.effort[0] - carried).abs() < 1e-6, "{:?}, not {carried}", last.logged);
}

/// A turning wheel: readings are whole counts, off by up to half of one, evenly over that range.
#[test]
fn oracle_the_error_of_counts_is_even_within_half_a_count() {
    let count = 1e-3;
    let joint = JointSensor { resolution: count, ..EXACT };
    let counting = sensors(PositionSide::Motor, EffortSource::Motor, joint);
    let mut wheel = sensing(&flywheel(0.4, 0.1), "effect = []", STEPPING, counting).unwrap();
    wheel.start_moving(&[0.0], &[std::f64::consts::SQRT_2 - 1.0]);
    let rows = run(&mut wheel, 20.0, |_| vec![0.0]).unwrap();
    let errors: Vec<f64> = rows.iter().map(|r| r.logged.q[0] - r.q_true[0]).collect();
    assert!(rows.iter().all(|r| {
        (r.logged.q[0] / count).fract().abs().min(1.0 - (r.logged.q[0] / count).fract().abs())
            < 1e-9
    }));
    assert!(errors.iter().all(|e| e.abs() < 0.5 * count + 1e-12));
    // 10000 readings at an irrational stride: tenths of the range within 1 % of their share.
    for tenth in 0..10 {
        let low = (0.1 * f64::from(tenth) - 0.5) * count;
        let inside = errors.iter().filter(|e| (low..low + 0.1 * count).contains(*e)).count();
        let share = inside as f64 / errors.len() as f64;
        assert!((share - 0.1).abs() < 1e-3, "tenth {tenth}: {share}");
    }
}

fn deviation(errors: &[f64]) -> f64 {
    (errors.iter().map(|e| e * e).sum::<f64>() / errors.len() as f64).sqrt()
}

/// 20000 draws: deviations within 2 %, four times the spread of such an estimate; means, and what
/// neighbours and channels share, within four times theirs.
#[test]
fn oracle_noise_is_white_and_of_the_deviation_asked_for() {
    let joint = JointSensor { position_noise: 2e-4, effort_noise: 0.03, ..EXACT };
    let noisy = sensors(PositionSide::Motor, EffortSource::Motor, joint);
    let mut wheel = sensing(&flywheel(0.4, 0.1), "effect = []", STEPPING, noisy).unwrap();
    wheel.start(&[0.1]);
    let rows = run(&mut wheel, 40.0, |_| vec![0.0]).unwrap();
    let q: Vec<f64> = rows.iter().map(|r| (r.logged.q[0] - 0.1) / 2e-4).collect();
    let effort: Vec<f64> = rows.iter().map(|r| r.logged.effort[0] / 0.03).collect();
    let spread = 4.0 / (rows.len() as f64).sqrt();
    let mean_product =
        |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| a * b).sum::<f64>() / rows.len() as f64;
    for channel in [&q, &effort] {
        assert!((deviation(channel) - 1.0).abs() < 0.02, "{}", deviation(channel));
        assert!((channel.iter().sum::<f64>() / rows.len() as f64).abs() < spread);
        assert!(mean_product(channel, &channel[1..]).abs() < spread);
    }
    assert!(mean_product(&q, &effort).abs() < spread);
}

/// `1 / (1 + i f / cutoff)`: the difference is late by half a row, the filter early by as much.
#[test]
fn oracle_a_filtered_difference_is_the_velocity_through_a_first_order_low_pass() {
    let cutoff_hz = 20.0;
    for frequency_hz in [2.0, 20.0] {
        let filtered = Sensors::new(
            PositionSide::Motor,
            EffortSource::Motor,
            VelocitySource::FilteredDifference { cutoff_hz },
            vec![EXACT],
            7,
        );
        let mut wheel = sensing(&flywheel(0.4, 0.1), "effect = []", STEPPING, filtered).unwrap();
        wheel.start(&[0.0]);
        let torque = |t: f64| (TAU * frequency_hz * t).cos();
        let rows = run(&mut wheel, 1.0, |r| vec![torque(r.time_s)]).unwrap().split_off(250);
        let of = |value: fn(&Row) -> f64| {
            let samples: Vec<_> = rows.iter().map(|r| (r.time_s, value(r))).collect();
            phasor(&samples, frequency_hz)
        };
        let found = of(|r| r.logged.qd[0]) / of(|r| r.qd_true[0]);
        let expected = Complex::new(1.0, frequency_hz / cutoff_hz).inv();
        // Rows h apart: (w h)² / 12 and the like, 0.5 % at 20 Hz.
        let tolerance = 0.1 * (TAU * frequency_hz * 2e-3).powi(2) + 1e-3;
        println!("{frequency_hz} Hz: {found}, a low pass has {expected}");
        assert!(
            (found - expected).norm() < tolerance,
            "{frequency_hz} Hz: {found}, not {expected}"
        );
    }
}

/// The link of the sagging arm, whole counts beside a motor that is read without error.
#[test]
fn oracle_a_second_encoder_counts_where_the_link_is() {
    let robot = pendulum(MASS, DISTANCE);
    let count = 1e-4;
    let encoder = LinkEncoder { resolution: count, noise: 0.0 };
    let motor = || sensors(PositionSide::Motor, EffortSource::Motor, EXACT);
    let mut arm =
        sensing(&robot, SAGGING, STEPPING, motor().with_links(vec![Some(encoder)])).unwrap();
    arm.start(&[0.0]);
    let last = run(&mut arm, 5.0, |_| vec![COMMAND]).unwrap().pop().unwrap();
    let sag = MASS * GRAVITY * DISTANCE * last.q_true[0].cos() / STIFFNESS;
    let [Some(link)] = arm.record_links(&last.logged)[..] else { unreachable!("an encoder") };
    assert!((link / count - (link / count).round()).abs() < 1e-9, "{link}");
    assert!((link - last.logged.q[0] - sag).abs() < 0.5 * count + 1e-8, "{link}");

    let mut bare = sensing(&robot, SAGGING, STEPPING, motor()).unwrap();
    bare.start(&[0.0]);
    run(&mut bare, 0.1, |_| vec![COMMAND]).unwrap();
    assert_eq!(bare.record_links(&last.logged), [None]);
}

/// A column for each joint that has one, and nothing else in the log is another.
#[test]
fn a_second_encoder_leaves_every_other_column_as_it_was() {
    let log = |settings: &[&str]| {
        let mut document = document("");
        for setting in settings {
            document.set(setting).unwrap();
        }
        document.set("sensors.position_noise_rad={ j4_elbow_pitch=1e-4 }").unwrap();
        document.set("run.0.motion.sinusoids.duration_s=2.0").unwrap();
        let scenario = Scenario::from_document(&document).unwrap();
        simulator::simulate(&scenario, &|| {}).unwrap().runs.remove(0)
    };
    let counts = "sensors.link_position_resolution_rad={ j4_elbow_pitch=1e-4, j1_base_yaw=0.0 }";
    let noise = "sensors.link_position_noise_rad={ j4_elbow_pitch=2e-4, j2_shoulder_pitch=1e-4 }";
    let (mut with, without) = (log(&[counts, noise]), log(&[]));
    let links: Vec<_> = with.joints.iter_mut().map(|j| j.link_position.take()).collect();
    assert_eq!(with, without);
    let has: Vec<bool> = links.iter().map(Option::is_some).collect();
    assert_eq!(has, [true, true, false, true, false, false, false]);
    // A rigid arm: motor and link are one, but for what the encoders make of it.
    let off = |j: usize| {
        let pairs = links[j].iter().flatten().zip(&with.joints[j].position);
        pairs.map(|(link, q)| link - q).collect::<Vec<f64>>()
    };
    let expected = (2e-4_f64.powi(2) + 1e-4_f64.powi(2) * (1.0 + 1.0 / 12.0)).sqrt();
    let found = deviation(&off(3));
    // 1000 draws know it to 2 %.
    assert!((found / expected - 1.0).abs() < 0.1, "{found}, not {expected}");
    assert!(off(0).iter().all(|off| off.abs() < 1e-15));
}
