use robot::{Link, Loaded};

use crate::fate::{Fate, QuantityFate};
use crate::format::Format;
use crate::numbers::size;
use crate::quantity::{DriveQuantity, quantities};
use crate::{actuator, mjcf, sdf, urdf, usd};

/// What becomes of every quantity of a robot in the description of one.
pub(crate) fn fates(loaded: &Loaded, format: Format) -> Vec<QuantityFate> {
    let robot = &loaded.robot;
    let mut fates = vec![];
    let gravity = robot.gravity_in_base();
    if gravity != loaded.robot_in_urdf.gravity_in_base() {
        let [x, y, z] = [gravity.x, gravity.y, gravity.z].map(size);
        let fate = match format {
            Format::Urdf => Fate::omit("a URDF has no gravity: turn the base by as much"),
            Format::Mjcf => Fate::exact("<option gravity>"),
            Format::Sdf => Fate::near("<pose> of the model; its length is the world's"),
            _ => Fate::exact("gravityDirection, gravityMagnitude of a PhysicsScene"),
        };
        let what = format!("gravity ({x}, {y}, {z}) m/s²");
        fates.push(QuantityFate { at: "robot".to_owned(), what, fate });
    }
    fates.extend(mjcf::position::option_fate(robot).filter(|_| format == Format::Mjcf));
    for (link, old) in robot.links().iter().zip(loaded.robot_in_urdf.links()) {
        let is_told = matches!(format, Format::Mjcf | Format::Isaac);
        let is_impossible = is_told && !link.inertia.is_positive_definite();
        if link.inertia != old.inertia || is_impossible {
            fates.push(inertia(link, format));
        }
        for (quantity, what) in quantities(robot, link) {
            let fate = fate_of(quantity, link, format);
            fates.push(QuantityFate { at: link.joint.name.clone(), what, fate });
        }
    }
    for lock in &loaded.locked {
        let fate = match format {
            Format::Urdf => Fate::omit("the joint moves in the file, as it did before"),
            _ => Fate::exact("what it carries is part of the body it is fixed to"),
        };
        let what = format!("locked at {}", size(lock.position));
        fates.push(QuantityFate { at: lock.joint.clone(), what, fate });
    }
    fates
}

/// How a format represents a quantity of a joint.
pub(crate) fn fate_of(quantity: DriveQuantity, link: &Link, format: Format) -> Fate {
    match format {
        Format::Urdf => urdf::edit::fate(quantity),
        Format::Mjcf => mjcf::write::fate(quantity, link),
        Format::Sdf => sdf::fate(quantity, link),
        Format::Isaac => usd::joint::fate(quantity, link),
        Format::ActuatorMjcf | Format::ActuatorIsaac | Format::ActuatorBam => {
            actuator::fates::fate(quantity, link, format)
        }
    }
}

fn inertia(link: &Link, format: Format) -> QuantityFate {
    let fate = match (format, link.inertia.is_positive_definite()) {
        (Format::Urdf, _) if !link.merged.is_empty() => {
            Fate::exact("<inertial> of the link; links fixed to it keep theirs")
        }
        (Format::Mjcf, false) => {
            Fate::near("no body has such moments: they are raised to what MuJoCo takes")
        }
        (Format::Isaac, false) => Fate::near(
            "no body has such moments: those below 0 are written as 0, which PhysX fills in",
        ),
        (Format::Isaac, true) => Fate::exact("PhysicsMassAPI"),
        _ => Fate::exact("<inertial>"),
    };
    let what = format!("mass {} kg, centre, moments", size(link.inertia.mass));
    QuantityFate { at: link.name.clone(), what, fate }
}
