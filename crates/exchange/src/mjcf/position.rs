//! Actuators that follow a goal.

use robot::{Link, Robot};

use crate::fate::{Fate, QuantityFate};
use crate::numbers::{number, numbers};
use crate::quantity::DriveQuantity as Q;
use crate::servo::{Servo, goal_delay};
use crate::unsupported::fate_of_unsupported;
use crate::xml_text::XmlText;

/// Shortest step of a simulation whose history of controls reaches back over a delay (s), a quarter of MuJoCo's default.
const SHORTEST_STEP_S: f64 = 0.0005;

/// Integrator and step (s) with which the velocity that damps a loop is on time.
///
/// MuJoCo's Euler takes the velocity of a position half a step late, which takes `kd step / 2` off the inertia.
pub const SERVO_OPTIONS: [(&str, &str); 2] = [("integrator", "RK4"), ("timestep", "0.002")];

/// [`SERVO_OPTIONS`] as attributes.
pub fn servo_options() -> impl Iterator<Item = (&'static str, String)> {
    SERVO_OPTIONS.into_iter().map(|(key, value)| (key, value.to_owned()))
}

/// What the options of a servo stand for, where a robot has one.
pub fn option_fate(robot: &Robot) -> Option<QuantityFate> {
    let at = "robot".to_owned();
    robot.links().iter().any(|link| Servo::of(link).is_some()).then(|| QuantityFate {
        at,
        what: "step of the position loops 2 ms".to_owned(),
        fate: Fate::exact(
            "<option integrator=\"RK4\" timestep=\"0.002\">: keep it, Euler has the velocity half a step late, \
             which takes kd step / 2 off the inertia",
        ),
    })
}

/// An actuator whose control is the goal in reported positions.
///
/// ```text
/// force = gainprm[0] ctrl(t - delay) + biasprm[0] + biasprm[1] q + biasprm[2] qd     <general>
///       = kp (ctrl(t - delay) - q) - kv qd                                           <position>
/// ```
pub fn actuator(sheet: &mut XmlText, link: &Link, servo: &Servo) {
    let joint = &link.joint.name;
    let mut attributes = vec![("name", joint.clone()), ("joint", joint.clone())];
    let plain = (servo.goal_gain - servo.kp).abs() <= 0.0 && servo.constant.abs() <= 0.0;
    if plain {
        attributes.push(("kp", number(servo.kp)));
        attributes.push(("kv", number(servo.kd)));
    } else {
        let bias = [servo.constant, -servo.kp, -servo.kd];
        attributes.push(("gainprm", number(servo.goal_gain)));
        attributes.push(("biastype", "affine".to_owned()));
        attributes.push(("biasprm", numbers(&bias)));
    }
    if let Some(limit) = servo.limit {
        attributes.push(("forcerange", numbers(&[-limit, limit])));
    }
    attributes.extend(history(servo.late_s));
    sheet.leaf(if plain { "position" } else { "general" }, &attributes);
}

/// The delay of an actuator's control: between two steps of the simulation on a line.
///
/// A history of fewer samples than the delay has steps would cut the delay short.
pub fn history(delay_s: f64) -> Vec<(&'static str, String)> {
    if delay_s <= 0.0 {
        return vec![];
    }
    let samples = (delay_s / SHORTEST_STEP_S).ceil() + 2.0;
    vec![("delay", number(delay_s)), ("nsample", number(samples)), ("interp", "linear".to_owned())]
}

/// How a position actuator of MuJoCo represents a quantity of its drive.
pub fn servo_fate(quantity: Q, link: &Link) -> Fate {
    let Some(servo) = Servo::of(link) else { return fate_of_unsupported(quantity) };
    let a = &link.actuator;
    match quantity {
        Q::Loop => Fate::exact("kp and kv of the actuator"),
        Q::GoalDelay => goal_delay(
            link,
            "delay of the actuator (MuJoCo 4); its history starts with goals of 0: mj_initCtrlHistory",
        ),
        Q::EffortGain => Fate::exact("kp and kv of the actuator, divided by it"),
        Q::EffortOffset => Fate::exact("biasprm of the actuator"),
        Q::Delay => servo.late_torque(a.delay_s, link),
        Q::Lag => servo.late_torque(a.lag_s, link),
        other => fate_of_unsupported(other),
    }
}
