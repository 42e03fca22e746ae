use nalgebra::{Isometry3, Translation3, Unit, UnitQuaternion, Vector3};

use crate::error::RobotError;
use crate::mjcf::view::View;
use crate::structure::actuator::Actuator;
use crate::structure::joint::{Joint, JointKind, Limits};

/// How a joint of an MJCF moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MjcfMotion {
    Hinge,
    Slide,
    /// All six ways: that of a base.
    Free,
}

/// How the joint that an element describes moves.
///
/// # Errors
///
/// [`RobotError::UnsupportedJoint`] for a ball, [`RobotError::BadElement`] for an unknown word.
pub fn motion(view: &View<'_>, name: &str) -> Result<MjcfMotion, RobotError> {
    if view.element.name == "freejoint" {
        return Ok(MjcfMotion::Free);
    }
    match view.text("type").unwrap_or("hinge") {
        "hinge" => Ok(MjcfMotion::Hinge),
        "slide" => Ok(MjcfMotion::Slide),
        "free" => Ok(MjcfMotion::Free),
        "ball" => Err(RobotError::UnsupportedJoint { joint: name.to_owned(), kind: "ball" }),
        other => {
            let reason = format!("type=\"{other}\" was found, hinge or slide was expected");
            Err(view.element.bad(reason))
        }
    }
}

/// A joint with its drive.
pub struct Driven {
    pub joint: Joint,
    pub actuator: Actuator,
    /// Where its axis passes in the frame of its body.
    pub body_from_joint: Isometry3<f64>,
}

/// The joint of a body, whose frame lies at `parent_from_body` while all joints are at `ref`.
///
/// ```text
/// parent_from_link = parent_from_body T(pos) motion(q - ref)
/// ```
pub fn read_joint(
    view: &View<'_>,
    name: &str,
    kind: MjcfMotion,
    parent_from_body: &Isometry3<f64>,
) -> Result<Driven, RobotError> {
    let axis = view.vector("axis")?.unwrap_or_else(Vector3::z);
    let axis_in_joint =
        Unit::try_new(axis, 0.0).ok_or_else(|| RobotError::ZeroAxis { joint: name.to_owned() })?;
    let position = view.vector("pos")?.unwrap_or_default();
    let body_from_joint = Isometry3::from(Translation3::from(position));
    let is_hinge = kind == MjcfMotion::Hinge;
    let place = |value: f64| if is_hinge { view.compiler.radians(value) } else { value };
    let at_rest = place(view.number("ref")?.unwrap_or(0.0));
    let back = if is_hinge {
        let turn = UnitQuaternion::from_axis_angle(&axis_in_joint, -at_rest);
        Isometry3::from_parts(Translation3::identity(), turn)
    } else {
        Isometry3::from(Translation3::from(-at_rest * axis_in_joint.into_inner()))
    };
    let position = limits(view, name)?.map(|(low, high)| (place(low), place(high)));
    let joint = Joint {
        name: name.to_owned(),
        kind: match (kind, position) {
            (MjcfMotion::Hinge, None) => JointKind::Continuous,
            (MjcfMotion::Hinge, Some(_)) => JointKind::Revolute,
            _ => JointKind::Prismatic,
        },
        parent_from_joint: parent_from_body * body_from_joint * back,
        axis_in_joint,
        limits: Limits { position, velocity: None, effort: effort(view)? },
    };
    Ok(Driven { joint, actuator: actuator(view, place)?, body_from_joint })
}

fn actuator(view: &View<'_>, place: impl Fn(f64) -> f64) -> Result<Actuator, RobotError> {
    let own = |key: &str| Ok::<f64, RobotError>(view.number(key)?.unwrap_or(0.0));
    let friction = own("frictionloss")?;
    let damping = view.numbers("damping", 3)?.unwrap_or_default();
    let stiffness = view.numbers("stiffness", 3)?.unwrap_or_default();
    let at = |list: &[f64], i: usize| list.get(i).copied().unwrap_or(0.0);
    if at(&damping, 1).abs() + at(&damping, 2).abs() + at(&stiffness, 1).abs() > 0.0 {
        let reason = "damping beyond its first number, or a spring of even power, was found; \
                      viscous damping, a linear and a cubic spring are read";
        return Err(view.element.bad(reason));
    }
    let armature = own("armature")?;
    if armature < 0.0 || friction < 0.0 {
        return Err(view.element.bad("armature or frictionloss is below 0"));
    }
    Ok(Actuator {
        rotor_inertia: armature,
        viscous: at(&damping, 0),
        coulomb_forward: friction,
        coulomb_backward: friction,
        spring_stiffness: at(&stiffness, 0),
        spring_cubic: at(&stiffness, 2),
        spring_rest: place(own("springref")?),
        ..Actuator::default()
    })
}

/// Lowest and highest position, in the units of the file.
fn limits(view: &View<'_>, name: &str) -> Result<Option<(f64, f64)>, RobotError> {
    let Some([lower, upper]) = view.exactly::<2>("range")? else { return Ok(None) };
    let limited = match view.text("limited") {
        Some("true") => true,
        Some("false") => false,
        _ => view.compiler.autolimits,
    };
    if limited && lower > upper {
        return Err(RobotError::LimitsReversed { joint: name.to_owned(), lower, upper });
    }
    Ok(limited.then_some((lower, upper)).filter(|_| lower < upper))
}

/// Largest force of all actuators together.
fn effort(view: &View<'_>) -> Result<Option<f64>, RobotError> {
    let range = view.exactly::<2>("actuatorfrcrange")?;
    let limited = view.text("actuatorfrclimited") != Some("false");
    Ok(range.filter(|_| limited).map(largest).filter(|limit| *limit > 0.0))
}

/// The largest magnitude of a range.
pub fn largest([low, high]: [f64; 2]) -> f64 {
    low.abs().max(high.abs())
}
