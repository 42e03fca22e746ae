//! The robot that a file describes: read again, it needs the torque that the export says is left.

use exchange::{Format, export};
use robot::Robot;

use crate::rich::{DRIVES, states, torque, urdf, wam_with};

/// Without the motors that two joints share: the reader of MJCF knows no tendons.
fn drives() -> String {
    DRIVES.lines().filter(|line| !line.starts_with("coupling")).map(|l| format!("{l}\n")).collect()
}

/// Largest difference of the torques of two robots (N·m).
fn apart(a: &Robot, b: &Robot) -> f64 {
    let of =
        |robot: &Robot| states(7, 20).iter().flat_map(|s| torque(robot, s)).collect::<Vec<_>>();
    of(a).iter().zip(of(b)).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
}

#[test]
fn a_file_read_again_needs_the_torque_of_the_robot_that_it_is_said_to_hold() {
    for format in [Format::Urdf, Format::Mjcf] {
        let folder = tempfile::tempdir().unwrap();
        let loaded = wam_with(folder.path(), &drives());
        let export = export(&loaded, &urdf(), format).unwrap();
        let path = folder.path().join(format!("again.{}", format.extension()));
        std::fs::write(&path, &export.text).unwrap();
        let again = Robot::load(&path).unwrap().robot;
        let off = apart(&again, &export.robot);
        assert!(off < 1e-9, "{}: {off} N·m apart", format.name());
        let lost = apart(&loaded.robot, &export.robot);
        match format {
            Format::Mjcf => assert!(lost < 3e-4, "{lost} N·m of a soft spring"),
            _ => assert!(lost > 1.0, "{lost} N·m: rotors and springs have no place there"),
        }
    }
}

#[test]
fn what_a_format_drops_is_that_of_an_ideal_drive() {
    let folder = tempfile::tempdir().unwrap();
    let loaded = wam_with(folder.path(), DRIVES);
    let of = |format| export(&loaded, &urdf(), format).unwrap().robot;
    let [urdf, sdf, isaac] = [Format::Urdf, Format::Sdf, Format::Isaac].map(of);
    let drive = |robot: &Robot, joint: usize| robot.links()[joint].actuator.clone();
    assert_eq!([&urdf, &sdf, &isaac].map(|r| drive(r, 0).rotor_inertia), [0.0, 0.0, 0.205]);
    for robot in [&urdf, &sdf, &isaac] {
        let first = drive(robot, 0);
        assert_eq!(
            [first.coulomb_forward, first.coulomb_backward, first.viscous],
            [1.75, 1.75, 0.7]
        );
        assert_eq!(drive(robot, 0).encoder_offset, 0.0);
        let [moved, given] = [robot, &loaded.robot].map(|r| r.links()[0].joint.parent_from_joint);
        assert!((moved.rotation.angle_to(&given.rotation) - 0.1).abs() < 1e-12);
        assert_eq!(drive(robot, 1).coupling, None);
        assert_eq!([drive(robot, 2).delay_s, drive(robot, 2).lag_s], [0.0, 0.0]);
    }
    let spring = |robot: &Robot| [drive(robot, 1).spring_stiffness, drive(robot, 1).spring_cubic];
    assert_eq!([spring(&urdf), spring(&sdf), spring(&isaac)], [[0.0; 2], [3.0, 0.0], [3.0, 0.0]]);
    let gravity = loaded.robot.gravity_in_base();
    assert_eq!(isaac.gravity_in_base(), gravity);
    assert_eq!(urdf.gravity_in_base(), loaded.robot_in_urdf.gravity_in_base());
    assert!(urdf.gravity_in_base() != gravity);
}
