use checks::arms::wam;
use effects::{Hypothesis, Place};
use nalgebra::Vector3;
use robot::Robot;
use simulator::Plant;

use crate::rig::effects as stated;

/// The parameters of an effect as it states them, and as the model side reads them off the robot
/// that it has changed.
fn truth_and_reading(robot: &Robot, toml: &str) -> Vec<(f64, f64)> {
    let effect = &stated(&format!("[[effect]]\n{toml}"))[0];
    let truth = effect.truth();
    let joint = truth.joint.as_ref().and_then(|name| robot.joint_index(name));
    let link = truth.link.as_ref().and_then(|n| robot.links().iter().position(|l| l.name == *n));
    let place = joint.map(Place::Joint).or(link.map(Place::Link)).unwrap_or(Place::Base);
    let mut plant = Plant::new(robot.clone());
    effect.inject(robot).unwrap().on_build(&mut plant);
    let quantities = Hypothesis { kind: truth.effect, place }.quantities(robot, &plant.robot);
    assert_eq!(quantities.len(), truth.parameters.len(), "{toml}");
    quantities.iter().map(|q| (truth.parameters[q.name], q.value)).collect()
}

/// The two sides of the wall mean the same by a parameter.
#[test]
fn contract_the_model_side_reads_the_truth_off_the_changed_robot() {
    let link = wam().links()[6].name.clone();
    let cases = [
        format!("payload = {{ link = '{link}', mass_kg = 1.2, com_m = [0.01, -0.02, 0.1] }}"),
        format!(
            "inertial_parameters = {{ link = '{link}', mass_kg = 0.9, com_m = [0.01, -0.02, 0.1] }}"
        ),
        "gravity_direction = { tilt_x_rad = 0.03, tilt_y_rad = -0.02 }".to_owned(),
        "torque_constant = { joint = 'j4_elbow_pitch', gain = 0.93 }".to_owned(),
        "torque_offset = { joint = 'j4_elbow_pitch', offset_nm = -0.2 }".to_owned(),
    ];
    let down = [[0.0, 0.0, -9.81], [-9.81, 0.0, 0.0], [3.0, -4.0, 8.0], [9.0, 2.0, -3.0]];
    for gravity in down {
        let robot = wam().with_gravity(Vector3::from(gravity));
        for case in &cases {
            for (truth, reading) in truth_and_reading(&robot, case) {
                assert!((truth - reading).abs() < 1e-12, "{case}: {reading}, not {truth}");
            }
        }
    }
}
