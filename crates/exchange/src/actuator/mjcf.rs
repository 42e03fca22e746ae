//! Position actuators of MuJoCo.

use robot::{Link, Robot};

use crate::mjcf::joint::drive_attributes;
use crate::mjcf::position::{actuator, servo_options};
use crate::mjcf::write::{FRICTION_IMPEDANCE, FRICTION_REFERENCE};
use crate::servo::Servo;
use crate::xml_text::XmlText;

/// Classes for the joints of a model and an actuator a joint, to be included in an MJCF.
pub fn write(robot: &Robot) -> String {
    let mut sheet = XmlText::new();
    sheet.comment(
        "beside an MJCF of the arm: <include file=\"extended_actuator.xml\"/>, give each joint class=\"NAME_servo\" \
         and leave out its own damping, frictionloss, armature and actuators",
    );
    sheet.open("mujoco", &[("model", format!("{} servos", robot.name()))]);
    let servos = || robot.links().iter().filter_map(|link| Some((link, Servo::of(link)?)));
    sheet.comment(
        "of the whole model: with Euler, the default, the velocity of a loop is half a step late",
    );
    sheet.leaf("option", &servo_options().collect::<Vec<_>>());
    sheet.open("default", &[]);
    for (link, _) in servos() {
        sheet.open("default", &[("class", class(link))]);
        let mut attributes = drive_attributes(link);
        attributes.push(("solreffriction", FRICTION_REFERENCE.to_owned()));
        attributes.push(("solimpfriction", FRICTION_IMPEDANCE.to_owned()));
        sheet.leaf("joint", &attributes);
        sheet.close();
    }
    sheet.close();
    sheet.open("actuator", &[]);
    servos().for_each(|(link, servo)| actuator(&mut sheet, link, &servo));
    sheet.finish()
}

fn class(link: &Link) -> String {
    format!("{}_servo", link.joint.name)
}
