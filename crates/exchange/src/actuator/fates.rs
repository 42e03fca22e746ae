//! What becomes of the quantities of a servo in the files of servos.

use robot::{Link, Loaded, PdGain, Robot};

use crate::actuator::bam::{self, SUPPLY_V};
use crate::actuator::isaac_lab::{USUAL_STEP_S, in_steps};
use crate::fate::{Fate, QuantityFate};
use crate::format::Format;
use crate::mjcf;
use crate::mjcf::position::{option_fate, servo_fate};
use crate::numbers::{milliseconds, size};
use crate::quantity::{DriveQuantity as Q, quantities};
use crate::servo::{Servo, goal_delay};
use crate::unsupported::fate_of_unsupported;
use crate::usd;

/// What becomes of every quantity of the servos of `robot`, which has the gains of its controller as position loops.
pub fn fates(loaded: &Loaded, robot: &Robot, format: Format) -> Vec<QuantityFate> {
    let options = option_fate(robot).filter(|_| format == Format::ActuatorMjcf);
    let pairs = robot.links().iter().zip(loaded.robot.links());
    let joints = pairs.flat_map(|(link, described)| of_joint(robot, link, described, format));
    options.into_iter().chain(joints).collect()
}

fn of_joint(robot: &Robot, link: &Link, described: &Link, format: Format) -> Vec<QuantityFate> {
    let row = |what: String, fate| QuantityFate { at: link.joint.name.clone(), what, fate };
    if let Some(reason) = refusal(link, format) {
        return vec![row("servo".to_owned(), Fate::omit(reason))];
    }
    let has_controller = described.actuator.position_loop.is_none();
    let mut rows: Vec<QuantityFate> = vec![];
    for (quantity, what) in quantities(robot, link) {
        let mut told = fate(quantity, link, format);
        if quantity == Q::Loop && has_controller {
            told = without_rate(link, &told);
        }
        rows.push(row(what, told));
    }
    rows.extend(limit(link, format).map(|(what, fate)| row(what, fate)));
    rows
}

/// A loop in place of a controller that follows the velocity of its reference as well.
///
/// ```text
/// kp (ref - q) + kd (dref/dt - qd) = kp (goal - q) - kd qd,   goal = ref + kd / kp dref/dt
/// ```
fn without_rate(link: &Link, told: &Fate) -> Fate {
    let Some(PdGain { kp, kd }) = link.actuator.position_loop else { return told.clone() };
    Fate::near(format!(
        "{told}; the velocity of a goal is not followed, which makes it {} ms late",
        size(milliseconds(kd / kp))
    ))
}

/// Why a format has nothing of a joint's servo.
fn refusal(link: &Link, format: Format) -> Option<&'static str> {
    let Some(servo) = Servo::of(link) else {
        return Some("the joint has no position loop");
    };
    bam::law(link, &servo).err().filter(|_| format == Format::ActuatorBam)
}

/// How a file of servos represents a quantity of a drive.
pub fn fate(quantity: Q, link: &Link, format: Format) -> Fate {
    if let Some(reason) = refusal(link, format) {
        return Fate::omit(reason);
    }
    let Some(servo) = Servo::of(link) else { return fate_of_unsupported(quantity) };
    let whole = match format {
        Format::ActuatorIsaac => usd::joint::fate(quantity, link),
        _ => mjcf::write::fate(quantity, link),
    };
    match quantity {
        Q::Rotor | Q::Viscous | Q::Coulomb | Q::Stribeck | Q::LoadFriction => {
            friction(quantity, link, format, whole)
        }
        Q::Loop | Q::GoalDelay | Q::EffortGain | Q::EffortOffset | Q::Delay | Q::Lag => {
            of_loop(quantity, link, &servo, format)
        }
        _ => match whole {
            Fate::Dropped { .. } => whole,
            _ if format == Format::ActuatorIsaac => {
                Fate::omit("it is no part of an actuator: export --to isaac has it")
            }
            _ => Fate::omit("it is no part of an actuator: export --to mjcf has it"),
        },
    }
}

/// Friction and rotor; `whole` is what becomes of them in the description of a robot.
fn friction(quantity: Q, link: &Link, format: Format, whole: Fate) -> Fate {
    let load = link.actuator.load_friction;
    match (format, quantity) {
        (Format::ActuatorMjcf, _) => whole,
        (Format::ActuatorIsaac, _) if matches!(whole, Fate::Dropped { .. }) => whole,
        (Format::ActuatorIsaac, Q::Rotor) => Fate::exact("armature"),
        (Format::ActuatorIsaac, Q::Viscous) => Fate::exact("viscous_friction"),
        (Format::ActuatorIsaac, Q::Coulomb) => Fate::exact("dynamic_friction"),
        (Format::ActuatorIsaac, _) => {
            Fate::near("friction is higher by it, at rest and gone at once in motion")
        }
        (_, Q::Rotor) => Fate::exact("armature"),
        (_, Q::Viscous) => Fate::exact("friction_viscous"),
        (_, Q::Coulomb) => Fate::exact("friction_base"),
        (_, Q::Stribeck) => Fate::exact("friction_stribeck, dtheta_stribeck, alpha = 2"),
        _ => Fate::near(format!(
            "load_friction_base, half of it; friction counts as load there, {} % of the level, and the load of an \
             acceleration counts half",
            size(50.0 * load)
        )),
    }
}

fn of_loop(quantity: Q, link: &Link, servo: &Servo, format: Format) -> Fate {
    let a = &link.actuator;
    match (format, quantity) {
        (_, Q::Delay) => servo.late_torque(a.delay_s, link),
        (_, Q::Lag) => servo.late_torque(a.lag_s, link),
        (Format::ActuatorMjcf, _) => servo_fate(quantity, link),
        (Format::ActuatorIsaac, Q::Loop) => Fate::exact("stiffness and damping"),
        (Format::ActuatorIsaac, Q::GoalDelay) => whole_steps(servo.late_s),
        (Format::ActuatorIsaac, Q::EffortGain) => {
            Fate::exact("stiffness and damping, divided by it")
        }
        (_, Q::Loop) => Fate::exact(&format!(
            "kt, R and kp for a supply of {} V; the torque is the same for any",
            size(SUPPLY_V)
        )),
        (_, Q::GoalDelay) => goal_delay(link, "command_delay"),
        (_, Q::EffortGain) => Fate::exact("kt, R and kp"),
        _ => {
            let [torque, goal] = [servo.constant, servo.constant / servo.goal_gain].map(size);
            let unit = if link.joint.kind.is_rotation() { ["N·m", "rad"] } else { ["N", "m"] };
            Fate::omit(&format!(
                "the loop has no constant: add {torque} {} to its torque, or {goal} {} to its goals",
                unit[0], unit[1]
            ))
        }
    }
}

/// A delay in whole steps of a simulation.
fn whole_steps(late_s: f64) -> Fate {
    let written_s = in_steps(late_s);
    let steps = (written_s / USUAL_STEP_S).round();
    let [step, written, off] =
        [USUAL_STEP_S, written_s, written_s - late_s].map(|s| size(milliseconds(s)));
    Fate::near(format!(
        "min_delay and max_delay in whole steps of physics_dt: {steps} of {step} ms are {written} ms, {off} ms off"
    ))
}

/// The limit of a joint's torque and what becomes of it.
fn limit(link: &Link, format: Format) -> Option<(String, Fate)> {
    let limit = link.joint.limits.effort?;
    let servo = Servo::of(link)?;
    let fate = match format {
        Format::ActuatorMjcf => Fate::exact("forcerange of the actuator"),
        Format::ActuatorIsaac => Fate::exact("effort_limit"),
        _ => {
            let off = size(servo.kd);
            Fate::near(format!(
                "max_pwm limits kp (goal - q) alone: with kd qd the torque is off by up to {off} N·m at 1 rad/s"
            ))
        }
    };
    let unit = if link.joint.kind.is_rotation() { "N·m" } else { "N" };
    Some((format!("torque limit {} {unit}", size(limit)), fate))
}
