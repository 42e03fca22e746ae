//! A URDF of a robot that was described otherwise, one link a moving link.

use nalgebra::{Isometry3, Translation3};
use robot::{JointKind, Link, Loaded, Robot};

use crate::numbers::{moments, number, numbers};
use crate::quantity::levels;
use crate::xml_text::XmlText;

/// The robot as a new URDF.
pub fn write(loaded: &Loaded, robot: &Robot) -> String {
    let mut sheet = XmlText::new();
    sheet.open("robot", &[("name", robot.name().to_owned())]);
    sheet.leaf("link", &[("name", loaded.base_link.clone())]);
    for link in robot.links() {
        body(&mut sheet, link);
        let parent = link.parent.map_or(&loaded.base_link, |parent| &robot.links()[parent].name);
        joint(&mut sheet, link, parent);
    }
    sheet.finish()
}

fn origin(sheet: &mut XmlText, frame: &Isometry3<f64>) {
    let (roll, pitch, yaw) = frame.rotation.euler_angles();
    let xyz = numbers(frame.translation.vector.iter());
    sheet.leaf("origin", &[("xyz", xyz), ("rpy", numbers(&[roll, pitch, yaw]))]);
}

fn body(sheet: &mut XmlText, link: &Link) {
    let (inertia, i) = (&link.inertia, &link.inertia.about_com);
    sheet.open("link", &[("name", link.name.clone())]);
    sheet.open("inertial", &[]);
    origin(sheet, &Isometry3::from(Translation3::from(inertia.com_in_link)));
    sheet.leaf("mass", &[("value", number(inertia.mass))]);
    sheet.leaf("inertia", &moments(i));
    sheet.close();
    sheet.close();
}

fn joint(sheet: &mut XmlText, link: &Link, parent: &str) {
    let (joint, limits) = (&link.joint, &link.joint.limits);
    let kind = match joint.kind {
        JointKind::Revolute if limits.position.is_none() => "continuous",
        JointKind::Revolute => "revolute",
        JointKind::Continuous => "continuous",
        JointKind::Prismatic => "prismatic",
    };
    sheet.open("joint", &[("name", joint.name.clone()), ("type", kind.to_owned())]);
    sheet.leaf("parent", &[("link", parent.to_owned())]);
    sheet.leaf("child", &[("link", link.name.clone())]);
    origin(sheet, &joint.parent_from_joint);
    sheet.leaf("axis", &[("xyz", numbers(joint.axis_in_joint.iter()))]);
    // A URDF says 0 where a limit is not known.
    let (lower, upper) = limits.position.unwrap_or_default();
    let of = |limit: Option<f64>| number(limit.unwrap_or_default());
    sheet.leaf(
        "limit",
        &[
            ("lower", number(lower)),
            ("upper", number(upper)),
            ("effort", of(limits.effort)),
            ("velocity", of(limits.velocity)),
        ],
    );
    let (damping, friction) = (number(link.actuator.viscous), number(levels(&link.actuator).0));
    sheet.leaf("dynamics", &[("damping", damping), ("friction", friction)]);
    sheet.close();
}
