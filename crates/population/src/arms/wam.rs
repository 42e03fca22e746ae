//! Barrett's arm, as `robots/wam7` has it.

use std::fmt::Write;

use document::Document;
use nalgebra::Vector3;
use rand_chacha::ChaCha8Rng;
use robot::Robot;

use crate::arms::arm::{Base, RotorsKnown, SampledArm, dummy_dynamics, error_level};
use crate::arms::bodies::BodyError;
use crate::arms::drives::accelerations;
use crate::arms::electronics::Electronics;
use crate::arms::make::Make;
use crate::corner::{ArmClass, EffortClass};
use crate::error::PopulationError;
use crate::instruments::Instrument;
use crate::robot_files::RobotFiles;

const URDF: &str = include_str!("../../../../robots/wam7/robot.urdf");
const TOML: &str = include_str!("../../../../robots/wam7/robot.toml");

/// The arm as the project describes it.
pub(crate) fn files() -> RobotFiles {
    RobotFiles { urdf: URDF.to_owned(), toml: TOML.to_owned() }
}

/// What `robot.toml` says of the arm's efforts.
const SOURCE: &str = "torque_source = \"commanded\"";
/// What it says of the controller.
const RATE: &str = "control_rate_hz = 500.0";
/// What the URDF says of the friction of each joint.
const DYNAMICS: &str = "<dynamics damping=\"0\" friction=\"0\"/>";

/// Numbers of `robot.toml`, joint by joint.
#[derive(Debug, serde::Deserialize)]
struct Stated {
    joint: std::collections::BTreeMap<String, StatedJoint>,
}

#[derive(Debug, serde::Deserialize)]
struct StatedJoint {
    rotor_inertia_kg_m2: f64,
    torque_limit_nm: f64,
    kp_nm_per_rad: f64,
}

/// The arm with a base, signals and a nominal model of its own.
pub(crate) fn draw(
    instrument: Instrument,
    random: &mut ChaCha8Rng,
) -> Result<SampledArm, PopulationError> {
    let make = Make::of(ArmClass::Wam);
    let electronics = Electronics::draw(ArmClass::Wam, instrument, random);
    let base = Base::draw(random);
    let gravity = base.gravity(random);
    let mut robot = Robot::from_urdf(URDF)?.with_gravity(Vector3::from(gravity));
    let stated: Stated = Document::from_text("robots/wam7/robot.toml", TOML)?.parse()?;
    let names: Vec<String> = robot.joint_names().map(str::to_owned).collect();
    let (mut kp, mut limits) = (Vec::new(), Vec::new());
    for (i, name) in names.iter().enumerate() {
        let joint = stated.joint.get(name);
        kp.push(joint.map_or(1.0, |j| j.kp_nm_per_rad));
        limits.push(joint.map_or(1.0, |j| j.torque_limit_nm));
        if let (Some(link), Some(joint)) = (robot.link_mut(i), joint) {
            link.actuator.rotor_inertia = joint.rotor_inertia_kg_m2;
        }
    }

    let toml = truth_toml(base, gravity, &electronics);
    let known = match RotorsKnown::draw(&electronics, random) {
        RotorsKnown::All => toml.clone(),
        RotorsKnown::None => without_rotors(&toml),
    };
    let level = error_level(random);
    let nominal = RobotFiles {
        toml: known + &bodies(&robot, &make, level, random),
        urdf: match dummy_dynamics(ArmClass::Wam, random) {
            Some([damping, friction]) => URDF.replace(
                DYNAMICS,
                &format!("<dynamics damping=\"{damping}\" friction=\"{friction}\"/>"),
            ),
            None => URDF.to_owned(),
        },
    };
    Ok(SampledArm {
        truth: RobotFiles { urdf: URDF.to_owned(), toml },
        nominal,
        accelerations: accelerations(&robot, &make, random),
        robot,
        electronics,
        kp,
        limits,
    })
}

fn truth_toml(base: Base, gravity: [f64; 3], electronics: &Electronics) -> String {
    let source = match electronics.effort {
        EffortClass::Command => "commanded",
        EffortClass::Current => "current",
        EffortClass::JointTorque => "measured",
    };
    let mut said = format!("torque_source = \"{source}\"");
    if base != Base::Upright {
        said += &format!("\ngravity_m_per_s2 = {gravity:?}");
    }
    let rate = format!("control_rate_hz = {:?}", electronics.control_rate_hz);
    TOML.replace(SOURCE, &said).replace(RATE, &rate)
}

fn without_rotors(toml: &str) -> String {
    let mut kept = String::with_capacity(toml.len());
    for line in toml.lines().filter(|line| !line.starts_with("rotor_inertia_kg_m2")) {
        kept += line;
        kept.push('\n');
    }
    kept
}

/// The bodies of a model that is off, as `[link]` of `robot.toml`; nothing where it is exact.
fn bodies(robot: &Robot, make: &Make, level: f64, random: &mut ChaCha8Rng) -> String {
    let mut text = String::new();
    for link in robot.links().iter().filter(|_| level > 0.0) {
        let body = BodyError::draw(make, level, random).of(&link.inertia);
        let ([x, y, z], i) = (body.com_in_link.into(), body.about_com);
        let com: [f64; 3] = [x, y, z];
        // Writing to a string cannot fail.
        let _ = write!(
            text,
            "\n[link.{}]\nmass_kg = {:?}\ncom_m = {com:?}\ninertia_kg_m2 = {{ xx = {:?}, xy = {:?}, \
             xz = {:?}, yy = {:?}, yz = {:?}, zz = {:?} }}\n",
            link.name,
            body.mass,
            i[(0, 0)],
            i[(0, 1)],
            i[(0, 2)],
            i[(1, 1)],
            i[(1, 2)],
            i[(2, 2)],
        );
    }
    text
}
