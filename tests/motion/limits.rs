//! What a joint may not do is refused, with the place, and what it may is not.

use checks::synthetic::wam;
use motion::{LimitedQuantity, MotionError};
use robot::Robot;

use crate::support::{build, every_kind, gantry, sinusoids};

#[test]
fn no_kind_leaves_the_limits() {
    let wam = wam();
    for seed in 0..20 {
        for (kind, toml) in every_kind(seed) {
            let motion = build(&wam, &toml).unwrap();
            for k in 0..=1000 {
                let state = motion.at(motion.duration_s() * f64::from(k) / 1000.0);
                for (j, link) in wam.links().iter().enumerate() {
                    let (low, high) = link.joint.limits.position.unwrap();
                    assert!((low..=high).contains(&state.q[j]), "{kind} seed {seed} joint {j}");
                    assert!(state.qd[j].abs() <= 2.5, "{kind} seed {seed} joint {j}");
                }
            }
        }
    }
}

#[test]
fn a_sine_that_just_passes_a_limit_is_refused_with_joint_time_and_value() {
    // 1 + A sin(2 pi t) is largest at 1/4 s; the elbow ends at 3.1.
    let chirp = |amplitude: f64| {
        let toml = format!(
            "[chirp]\namplitude_rad = {{ j4_elbow_pitch = {amplitude} }}\nfrom_hz = 0.1\n\
            to_hz = 0.1\nposture_rad = {{ j4_elbow_pitch = 1.1 }}\nduration_s = 10.0\nfade_s = 0.0"
        );
        build(&wam(), &toml)
    };
    assert!(chirp(2.0).is_ok());
    let Err(MotionError::LimitExceeded { key, joint, quantity, time_s, found, low, high, unit }) =
        chirp(2.000_01)
    else {
        panic!("accepted");
    };
    assert_eq!((key.as_str(), joint.as_str(), unit), ("chirp", "j4_elbow_pitch", "rad"));
    assert_eq!(quantity, LimitedQuantity::Position);
    assert!((time_s - 7.5).abs() < 1e-6 && (found + 0.900_01).abs() < 1e-9, "{time_s} {found}");
    assert!((low + 0.9).abs() < 1e-15 && (high - 3.1).abs() < 1e-15);
}

#[test]
fn both_ends_of_a_range_are_limits() {
    let ramp = |to: f64| {
        let toml = format!("[ramp]\nto_rad = {{ j2_shoulder_pitch = {to} }}\nduration_s = 5.0\n");
        build(&wam(), &toml)
    };
    for (inside, outside) in [(2.0, 2.001), (-2.0, -2.001)] {
        assert!(ramp(inside).is_ok());
        let error = ramp(outside).unwrap_err();
        let MotionError::LimitExceeded { time_s, found, .. } = error else { panic!("{error}") };
        assert!((time_s - 5.0).abs() < 1e-9 && (found - outside).abs() < 1e-12, "{time_s} {found}");
    }
}

#[test]
fn a_sweep_faster_than_a_joint_is_refused_as_a_velocity() {
    let toml = "[sweep]\nspeeds_rad_per_s = [0.5, 2.6]\nacceleration_rad_per_s2 = 20.0\n";
    let error = build(&wam(), toml).unwrap_err();
    let expected = "sweep: joint j1_base_yaw reaches a velocity of 2.600000 rad/s at";
    assert!(error.to_string().starts_with(expected), "{error}");
}

#[test]
fn a_slide_is_limited_in_metres() {
    let toml = "[hold]\nposture_rad = { slide = 1.6 }\nduration_s = 1.0";
    let error = build(&gantry(), toml).unwrap_err().to_string();
    let expected = "hold: joint slide reaches a position of 1.600000 m at 0.000 s, \
                    -0.5 to 1.5 m was expected (the robot's limits)";
    assert_eq!(error, expected);
}

#[test]
fn a_joint_without_limits_needs_its_amplitude_and_its_speed() {
    let key = |toml: &str| build(&gantry(), toml).unwrap_err().key().to_owned();
    let base = sinusoids(1);
    assert_eq!(key(&base), "sinusoids.amplitude_rad.wheel");
    assert_eq!(key("[sweep]\nspeeds_rad_per_s = [0.3]"), "sweep.range_rad.wheel");
    assert!(build(&gantry(), &(base + "amplitude_rad = { wheel = 7.0 }")).is_ok());
    let toml = "[sweep]\nspeeds_rad_per_s = [0.3]\nrange_rad = { wheel = [-7.0, 7.0] }";
    assert!(build(&gantry(), toml).is_ok());
    let urdf = r#"<robot name="r"><link name="base"/><link name="a"><inertial><mass value="1"/>
        <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
        <joint name="slide" type="revolute"><parent link="base"/><child link="a"/>
        <limit lower="-1" upper="1" velocity="0" effort="0"/></joint></robot>"#;
    let mut slow = Robot::from_urdf(urdf).unwrap();
    slow.link_mut(0).unwrap().joint.limits.velocity = None;
    let error = build(&slow, &sinusoids(1)).unwrap_err();
    assert_eq!(error.key(), "sinusoids.max_speed_rad_per_s.slide");
    let toml = sinusoids(1) + "max_speed_rad_per_s = { slide = 0.01 }";
    let motion = build(&slow, &toml).unwrap();
    let fastest = (0..2000).map(|k| motion.at(0.01 * f64::from(k)).qd[0].abs());
    let fastest = fastest.fold(0.0, f64::max);
    assert!(fastest <= 0.01 && fastest > 0.009_9, "{fastest}");
}
