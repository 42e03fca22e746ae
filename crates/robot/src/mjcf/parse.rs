use std::path::Path;

use nalgebra::Vector3;

use crate::error::RobotError;
use crate::mjcf::actuators::Motor;
use crate::mjcf::body::Walk;
use crate::mjcf::classes::{Classes, MAIN};
use crate::mjcf::compiler::Compiler;
use crate::mjcf::element::{Element, Files};
use crate::mjcf::unread::Unread;
use crate::mjcf::view::View;
use crate::mjcf::{actuators, geom};
use crate::structure::control::PdGain;
use crate::structure::link::Link;
use crate::structure::part::{Mimic, Mimics};
use crate::structure::robot::Robot;
use crate::whole_robot::WholeRobot;

/// Free fall of a model that does not say another (m/s²).
const GRAVITY: Vector3<f64> = Vector3::new(0.0, 0.0, -9.81);

/// Name of the frame that the bodies stand in.
const WORLD: &str = "world";

/// Reads the text of an MJCF; `read` gives the files that it includes, from `folder`.
///
/// # Errors
///
/// [`RobotError::Malformed`], [`RobotError::BadElement`], [`RobotError::UnsupportedJoint`] and those
/// of [`Robot::new`].
pub(crate) fn parse(
    text: &str,
    folder: &Path,
    read: &dyn Fn(&Path) -> Result<String, RobotError>,
) -> Result<WholeRobot, RobotError> {
    let mut files = Files::new(folder, read);
    let root = files.root(text)?;
    let (classes, compiler) = (Classes::new(&root)?, Compiler::new(&root)?);
    let view = |element, around| View { element, around, classes: &classes, compiler: &compiler };
    let scale = |mesh: &Element| {
        let view = View { element: mesh, around: MAIN, classes: &classes, compiler: &compiler };
        Ok(view.vector("scale")?.unwrap_or_else(|| Vector3::repeat(1.0)))
    };
    let meshes = geom::meshes(&root, &scale, &compiler.mesh_folder)?;
    let mut walk = Walk::new(&classes, &compiler, &meshes);
    for world in root.all("worldbody") {
        walk.world(world)?;
    }
    walk.unread.of_root(&root);
    let mimics = mimics(&root, &view, &walk.links, &mut walk.unread)?;
    let (motors, others) = actuators::motors(&root, view)?;
    (0..others).for_each(|_| walk.unread.add("actuator of something else than a joint"));
    let gains = drive(&mut walk.links, &motors);
    let gravity = gravity(&root, &view)?;
    let name = root.get("model").unwrap_or("MuJoCo Model").to_owned();
    let mut warnings = walk.warnings;
    warnings.extend(walk.unread.warnings());
    Ok(WholeRobot {
        robot: Robot::new(name, gravity, walk.links)?,
        looks: walk.looks,
        base_link: WORLD.to_owned(),
        fixed_to_base: walk.fixed_to_base,
        base_has_mass: walk.base_has_mass,
        without_mass: vec![],
        mimics,
        gains,
        expanded: files.has_includes().then(|| root.to_xml()),
        warnings,
    })
}

fn gravity<'a>(
    root: &'a Element,
    view: &dyn Fn(&'a Element, &'a str) -> View<'a>,
) -> Result<Vector3<f64>, RobotError> {
    let mut gravity = GRAVITY;
    for option in root.all("option") {
        gravity = view(option, MAIN).vector("gravity")?.unwrap_or(gravity);
    }
    let mut flags = root.all("option").flat_map(|option| option.all("flag"));
    let is_off = flags.any(|flag| flag.get("gravity") == Some("disable"));
    Ok(if is_off { Vector3::zeros() } else { gravity })
}

/// Puts what the motors can do into the links; the gains of their servos come back.
fn drive(links: &mut [Link], motors: &[Motor]) -> Vec<Option<PdGain>> {
    let mut gains = vec![None; links.len()];
    for motor in motors {
        let Some(index) = links.iter().position(|l| l.joint.name == motor.joint) else { continue };
        let link = &mut links[index];
        let limit = &mut link.joint.limits.effort;
        *limit = limit.or(motor.effort);
        link.actuator.lag_s = motor.lag_s.unwrap_or(link.actuator.lag_s);
        // The control of a servo is a goal.
        let late = match motor.gain {
            Some(_) => &mut link.actuator.goal_delay_s,
            None => &mut link.actuator.delay_s,
        };
        *late = motor.delay_s.unwrap_or(*late);
        gains[index] = motor.gain.or(gains[index]);
    }
    gains
}

/// `<equality>`: joints that follow others linearly; other constraints are counted.
fn mimics<'a>(
    root: &'a Element,
    view: &dyn Fn(&'a Element, &'a str) -> View<'a>,
    links: &[Link],
    unread: &mut Unread,
) -> Result<Mimics, RobotError> {
    let mut mimics = Mimics::new();
    let known = |name: &str| links.iter().any(|link| link.joint.name == name);
    for element in root.all("equality").flat_map(|list| &list.children) {
        let view = view(element, MAIN);
        let pair = view.text("joint1").zip(view.text("joint2"));
        let pair = pair.filter(|(a, b)| element.name == "joint" && a != b && known(a) && known(b));
        let polynomial = view.numbers("polycoef", 5)?.unwrap_or_else(|| vec![0.0, 1.0]);
        let is_linear = polynomial.iter().skip(2).all(|c| c.abs() <= 0.0);
        match pair.filter(|_| is_linear) {
            // A joint of two masters, or one of a ring, follows the first that does not close it.
            Some((joint, master)) if !follows(&mimics, master, joint) => {
                let at = |i: usize| polynomial.get(i).copied().unwrap_or(0.0);
                let mimic = Mimic { master: master.to_owned(), multiplier: at(1), offset: at(0) };
                mimics.entry(joint.to_owned()).or_insert(mimic);
            }
            _ => unread.add(format!("<{}> of <equality>", element.name)),
        }
    }
    Ok(mimics)
}

/// Whether `joint` follows `master`, directly or through others.
fn follows(mimics: &Mimics, joint: &str, master: &str) -> bool {
    let mut at = joint;
    for _ in 0..=mimics.len() {
        match mimics.get(at) {
            Some(mimic) if mimic.master == master => return true,
            Some(mimic) => at = &mimic.master,
            None => return false,
        }
    }
    true
}
