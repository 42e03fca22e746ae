use nalgebra::{Matrix3, Vector3};
use proptest::prelude::*;
use robot::{
    FrictionWave, Inertia, Loaded, Ripple, Robot, RobotError, SensingSide, Stribeck, TorqueSource,
    Warming,
};

use super::{in_workspace, wam};

/// Writes `robot` beside a copy of its URDF and loads it again.
fn through_a_file(original: &Loaded, robot: &Robot) -> Loaded {
    let folder = tempfile::tempdir().unwrap();
    std::fs::copy(&original.urdf_path, folder.path().join("arm.urdf")).unwrap();
    let text = original.to_toml(robot, "arm.urdf").unwrap();
    let path = folder.path().join("extended.toml");
    std::fs::write(&path, &text).unwrap();
    Robot::load(&path).unwrap_or_else(|e| panic!("{e}\n{text}"))
}

#[test]
fn an_unchanged_robot_makes_the_round_trip_with_its_control_settings() {
    let original = wam();
    let again = through_a_file(&original, &original.robot);
    assert_eq!(again.robot, original.robot);
    assert_eq!(again.control, original.control);
}

#[test]
fn only_what_differs_is_written() {
    let original = Robot::load(&in_workspace("robots/wam7/robot.urdf")).unwrap();
    let mut robot = original.robot.clone();
    robot.link_mut(1).unwrap().actuator.viscous = 1.25;
    let text = original.to_toml(&robot, "robot.urdf").unwrap();
    let expected =
        "urdf = \"robot.urdf\"\n\n[joint.j2_shoulder_pitch]\nviscous_nm_s_per_rad = 1.25\n";
    assert_eq!(text, expected);
}

#[test]
fn a_limit_that_is_taken_away_stays_away() {
    let original = wam();
    let mut robot = original.robot.clone();
    robot.link_mut(0).unwrap().joint.limits.effort = None;
    assert_eq!(through_a_file(&original, &robot).robot, robot);
}

#[test]
fn what_the_file_cannot_say_is_refused() {
    let original = wam();
    let mut robot = original.robot.clone();
    robot.link_mut(2).unwrap().joint.limits.velocity = None;
    let error = original.to_toml(&robot, "robot.urdf").unwrap_err();
    let thing = "joint j3_shoulder_yaw".to_owned();
    let quantity = "name, origin, axis or limit";
    assert_eq!(error, RobotError::NotDescribable { thing, quantity });

    let mut robot = original.robot.clone();
    robot.link_mut(2).unwrap().inertia.mass = -1.0;
    let error = original.to_toml(&robot, "robot.urdf").unwrap_err();
    assert_eq!(
        error.to_string(),
        "robot.toml:71:11: link.upper_arm.mass_kg: mass_kg is -1, a finite number above 0 was expected"
    );
}

fn number() -> impl Strategy<Value = f64> {
    prop_oneof![
        -100.0..100.0f64,
        Just(0.0),
        Just(-0.0),
        Just(1.0),
        Just(f64::MIN_POSITIVE),
        Just(1e11),
        (-300i32..11).prop_map(|e| 1.1 * 10f64.powi(e)),
    ]
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(200))]

    #[test]
    fn any_change_of_actuators_inertias_and_gravity_makes_the_round_trip_exactly(
        joint in 0usize..7,
        drive in prop::array::uniform6(number()),
        positive in prop::array::uniform4(1e-12..1e6f64),
        body in prop::array::uniform9(number()),
        gravity in prop::array::uniform3(number()),
        sides in (0usize..3, 0usize..4),
        transmission in (0.0..0.5f64, prop::option::of(1e-3..1e9f64), 0.0..1000.0f64),
        dry in prop::option::of((0.0..10.0f64, 1e-9..10.0f64, 0.0..2.0f64, 1e-9..0.1f64)),
        waves in prop::option::of((0.0..=1.0f64, 0.0..1e4f64, number(), 0.0..5.0f64)),
        sensor in (0.0..1000.0f64, number(), 1e-3..1e3f64),
    ) {
        let original = wam();
        let mut robot = original.robot.clone().with_gravity(Vector3::from(gravity));
        let link = robot.link_mut(joint).unwrap();
        let a = &mut link.actuator;
        [a.viscous, a.coulomb_forward, a.coulomb_backward, a.spring_stiffness, a.spring_rest, a.torque_offset] = drive;
        [a.rotor_inertia, a.torque_gain, _, _] = positive;
        a.backlash = transmission.0;
        a.elasticity = transmission.1;
        a.elasticity_damping = a.elasticity.map(|k| 1e-3 * k);
        a.delay_s = 1e-3 * transmission.2;
        a.stribeck = dry.map(|(excess, velocity, ..)| Stribeck { excess, velocity });
        a.load_friction = dry.map_or(0.0, |(_, _, load, _)| load);
        (a.spring_cubic, a.spring_hysteresis) = (0.1 * sensor.0, dry.map_or(0.0, |(excess, ..)| excess));
        if a.spring_hysteresis > 0.0 {
            a.spring_stiffness = 1e-3 + a.spring_stiffness.abs();
        }
        a.presliding = dry.map(|(.., way)| way);
        a.presliding_damping = dry.map(|(_, velocity, ..)| velocity);
        a.friction_wave = waves.map(|(share, periods, phase, _)| FrictionWave { share, periods, phase });
        let share = |of: f64| waves.map_or(0.0, |(share, ..)| share * of.max(0.0));
        a.warming = waves.map(|(_, periods, ..)| Warming {
            viscous_lost: share(a.viscous),
            coulomb_lost: share(a.coulomb_forward.min(a.coulomb_backward)),
            time_constant_s: 1.0 + periods,
        });
        a.ripple = waves.map(|(_, periods, phase, amplitude)| Ripple { amplitude, periods, phase });
        a.lag_s = 1e-3 * sensor.0;
        a.effort_skew_s = -2e-3 * sensor.0;
        (a.encoder_offset, a.transmission_ratio) = (sensor.1, sensor.2);
        a.sensing = [SensingSide::Motor, SensingSide::Link, SensingSide::Unknown][sides.0];
        a.torque_source = [TorqueSource::Measured, TorqueSource::Commanded, TorqueSource::Current, TorqueSource::Unknown][sides.1];
        link.joint.limits.effort = Some(positive[2]);
        let [x, y, z, xx, xy, xz, yy, yz, zz] = body;
        link.inertia = Inertia {
            mass: positive[3],
            com_in_link: Vector3::new(x, y, z),
            about_com: Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz),
        };
        let again = through_a_file(&original, &robot);
        prop_assert_eq!(again.robot, robot);
        prop_assert_eq!(again.control, original.control);
    }
}
