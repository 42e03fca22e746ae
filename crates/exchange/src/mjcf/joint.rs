//! Joints, tendons and actuators of an MJCF.

use robot::{Link, Robot};

use crate::mjcf::position;
use crate::numbers::{number, numbers};
use crate::quantity::levels;
use crate::servo::Servo;
use crate::xml_text::XmlText;

/// Stiffness of the spring that stands for a constant torque, over that torque (1/rad).
const SOFT: f64 = 1e-4;

/// The spring of a joint as `stiffness`, its cubic part and `springref`, with the constant torque that
/// friction of two levels leaves; `None` where that has no place.
///
/// ```text
/// k (q - rest) + c (q - rest)³ + d = k (q - (rest - d / k))     with c = 0
/// ```
pub fn springs(link: &Link) -> Option<[f64; 3]> {
    let a = &link.actuator;
    let (_, difference) = levels(a);
    if difference.abs() <= 0.0 {
        return Some([a.spring_stiffness, a.spring_cubic, a.spring_rest]);
    }
    if a.spring_cubic.abs() > 0.0 {
        return None;
    }
    let stiffness = a.spring_stiffness;
    let [k, rest] =
        if stiffness > 0.0 { [stiffness, a.spring_rest] } else { [SOFT * difference.abs(), 0.0] };
    Some([k, 0.0, rest - difference / k])
}

/// Whether a second joint gives way behind the first one, which turns with the motor.
pub fn gives(link: &Link) -> bool {
    let a = &link.actuator;
    a.rotor_inertia > 0.0 && (a.backlash > 0.0 || a.elasticity.is_some())
}

/// The joint of a body, and a second one where its transmission gives way.
pub fn joints(sheet: &mut XmlText, link: &Link) {
    let (joint, a) = (&link.joint, &link.actuator);
    let kind = if joint.kind.is_rotation() { "hinge" } else { "slide" };
    let common = [("type", kind.to_owned()), ("axis", numbers(joint.axis_in_joint.iter()))];
    let mut attributes = vec![("name", joint.name.clone())];
    attributes.extend(common.clone());
    if let Some((low, high)) = joint.limits.position {
        attributes.push(("range", numbers(&[low, high])));
    }
    attributes.extend(drive_attributes(link));
    let [k, cubic, rest] =
        springs(link).unwrap_or([a.spring_stiffness, a.spring_cubic, a.spring_rest]);
    if cubic.abs() > 0.0 {
        attributes.push(("stiffness", numbers(&[k, 0.0, cubic])));
    } else if k.abs() > 0.0 {
        attributes.push(("stiffness", number(k)));
    }
    if (k.abs() > 0.0 || cubic.abs() > 0.0) && rest.abs() > 0.0 {
        attributes.push(("springref", number(rest)));
    }
    if let Some(limit) = joint.limits.effort {
        attributes.push(("actuatorfrcrange", numbers(&[-limit, limit])));
    }
    sheet.leaf("joint", &attributes);
    if gives(link) {
        let mut second = vec![("name", format!("{}_give", joint.name))];
        second.extend(common);
        second.push(match a.elasticity {
            Some(stiffness) => ("stiffness", number(stiffness)),
            None => ("range", numbers(&[-0.5 * a.backlash, 0.5 * a.backlash])),
        });
        sheet.leaf("joint", &second);
    }
}

/// Friction and rotor of a drive, as attributes of its joint; those that are 0 are left out.
pub fn drive_attributes(link: &Link) -> Vec<(&'static str, String)> {
    let a = &link.actuator;
    let all =
        [("damping", a.viscous), ("frictionloss", levels(a).0), ("armature", a.rotor_inertia)];
    let present = all.into_iter().filter(|(_, value)| value.abs() > 0.0);
    present.map(|(key, value)| (key, number(value))).collect()
}

/// The two tendons of motors that drive a joint and another one together.
pub fn tendons(sheet: &mut XmlText, robot: &Robot, link: &Link) {
    let Some(coupling) = link.actuator.coupling else { return };
    let Some(other) = robot.joint_names().nth(coupling.other) else { return };
    let name = &link.joint.name;
    for (index, (word, sign)) in [("sum", 1.0), ("difference", -1.0)].into_iter().enumerate() {
        let attributes = [
            ("name", format!("{name}_{word}")),
            ("damping", number(coupling.viscous[index])),
            ("frictionloss", number(coupling.level[index])),
        ];
        sheet.open("fixed", &attributes);
        for (joint, coefficient) in [(name.as_str(), 1.0), (other, sign * coupling.ratio)] {
            let coefficient = number(coefficient);
            sheet.leaf("joint", &[("joint", joint.to_owned()), ("coef", coefficient)]);
        }
        sheet.close();
    }
}

/// The actuator of a joint: its control is the goal of the position loop, or the effort that a log would show.
///
/// ```text
/// effort = gain tau + offset,   tau = effort / gain - offset / gain
/// ```
pub fn actuator(sheet: &mut XmlText, link: &Link) {
    if let Some(servo) = Servo::of(link) {
        return position::actuator(sheet, link, &servo);
    }
    let a = &link.actuator;
    let name = || ("name", link.joint.name.clone());
    let joint = || ("joint", link.joint.name.clone());
    let gain = a.torque_gain * a.transmission_ratio;
    let plain = (gain - 1.0).abs() <= 0.0 && a.torque_offset.abs() <= 0.0;
    if plain && a.lag_s <= 0.0 && a.delay_s <= 0.0 {
        sheet.leaf("motor", &[name(), joint()]);
        return;
    }
    let mut attributes = vec![name(), joint(), ("gainprm", number(1.0 / gain))];
    if a.torque_offset.abs() > 0.0 {
        attributes.push(("biastype", "affine".to_owned()));
        attributes.push(("biasprm", numbers(&[-a.torque_offset / gain, 0.0, 0.0])));
    }
    if a.lag_s > 0.0 {
        attributes.push(("dyntype", "filter".to_owned()));
        attributes.push(("dynprm", number(a.lag_s)));
    }
    attributes.extend(position::history(a.delay_s));
    sheet.leaf("general", &attributes);
}
