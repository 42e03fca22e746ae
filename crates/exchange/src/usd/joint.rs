//! Joints of a USD layer, with what PhysX and Newton read beside the schemas of USD itself.

use nalgebra::{Isometry3, UnitQuaternion, Vector3};
use robot::{JointKind, Link};

use crate::fate::Fate;
use crate::numbers::number;
use crate::quantity::{DriveQuantity, levels};
use crate::unsupported::fate_of_unsupported;
use crate::usd::text::{UsdText, rotation, vector};

/// The paths of the bodies that a joint connects.
pub struct Ends {
    pub parent: String,
    pub child: String,
}

/// A joint along the x axis of its frames, which are turned so that it is the joint's own.
///
/// Angles are in degrees, as USD has them: with `s = 180 / pi` at a rotation and 1 at a slide
///
/// ```text
/// limit = s q,   viscousFrictionCoefficient = damping = viscous / s,   stiffness = spring_stiffness / s
/// ```
///
/// Sources: PhysxJointAxisAPI of Isaac Sim 5, NewtonJointAPI of newton-usd-schemas 0.6.
pub fn joint(text: &mut UsdText, prim: &str, ends: &Ends, link: &Link) {
    let (joint, a) = (&link.joint, &link.actuator);
    let rotates = joint.kind.is_rotation();
    let (kind, axis) = if rotates { ("Revolute", "angular") } else { ("Prismatic", "linear") };
    let scale = if rotates { 1f64.to_degrees() } else { 1.0 };
    let mut schemas: Vec<String> =
        ["PhysicsDriveAPI", "PhysxJointAxisAPI"].map(|api| format!("{api}:{axis}")).into();
    schemas.push("NewtonJointAPI".to_owned());
    text.open(&format!("Physics{kind}Joint"), prim, &schemas);
    text.original_name(&joint.name);
    text.set("uniform token physics:axis", "\"X\"");
    text.set("rel physics:body0", &format!("<{}>", ends.parent));
    text.set("rel physics:body1", &format!("<{}>", ends.child));
    let along = along_x(&joint.axis_in_joint);
    let in_parent: Isometry3<f64> = joint.parent_from_joint * along;
    text.set("point3f physics:localPos0", &vector(&in_parent.translation.vector));
    text.set("quatf physics:localRot0", &rotation(&in_parent.rotation));
    text.set("point3f physics:localPos1", "(0, 0, 0)");
    text.set("quatf physics:localRot1", &rotation(&along));
    if let Some((low, high)) = joint.limits.position.filter(|_| joint.kind != JointKind::Continuous)
    {
        text.set("float physics:lowerLimit", &number(scale * low));
        text.set("float physics:upperLimit", &number(scale * high));
    }
    let mut drive = |key: &str, value: f64| {
        text.set(&format!("float drive:{axis}:physics:{key}"), &number(value));
    };
    drive("stiffness", a.spring_stiffness.max(0.0) / scale);
    drive("damping", 0.0);
    if a.spring_stiffness > 0.0 {
        drive("targetPosition", scale * a.spring_rest);
    }
    if let Some(effort) = joint.limits.effort {
        drive("maxForce", effort);
    }
    let mut physx = |key: &str, value: f64| {
        text.set(&format!("float physxJointAxis:{axis}:{key}"), &number(value));
    };
    let level = levels(a).0.max(0.0);
    physx("armature", a.rotor_inertia);
    physx("staticFrictionEffort", level + a.stribeck.map_or(0.0, |s| s.excess));
    physx("dynamicFrictionEffort", level);
    physx("viscousFrictionCoefficient", a.viscous.max(0.0) / scale);
    if let Some(velocity) = joint.limits.velocity {
        physx("maxJointVelocity", scale * velocity);
    }
    let mut newton =
        |key: &str, value: f64| text.set(&format!("float newton:{key}"), &number(value));
    newton("armature", a.rotor_inertia);
    newton("friction", level);
    newton("damping", a.viscous.max(0.0) / scale);
    if let Some(velocity) = joint.limits.velocity {
        newton("velocityLimit", scale * velocity);
    }
    text.close();
}

/// A rotation that turns the x axis into an axis.
fn along_x(axis: &Vector3<f64>) -> UnitQuaternion<f64> {
    // A half turn has no single axis: that about z will do.
    UnitQuaternion::rotation_between(&Vector3::x(), axis).unwrap_or_else(|| {
        UnitQuaternion::from_axis_angle(&Vector3::z_axis(), std::f64::consts::PI)
    })
}

/// How a USD layer represents a quantity of a joint.
pub fn fate(quantity: DriveQuantity, link: &Link) -> Fate {
    match quantity {
        DriveQuantity::Rotor => Fate::exact("armature of PhysxJointAxisAPI and NewtonJointAPI"),
        DriveQuantity::Viscous if link.actuator.viscous < 0.0 => {
            Fate::omit("PhysX and Newton take no viscous friction below 0")
        }
        DriveQuantity::Viscous => Fate::exact(
            "viscousFrictionCoefficient of PhysxJointAxisAPI, damping of NewtonJointAPI",
        ),
        DriveQuantity::Coulomb if levels(&link.actuator).0 < 0.0 => {
            Fate::omit("PhysX and Newton take no friction below 0")
        }
        DriveQuantity::Coulomb => {
            Fate::exact("dynamicFrictionEffort of PhysxJointAxisAPI, friction of NewtonJointAPI")
        }
        DriveQuantity::Stribeck => Fate::near(
            "staticFrictionEffort is higher by it, at rest and gone at once in motion; Newton has none",
        ),
        DriveQuantity::Spring if link.actuator.spring_stiffness > 0.0 => Fate::near(
            "the drive holds it: a controller that sets the drive's gains takes its place",
        ),
        DriveQuantity::EncoderOffset => Fate::exact("localPos0, localRot0 of the joint"),
        other => fate_of_unsupported(other),
    }
}
