//! Effects that meet: at one joint, and over the whole arm.

use checks::arms::wam;
use simulator::{EffortSource, JointSensor, PositionSide, Sensors, VelocitySource};

use crate::rig::{GRAVITY, Row, STEPPING, flywheel, pendulum, run, sensing, simulator};

/// `effort = gain ratio tau + offset`, `q reported = q / ratio + offset`: a pendulum is held by the
/// one and shows the other.
#[test]
fn oracle_ratio_gain_and_offsets_of_one_joint_combine() {
    let (mass, distance, q) = (2.0, 0.5, 0.3);
    let effects = "
        [[effect]]
        transmission_ratio = { joint = 'joint', ratio = 1.05 }
        [[effect]]
        torque_constant = { joint = 'joint', gain = 0.9 }
        [[effect]]
        torque_offset = { joint = 'joint', offset_nm = 0.4 }
        [[effect]]
        encoder_offset = { joint = 'joint', offset_rad = -0.02 }
    ";
    let mut arm = simulator(&pendulum(mass, distance), effects, STEPPING).unwrap();
    arm.start(&[q]);
    let effort = 0.9 * 1.05 * -mass * GRAVITY * distance * f64::cos(q) + 0.4;
    let rows = run(&mut arm, 0.5, |_| vec![effort]).unwrap();
    let last = rows.last().unwrap();
    assert!((last.q_true[0] - q).abs() < 1e-9, "{}", last.q_true[0]);
    assert!((last.logged.q[0] - (q / 1.05 - 0.02)).abs() < 1e-9);
    assert!((last.logged.effort[0] - effort).abs() < 1e-12);
}

/// A jump to 5 N m is cut to 2, comes 3.3 ms later, and is spread by 4 ms: all of its impulse
/// arrives, 7.3 ms late on the mean.
#[test]
fn oracle_a_limited_delayed_and_lagged_jump_keeps_its_impulse() {
    let effects = "
        [[effect]]
        torque_saturation = { joint = 'joint', limit_nm = 2.0 }
        [[effect]]
        actuator_delay = { joint = 'joint', delay_ms = 3.3 }
        [[effect]]
        actuator_lag = { joint = 'joint', time_constant_ms = 4.0 }
    ";
    let mut wheel = simulator(&flywheel(0.4, 0.1), effects, STEPPING).unwrap();
    wheel.start(&[0.0]);
    let jump = |t: f64| vec![if t > 0.0999 { 5.0 } else { 0.0 }];
    let rows = run(&mut wheel, 0.5, |r| jump(r.time_s)).unwrap();
    let last = rows.last().unwrap();
    // The step in which the command jumps is asked for 2.5 N m on the mean, which is cut to 2.
    let speed = 2.0 * (last.time_s - 0.1 - 7.3e-3 + 0.5e-4) / 0.5;
    assert!((last.qd_true[0] - speed).abs() < 1e-9, "{} rad/s, not {speed}", last.qd_true[0]);
}

/// Half a second of the WAM with an effect of every sort, noise and counts.
fn noisy_run(seed: u64) -> Vec<Row> {
    let effects = "
        [[effect]]
        torque_saturation = { joint = 'j1_base_yaw', limit_nm = 20.0 }
        [[effect]]
        actuator_delay = { joint = 'j1_base_yaw', delay_ms = 2.5 }
        [[effect]]
        coulomb_friction = { joint = 'j2_shoulder_pitch', level_nm = 2.0 }
        [[effect]]
        torque_ripple = { joint = 'j2_shoulder_pitch', amplitude_nm = 0.3, periods_per_turn = 169 }
        [[effect]]
        joint_elasticity = { joint = 'j4_elbow_pitch', stiffness_nm_per_rad = 2000.0, damping_nm_s_per_rad = 2.0 }
        [[effect]]
        time_skew = { skew_ms = 0.7 }
    ";
    let joint = JointSensor { resolution: 1e-4, position_noise: 1e-4, effort_noise: 0.05 };
    let velocity = VelocitySource::FilteredDifference { cutoff_hz: 30.0 };
    let sensors =
        Sensors::new(PositionSide::Motor, EffortSource::Link, velocity, vec![joint; 7], seed);
    let mut arm = sensing(&wam(), effects, STEPPING, sensors).unwrap();
    arm.start(&[0.1; 7]);
    let (kp, kd) = ([80.0, 80.0, 40.0, 40.0, 4.0, 4.0, 0.5], [8.0, 8.0, 4.0, 4.0, 0.1, 0.1, 0.01]);
    let goal = |t: f64, i: usize| 0.1 + 0.2 * (6.0 * t + i as f64).sin();
    run(&mut arm, 0.5, |r| {
        (0..7).map(|i| kp[i] * (goal(r.time_s, i) - r.q[i]) - kd[i] * r.qd[i]).collect()
    })
    .unwrap()
}

#[test]
fn the_seed_decides_every_bit_of_a_run_on_whatever_thread() {
    let here = noisy_run(3);
    let there = std::thread::spawn(|| noisy_run(3)).join().unwrap();
    assert_eq!(here, there);
    let other = noisy_run(4);
    assert_ne!(here.last().unwrap().logged.q, other.last().unwrap().logged.q);
}

/// A run that is started again is the same run.
#[test]
fn a_start_forgets_what_effects_and_sensors_carry() {
    let effects = "
        [[effect]]
        actuator_delay = { joint = 'joint', delay_ms = 3.3 }
        [[effect]]
        actuator_lag = { joint = 'joint', time_constant_ms = 4.0 }
        [[effect]]
        time_skew = { skew_ms = 0.7 }
    ";
    let joint = JointSensor { resolution: 1e-4, position_noise: 1e-4, effort_noise: 0.05 };
    let velocity = VelocitySource::FilteredDifference { cutoff_hz: 30.0 };
    let sensors = Sensors::new(PositionSide::Motor, EffortSource::Motor, velocity, vec![joint], 5);
    let mut wheel = sensing(&flywheel(0.4, 0.1), effects, STEPPING, sensors).unwrap();
    let mut once = || {
        wheel.start(&[0.2]);
        run(&mut wheel, 0.1, |r| vec![-20.0 * r.q[0] - r.qd[0] + r.time_s]).unwrap()
    };
    let first = once();
    // The torque of the last step before a start belongs to no run.
    assert_eq!(first[1..], once()[1..]);
}
