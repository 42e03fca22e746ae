use robot::{Actuator, Inertia, Link, Loaded, Robot};

use crate::actuator::isaac_lab::in_steps;
use crate::fate::Fate;
use crate::fates::fate_of;
use crate::format::Format;
use crate::quantity::{DriveQuantity, levels, quantities};
use crate::servo::Servo;
use crate::{mjcf, usd};

/// The robot that a file of `format` describes, made from `reported`, whose positions are the reported ones.
///
/// Dropped quantities become those of an ideal drive. Approximated ones are as written: an MJCF has a constant torque
/// as a soft spring and raised moments, a USD layer has no friction beyond the Coulomb level in motion. A URDF has
/// the default gravity of its readers, and an SDF a world with gravity of the robot's magnitude. A file of servos has
/// their quantities alone; the bodies are those of `reported`.
pub(crate) fn robot_in_file(loaded: &Loaded, reported: &Robot, format: Format) -> Robot {
    let mut held = reported.clone();
    if format == Format::Urdf {
        held = held.with_gravity(loaded.robot_in_urdf.gravity_in_base());
    }
    for (index, link) in reported.links().iter().enumerate() {
        let Some(new) = held.link_mut(index) else { continue };
        new.inertia = inertia(&link.inertia, format);
        for (quantity, _) in quantities(reported, link) {
            match fate_of(quantity, link, format) {
                Fate::Dropped { .. } => leave_out(quantity, &mut new.actuator),
                Fate::Exact { .. } | Fate::Approximated { .. } => {
                    write(quantity, link, format, &mut new.actuator);
                }
            }
        }
    }
    held
}

/// A body as written.
fn inertia(inertia: &Inertia, format: Format) -> Inertia {
    match format {
        Format::Mjcf if !inertia.is_positive_definite() => {
            mjcf::write::with_possible_moments(inertia)
        }
        Format::Isaac if !inertia.is_positive_definite() => {
            usd::write::without_negative_moments(inertia)
        }
        _ => inertia.clone(),
    }
}

/// Applies the approximation with which a format writes a quantity.
fn write(quantity: DriveQuantity, link: &Link, format: Format, drive: &mut Actuator) {
    match (quantity, format) {
        // The constant torque is in the rest of the spring.
        (DriveQuantity::Asymmetry, Format::Mjcf) => {
            if let Some([stiffness, cubic, rest]) = mjcf::joint::springs(link) {
                drive.spring_stiffness = stiffness;
                drive.spring_cubic = cubic;
                drive.spring_rest = rest;
            }
            leave_out(quantity, drive);
        }
        // The level at rest is gone at once in motion.
        (DriveQuantity::Stribeck, Format::Isaac | Format::ActuatorIsaac) => drive.stribeck = None,
        (DriveQuantity::GoalDelay, Format::ActuatorIsaac) => {
            let late_s = Servo::of(link).map_or(0.0, |servo| servo.late_s);
            drive.goal_delay_s += in_steps(late_s) - late_s;
        }
        _ => {}
    }
}

/// Resets a quantity to that of an ideal drive.
fn leave_out(quantity: DriveQuantity, drive: &mut Actuator) {
    use DriveQuantity as Q;
    let (mean, difference) = levels(drive);
    match quantity {
        Q::Rotor => drive.rotor_inertia = 0.0,
        Q::Viscous => drive.viscous = 0.0,
        Q::Coulomb => [drive.coulomb_forward, drive.coulomb_backward] = [difference, -difference],
        Q::Asymmetry => [drive.coulomb_forward, drive.coulomb_backward] = [mean; 2],
        Q::Stribeck => drive.stribeck = None,
        Q::LoadFriction => drive.load_friction = 0.0,
        Q::Presliding => (drive.presliding, drive.presliding_damping) = (None, None),
        Q::FrictionWave => drive.friction_wave = None,
        Q::Warming => drive.warming = None,
        Q::Ripple => drive.ripple = None,
        Q::Coupling => drive.coupling = None,
        Q::Spring => drive.spring_stiffness = 0.0,
        Q::SpringCubic => drive.spring_cubic = 0.0,
        Q::SpringHysteresis => drive.spring_hysteresis = 0.0,
        Q::Counterbalance => drive.counterbalance = None,
        Q::EffortGain => drive.torque_gain = 1.0,
        Q::EffortOffset => drive.torque_offset = 0.0,
        Q::Backlash => drive.backlash = 0.0,
        Q::Elasticity => (drive.elasticity, drive.elasticity_damping) = (None, None),
        Q::Delay => drive.delay_s = 0.0,
        Q::Lag => drive.lag_s = 0.0,
        Q::EncoderOffset => drive.encoder_offset = 0.0,
        Q::Ratio => drive.transmission_ratio = 1.0,
        Q::Skew => drive.effort_skew_s = 0.0,
        Q::GoalDelay => drive.goal_delay_s = 0.0,
        // Efforts of a log were computed with both when it was read.
        Q::Loop | Q::GoalHold => {}
    }
}
