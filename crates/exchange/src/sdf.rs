//! The format of Gazebo, one link a moving link.

use nalgebra::{Isometry3, Rotation3, Translation3, UnitQuaternion, Vector3};
use robot::{Inertia, JointKind, Link, Loaded, Robot};

use crate::fate::Fate;
use crate::numbers::{moments, number, numbers};
use crate::quantity::{DriveQuantity, levels};
use crate::unsupported::fate_of_unsupported;
use crate::xml_text::XmlText;

/// Name of what a model is fixed to.
const WORLD: &str = "world";

/// The robot as an SDF, its base fixed to the world.
pub fn write(loaded: &Loaded, robot: &Robot) -> String {
    let mut sheet = XmlText::new();
    sheet.open("sdf", &[("version", "1.9".to_owned())]);
    sheet.open("model", &[("name", robot.name().to_owned())]);
    pose(&mut sheet, &upright(robot.gravity_in_base()), None);
    let base = &loaded.base_link;
    if base != WORLD {
        sheet.open("link", &[("name", base.clone())]);
        sheet.close();
        sheet.open("joint", &[("name", format!("{base}_to_world")), ("type", "fixed".to_owned())]);
        sheet.text("parent", &[], WORLD);
        sheet.text("child", &[], base);
        sheet.close();
    }
    for link in robot.links() {
        let parent = link.parent.map_or(base, |parent| &robot.links()[parent].name);
        body(&mut sheet, link, link.parent.map(|_| parent.as_str()).filter(|name| *name != WORLD));
        joint(&mut sheet, link, parent);
    }
    sheet.finish()
}

/// The pose of the model in a world whose gravity points down.
fn upright(gravity_in_base: Vector3<f64>) -> Isometry3<f64> {
    let down = -Vector3::z();
    // A half turn has no single axis: any level one will do.
    let rotation = Rotation3::rotation_between(&gravity_in_base, &down)
        .unwrap_or_else(|| Rotation3::from_axis_angle(&Vector3::x_axis(), std::f64::consts::PI));
    let rotation = if gravity_in_base.norm() > 0.0 { rotation } else { Rotation3::identity() };
    let rotation = UnitQuaternion::from_rotation_matrix(&rotation);
    Isometry3::from_parts(Translation3::identity(), rotation)
}

fn pose(sheet: &mut XmlText, frame: &Isometry3<f64>, relative_to: Option<&str>) {
    let (t, q) = (frame.translation.vector, frame.rotation.quaternion());
    let mut attributes = vec![("rotation_format", "quat_xyzw".to_owned())];
    attributes.extend(relative_to.map(|name| ("relative_to", name.to_owned())));
    sheet.text("pose", &attributes, &numbers(&[t.x, t.y, t.z, q.i, q.j, q.k, q.w]));
}

fn body(sheet: &mut XmlText, link: &Link, parent: Option<&str>) {
    sheet.open("link", &[("name", link.name.clone())]);
    pose(sheet, &link.joint.parent_from_joint, parent);
    let Inertia { mass, com_in_link, about_com: i } = &link.inertia;
    sheet.open("inertial", &[]);
    pose(sheet, &Isometry3::from(Translation3::from(*com_in_link)), None);
    sheet.text("mass", &[], &number(*mass));
    sheet.open("inertia", &[]);
    for (name, value) in moments(i) {
        sheet.text(name, &[], &value);
    }
    sheet.close();
    sheet.close();
    sheet.close();
}

fn joint(sheet: &mut XmlText, link: &Link, parent: &str) {
    let (joint, a) = (&link.joint, &link.actuator);
    let kind = match joint.kind {
        JointKind::Revolute => "revolute",
        JointKind::Continuous => "continuous",
        JointKind::Prismatic => "prismatic",
    };
    sheet.open("joint", &[("name", joint.name.clone()), ("type", kind.to_owned())]);
    sheet.text("parent", &[], parent);
    sheet.text("child", &[], &link.name);
    sheet.open("axis", &[]);
    sheet.text("xyz", &[], &numbers(joint.axis_in_joint.iter()));
    let limits = &joint.limits;
    let of = |value: Option<f64>, name| Some((name, value?));
    let limits = [
        of(limits.position.map(|(low, _)| low), "lower"),
        of(limits.position.map(|(_, high)| high), "upper"),
        of(limits.effort, "effort"),
        of(limits.velocity, "velocity"),
    ];
    let drive = [
        Some(("damping", a.viscous)),
        Some(("friction", levels(a).0)),
        Some(("spring_reference", a.spring_rest)).filter(|_| a.spring_stiffness > 0.0),
        Some(("spring_stiffness", a.spring_stiffness)).filter(|_| a.spring_stiffness > 0.0),
    ];
    for (name, entries) in [("limit", limits), ("dynamics", drive)] {
        sheet.open(name, &[]);
        entries.iter().flatten().for_each(|(name, value)| sheet.text(name, &[], &number(*value)));
        sheet.close();
    }
    sheet.close();
    sheet.close();
}

/// How an SDF represents a quantity of a joint.
pub fn fate(quantity: DriveQuantity, link: &Link) -> Fate {
    match quantity {
        DriveQuantity::Viscous => Fate::exact("<damping>"),
        DriveQuantity::Coulomb => Fate::exact("<friction>"),
        DriveQuantity::Spring if link.actuator.spring_stiffness > 0.0 => {
            Fate::exact("<spring_stiffness>, <spring_reference>")
        }
        DriveQuantity::Spring => Fate::omit("Gazebo takes no spring below 0"),
        DriveQuantity::EncoderOffset => Fate::exact("<pose> of the link"),
        other => fate_of_unsupported(other),
    }
}
