//! Servos that follow goals: what they are told, when they follow it, and with which torque.

use robot::Robot;
use simulator::scenario::Scenario;

use crate::scenario::document;

/// Log of the WAM as one of servos without friction: a run of 0.4 s at 500 Hz.
fn log(goal_rate_hz: f64, goal_delay_ms: f64) -> (Scenario, logs::Run) {
    let mut document = document("");
    let servo = format!("{{ goal_rate_hz = {goal_rate_hz:?}, goal_delay_ms = {goal_delay_ms:?} }}");
    document.set(&format!("control.servo={servo}")).unwrap();
    document.set("sensors.effort=commanded").unwrap();
    let scenario = Scenario::from_document(&document).unwrap();
    let run = simulator::simulate(&scenario, &|| {}).unwrap().runs.remove(0);
    (scenario, run)
}

/// `tau = kp (goal(t - delay) - q) - kd qd`, with `goal(t)` the motion at the last of times `k / rate`.
#[test]
fn oracle_the_torque_is_that_of_a_goal_which_is_held_and_late() {
    for (rate_hz, delay_ms) in [(50.0, 0.0), (50.0, 30.0), (125.0, 14.0), (500.0, 0.0)] {
        let (scenario, run) = log(rate_hz, delay_ms);
        let motion = &scenario.runs()[0].motion;
        let held = |t: f64| motion.at((t * rate_hz + 1e-6).floor().max(0.0) / rate_hz).q;
        let gains = Robot::load(scenario.robot_file()).unwrap().control.gains;
        for (k, &t) in run.time.iter().enumerate() {
            let (sent, followed) = (held(t), held(t - 1e-3 * delay_ms));
            for (j, joint) in run.joints.iter().enumerate() {
                let gain = gains[j].unwrap();
                let goal = joint.desired_position.as_ref().unwrap()[k];
                assert!((goal - sent[j]).abs() < 1e-12, "{goal}, not {} at {t} s", sent[j]);
                let (q, qd) = (joint.position[k], joint.velocity.as_ref().unwrap()[k]);
                let limit = scenario.robot().links()[j].joint.limits.effort.unwrap();
                let tau = gain.kp * (followed[j] - q) - gain.kd * qd;
                let tau = tau.clamp(-limit, limit);
                assert!((joint.effort[k] - tau).abs() < 1e-9 * limit, "{t} s: {}", joint.name);
            }
        }
        let told = &run.joints[0];
        assert!(told.desired_velocity.is_none() && told.desired_acceleration.is_none());
    }
}

#[test]
fn goals_that_no_servo_can_follow_are_underlined() {
    let mistakes = [
        ("control.servo={ goal_rate_hz = 0.5 }", "control.servo.goal_rate_hz", "from 1 to 500"),
        ("control.servo={ goal_rate_hz = 501.0 }", "control.servo.goal_rate_hz", "from 1 to 500"),
        (
            "control.servo={ goal_rate_hz = 50.0, goal_delay_ms = -1.0 }",
            "control.servo.goal_delay_ms",
            "from 0 to 1000",
        ),
    ];
    for (setting, key, words) in mistakes {
        let mut document = document("");
        document.set(setting).unwrap();
        let error = Scenario::from_document(&document).map(|_| ()).unwrap_err().to_string();
        assert!(error.contains(key) && error.contains(words), "{error}");
    }
}
