//! `<actuator>`: what a joint's motor can do, and the gains of its servo.

use crate::error::RobotError;
use crate::mjcf::classes::MAIN;
use crate::mjcf::element::Element;
use crate::mjcf::joint::largest;
use crate::mjcf::view::View;
use crate::structure::control::PdGain;

/// What an actuator says of its joint.
#[derive(Debug, Clone, PartialEq)]
pub struct Motor {
    pub joint: String,
    /// Largest torque or force at the joint.
    pub effort: Option<f64>,
    /// Gains of a servo that holds a position.
    pub gain: Option<PdGain>,
    /// Lag of the torque (s).
    pub lag_s: Option<f64>,
    /// Delay of the control (s): of the goal of a servo, else of the torque.
    pub delay_s: Option<f64>,
}

/// The motors of the joints; an actuator of something else is counted.
///
/// ```text
/// force = gear (kp (target - q) - kv qd)     <position>, <general> with bias 0 -kp -kv
/// ```
pub fn motors<'a>(
    root: &'a Element,
    view: impl Fn(&'a Element, &'a str) -> View<'a>,
) -> Result<(Vec<Motor>, usize), RobotError> {
    let (mut motors, mut others) = (vec![], 0);
    for element in root.all("actuator").flat_map(|list| &list.children) {
        let view = view(element, MAIN);
        let Some(joint) = view.text("joint") else {
            others += 1;
            continue;
        };
        let gear = view.numbers("gear", 6)?.and_then(|g| g.first().copied()).unwrap_or(1.0);
        let range = |key: &str| view.exactly::<2>(key).map(|r| r.map(largest));
        let own = match element.name.as_str() {
            "motor" => range("forcerange")?.or(range("ctrlrange")?),
            _ => range("forcerange")?,
        };
        let filtered = matches!(view.text("dyntype"), Some("filter" | "filterexact"));
        let lag = view.numbers("dynprm", 10)?.and_then(|p| p.first().copied());
        motors.push(Motor {
            joint: joint.to_owned(),
            effort: own.map(|limit| limit * gear.abs()).filter(|limit| *limit > 0.0),
            gain: gain(&view, gear)?,
            lag_s: lag.filter(|lag| filtered && *lag > 0.0),
            delay_s: view.number("delay")?.filter(|delay| *delay > 0.0),
        });
    }
    Ok((motors, others))
}

fn gain(view: &View<'_>, gear: f64) -> Result<Option<PdGain>, RobotError> {
    let [kp, kd] = match view.element.name.as_str() {
        "position" => [view.number("kp")?.unwrap_or(1.0), view.number("kv")?.unwrap_or(0.0)],
        "general" if view.text("biastype") == Some("affine") => {
            let bias = view.numbers("biasprm", 10)?.unwrap_or_default();
            [-bias.get(1).unwrap_or(&0.0), -bias.get(2).unwrap_or(&0.0)]
        }
        _ => return Ok(None),
    };
    let at_joint = gear * gear;
    Ok((kp > 0.0 && kd >= 0.0).then_some(PdGain { kp: at_joint * kp, kd: at_joint * kd }))
}
