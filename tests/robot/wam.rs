use nalgebra::{Isometry3, Point3};
use robot::{PdGain, Robot, SensingSide, TorqueSource};
use serde_json::Value;

use super::{in_workspace, wam};

/// Pinocchio prints every digit; what remains is the rounding of two ways to add.
const ROUNDING: f64 = 1e-14;

#[test]
fn oracle_inertial_parameters_agree_with_pinocchio() {
    let golden = std::fs::read_to_string(in_workspace("tests/golden/dynamics_wam7.json")).unwrap();
    let golden: Value = serde_json::from_str(&golden).unwrap();
    let robot = wam().robot;
    let names: Vec<&str> =
        golden["joints"].as_array().unwrap().iter().map(|n| n.as_str().unwrap()).collect();
    assert_eq!(robot.joint_names().collect::<Vec<_>>(), names);
    let expected = golden["inertial_parameters"].as_array().unwrap();
    assert_eq!(expected.len(), 7);
    for (link, expected) in robot.links().iter().zip(expected) {
        for (k, found) in link.inertia.parameters().iter().enumerate() {
            let expected = expected[k].as_f64().unwrap();
            let error = (found - expected).abs();
            assert!(error < ROUNDING, "{} parameter {k}: {found} is not {expected}", link.name);
        }
    }
}

#[test]
fn the_wam_is_what_its_readme_says() {
    let loaded = wam();
    let robot = &loaded.robot;
    assert_eq!(loaded.warnings, []);
    assert_eq!((loaded.base_link.as_str(), loaded.fixed_to_base.len()), ("world", 1));
    assert_eq!(robot.links()[6].merged, ["tool_plate"]);
    let mass: f64 = robot.links().iter().map(|l| l.inertia.mass).sum();
    assert!((mass - 19.4555).abs() < 1e-4, "moving mass {mass} kg");
    let tool = robot
        .links()
        .iter()
        .map(|l| l.joint.parent_from_child(0.0))
        .fold(Isometry3::identity(), |a, b| a * b);
    let plate = tool * Point3::new(0.0, 0.0, 0.06);
    assert!((plate - Point3::new(0.0, 0.0, 1.256)).amax() < 1e-12, "{plate}");
    let rotors: Vec<f64> = robot.links().iter().map(|l| l.actuator.rotor_inertia).collect();
    assert_eq!(rotors, [0.205, 0.189, 0.067, 0.0346, 0.0032, 0.0032, 0.00032]);
    let limits: Vec<_> = robot.links().iter().filter_map(|l| l.joint.limits.effort).collect();
    assert_eq!(limits, [75.6, 101.7, 60.5, 28.8, 11.6, 11.6, 1.37]);
    let drive = &robot.links()[3].actuator;
    assert_eq!((drive.sensing, drive.torque_source), (SensingSide::Motor, TorqueSource::Commanded));
    assert_eq!(loaded.control.rate_hz, Some(500.0));
    assert_eq!(loaded.control.gains[1], Some(PdGain { kp: 2500.0, kd: 20.0 }));
    assert_eq!(loaded.control.differentials, [[1, 2], [4, 5]]);
    let sets: Vec<&str> = loaded.control.gain_sets.keys().map(String::as_str).collect();
    assert_eq!(sets, ["compliant", "low-quarter", "low-tenth", "stiff"]);
}

#[test]
fn the_urdf_alone_knows_no_rotors() {
    let loaded = Robot::load(&in_workspace("robots/wam7/robot.urdf")).unwrap();
    assert!(loaded.robot.links().iter().all(|l| l.actuator.rotor_inertia == 0.0));
    assert_eq!(loaded.robot, wam().robot_in_urdf);
    assert_eq!(loaded.control.gains, [None; 7]);
}
