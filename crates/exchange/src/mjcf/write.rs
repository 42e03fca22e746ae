//! MuJoCo's format, one body a moving link.

use nalgebra::{Isometry3, Matrix3, SymmetricEigen, Vector3};
use robot::{Inertia, Link, Loaded, Robot, Shape, Visual};

use crate::fate::Fate;
use crate::mjcf::joint::{actuator, gives, joints, springs, tendons};
use crate::mjcf::position::{servo_fate, servo_options};
use crate::numbers::{number, numbers};
use crate::quantity::DriveQuantity;
use crate::servo::Servo;
use crate::unsupported::fate_of_unsupported;
use crate::xml_text::XmlText;

/// Mass (kg) and moment (kg m²) of a body that has none: MuJoCo refuses a moving body without.
const LEAST: f64 = 1e-9;

/// A principal moment below this (kg m²) is none to MuJoCo.
const SMALLEST: f64 = 1e-14;

/// Dry friction of the solver: the time in which it stops a joint (s) and its damping ratio, ...
pub const FRICTION_REFERENCE: &str = "0.004 1";

/// ... and the share of an acceleration that it takes away.
pub const FRICTION_IMPEDANCE: &str = "0.999 0.999 0.001";

/// The robot as an MJCF.
pub fn write(loaded: &Loaded, robot: &Robot) -> String {
    let mut sheet = XmlText::new();
    sheet.open("mujoco", &[("model", robot.name().to_owned())]);
    let mut compiler = vec![
        ("angle", "radian".to_owned()),
        ("autolimits", "true".to_owned()),
        ("inertiafromgeom", "false".to_owned()),
    ];
    if robot.links().iter().any(|link| !link.inertia.is_positive_definite()) {
        compiler.push(("balanceinertia", "true".to_owned()));
    }
    sheet.leaf("compiler", &compiler);
    let mut option = vec![("gravity", numbers(robot.gravity_in_base().iter()))];
    if robot.links().iter().any(|link| Servo::of(link).is_some()) {
        option.extend(servo_options());
    }
    sheet.leaf("option", &option);
    defaults(&mut sheet);
    sheet.open("worldbody", &[]);
    loaded.looks.base.iter().for_each(|visual| geom(&mut sheet, visual));
    bodies(&mut sheet, loaded, robot);
    sheet.close();
    if robot.links().iter().any(|link| link.actuator.coupling.is_some()) {
        sheet.open("tendon", &[]);
        robot.links().iter().for_each(|link| tendons(&mut sheet, robot, link));
        sheet.close();
    }
    sheet.open("actuator", &[]);
    robot.links().iter().for_each(|link| actuator(&mut sheet, link));
    sheet.finish()
}

fn defaults(sheet: &mut XmlText) {
    let friction = [
        ("solreffriction", FRICTION_REFERENCE.to_owned()),
        ("solimpfriction", FRICTION_IMPEDANCE.to_owned()),
    ];
    sheet.comment("MuJoCo softens dry friction: these let it act in full from rest on");
    sheet.open("default", &[]);
    sheet.leaf("joint", &friction);
    sheet.leaf("tendon", &friction);
    sheet.leaf("geom", &["contype", "conaffinity"].map(|key| (key, "0".to_owned())));
    sheet.close();
}

/// The bodies, each inside of its parent.
fn bodies(sheet: &mut XmlText, loaded: &Loaded, robot: &Robot) {
    enum Step {
        Open(usize),
        Close,
    }
    let children = |of: Option<usize>| {
        let links = robot.links().iter().enumerate().rev();
        links.filter(move |(_, link)| link.parent == of).map(|(index, _)| Step::Open(index))
    };
    let mut steps: Vec<Step> = children(None).collect();
    while let Some(step) = steps.pop() {
        match step {
            Step::Close => sheet.close(),
            Step::Open(index) => {
                let link = &robot.links()[index];
                let mut attributes = vec![("name", link.name.clone())];
                attributes.extend(pose(&link.joint.parent_from_joint));
                sheet.open("body", &attributes);
                inertial(sheet, link);
                joints(sheet, link);
                loaded.looks.links.get(index).into_iter().flatten().for_each(|v| geom(sheet, v));
                steps.push(Step::Close);
                steps.extend(children(Some(index)));
            }
        }
    }
}

fn inertial(sheet: &mut XmlText, link: &Link) {
    let (inertia, i) = (&link.inertia, positive(&link.inertia.about_com));
    let moments = [i.m11, i.m22, i.m33, i.m12, i.m13, i.m23];
    sheet.leaf(
        "inertial",
        &[
            ("pos", numbers(inertia.com_in_link.iter())),
            ("mass", number(inertia.mass.max(LEAST))),
            ("fullinertia", numbers(&moments)),
        ],
    );
}

/// The body with mass and moments that MuJoCo accepts: none below the least. Where one moment exceeds the sum of the
/// others, all three become their mean (`balanceinertia`).
pub fn with_possible_moments(inertia: &Inertia) -> Inertia {
    let mut about_com = positive(&inertia.about_com);
    let moments = about_com.symmetric_eigenvalues();
    if 2.0 * moments.max() > moments.sum() {
        about_com = Matrix3::identity() * (moments.sum() / 3.0);
    }
    Inertia { mass: inertia.mass.max(LEAST), about_com, ..inertia.clone() }
}

/// The moments with those that are not positive raised to the least.
fn positive(moments: &Matrix3<f64>) -> Matrix3<f64> {
    let SymmetricEigen { mut eigenvalues, eigenvectors } = SymmetricEigen::new(*moments);
    if eigenvalues.min() > SMALLEST {
        return *moments;
    }
    eigenvalues.iter_mut().for_each(|value| *value = value.max(LEAST));
    let raised = eigenvectors * Matrix3::from_diagonal(&eigenvalues) * eigenvectors.transpose();
    0.5 * (raised + raised.transpose())
}

/// `pos` and `quat` of a frame, as far as they are not those of the parent.
pub fn pose(frame: &Isometry3<f64>) -> Vec<(&'static str, String)> {
    let mut attributes = vec![];
    if frame.translation.vector != Vector3::zeros() {
        attributes.push(("pos", numbers(frame.translation.vector.iter())));
    }
    let q = frame.rotation.quaternion();
    if q.vector().amax() > 0.0 {
        attributes.push(("quat", numbers(&[q.w, q.i, q.j, q.k])));
    }
    attributes
}

/// A shape to look at; surfaces of files are left out.
fn geom(sheet: &mut XmlText, visual: &Visual) {
    let (kind, size) = match &visual.shape {
        Shape::Box { size_m } => ("box", numbers((0.5 * size_m).iter())),
        Shape::Sphere { radius_m } => ("sphere", number(*radius_m)),
        Shape::Cylinder { radius_m, length_m } => {
            ("cylinder", numbers(&[*radius_m, 0.5 * length_m]))
        }
        Shape::Capsule { radius_m, length_m } => ("capsule", numbers(&[*radius_m, 0.5 * length_m])),
        _ => return,
    };
    let mut attributes = vec![("type", kind.to_owned()), ("size", size)];
    attributes.extend(pose(&visual.link_from_shape));
    if let Some(color) = visual.color_rgba {
        attributes.push(("rgba", numbers(&color.map(f64::from))));
    }
    sheet.leaf("geom", &attributes);
}

/// How an MJCF represents a quantity of a joint.
pub fn fate(quantity: DriveQuantity, link: &Link) -> Fate {
    use DriveQuantity as Q;
    let a = &link.actuator;
    match quantity {
        Q::Rotor => Fate::exact("armature"),
        Q::Viscous => Fate::exact("damping"),
        Q::Coulomb => Fate::exact("frictionloss; the solver softens it near rest"),
        Q::Asymmetry => match springs(link) {
            Some(_) if a.spring_stiffness > 0.0 => Fate::exact("springref, moved by as much"),
            Some(_) => Fate::near("a long soft spring, 0.03 % off in half a turn"),
            None => Fate::omit("the spring is cubic: no other constant torque has a place"),
        },
        Q::Spring => Fate::exact("stiffness, springref"),
        Q::SpringCubic => Fate::exact("third number of stiffness (MuJoCo 4)"),
        Q::Coupling => Fate::exact("frictionloss and damping of two tendons"),
        Q::EncoderOffset => Fate::exact("pos and quat of the body"),
        Q::Loop | Q::GoalDelay | Q::EffortGain | Q::EffortOffset | Q::Delay | Q::Lag
            if a.position_loop.is_some() =>
        {
            servo_fate(quantity, link)
        }
        Q::EffortGain => Fate::exact("gainprm of the actuator"),
        Q::EffortOffset => Fate::exact("biasprm of the actuator"),
        Q::Lag => Fate::exact("dyntype filter of the actuator"),
        Q::Delay => Fate::exact("delay of the actuator (MuJoCo 4)"),
        Q::Elasticity if gives(link) => Fate::exact("stiffness of a second joint, NAME_give"),
        Q::Backlash if gives(link) && a.elasticity.is_none() => {
            Fate::near("limits of a second joint, NAME_give; its stops are the solver's")
        }
        Q::Backlash if gives(link) => Fate::omit("the transmission gives way already"),
        Q::Backlash | Q::Elasticity => Fate::omit(
            "a second joint needs a rotor inertia between the two: give rotor_inertia_kg_m2",
        ),
        other => fate_of_unsupported(other),
    }
}
