//! Goals that reach the controller late: servos follow `goal(t - delay)` with either delay, and a controller that knows
//! the rate of its reference as well.

use robot::Robot;
use simulator::scenario::Scenario;

use crate::scenario::document;

const DELAY_S: f64 = 0.03;

/// A run of 0.4 s at 500 Hz.
fn log(more: &[&str]) -> (Scenario, logs::Run) {
    let mut document = document("");
    document.set("sensors.effort=commanded").unwrap();
    more.iter().for_each(|setting| document.set(setting).unwrap());
    let scenario = Scenario::from_document(&document).unwrap();
    let run = simulator::simulate(&scenario, &|| {}).unwrap().runs.remove(0);
    (scenario, run)
}

/// An effect of 20 ms beside the servo's own 10 ms is the servo with 30 ms, to the last digit.
#[test]
fn a_servo_has_one_delay_whatever_its_parts_are() {
    let servo =
        |delay_ms| format!("control.servo={{ goal_rate_hz = 50.0, goal_delay_ms = {delay_ms:?} }}");
    let (_, parts) = log(&[&servo(10.0), "effect=[{ goal_delay = { delay_ms = 20.0 } }]"]);
    let (_, whole) = log(&[&servo(30.0)]);
    assert_eq!(parts.joints, whole.joints);
    let (_, less) = log(&[&servo(10.0)]);
    assert_ne!(parts.joints, less.joints);
}

/// `tau = kp (ref(t - delay) - q) + kd (dref(t - delay)/dt - qd)`, and the log has `ref(t)`.
#[test]
fn oracle_the_torque_of_a_controller_is_that_of_an_earlier_reference() {
    let (scenario, run) = log(&["effect=[{ goal_delay = { delay_ms = 30.0 } }]"]);
    let motion = &scenario.runs()[0].motion;
    let gains = Robot::load(scenario.robot_file()).unwrap().control.gains;
    for (k, &t) in run.time.iter().enumerate() {
        let (sent, followed) = (motion.at(t), motion.at((t - DELAY_S).max(0.0)));
        for (j, joint) in run.joints.iter().enumerate() {
            let gain = gains[j].unwrap();
            assert!((joint.desired_position.as_ref().unwrap()[k] - sent.q[j]).abs() < 1e-12);
            let (q, qd) = (joint.position[k], joint.velocity.as_ref().unwrap()[k]);
            let limit = scenario.robot().links()[j].joint.limits.effort.unwrap();
            let tau = gain.kp * (followed.q[j] - q) + gain.kd * (followed.qd[j] - qd);
            let tau = tau.clamp(-limit, limit);
            assert!((joint.effort[k] - tau).abs() < 1e-9 * limit, "{t} s: {}", joint.name);
        }
    }
}
