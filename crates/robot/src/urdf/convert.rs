use nalgebra::{Isometry3, Matrix3, Translation3, Unit, UnitQuaternion, Vector3};
use urdf_rs::JointType;

use crate::error::RobotError;
use crate::range::{LARGEST, Most};
use crate::structure::inertia::Inertia;
use crate::structure::joint::{Joint, JointKind, Limits};
use crate::structure::part::Mimic;

/// Pose of the joint in its parent link at position zero.
pub(super) fn origin(joint: &urdf_rs::Joint) -> Result<Isometry3<f64>, RobotError> {
    let thing = || format!("joint {}", joint.name);
    finite(thing, "origin", &joint.origin.xyz.0, Most::LENGTH)?;
    finite(thing, "rpy", &joint.origin.rpy.0, Most::ANGLE)?;
    Ok(pose(&joint.origin))
}

/// A pose from `xyz` (m) and `rpy` (rad), at full precision.
///
/// ```text
/// R = Rz(yaw) Ry(pitch) Rx(roll)     turns about the fixed axes x, y, z in that order
/// ```
pub(super) fn pose(origin: &urdf_rs::Pose) -> Isometry3<f64> {
    let ([x, y, z], [roll, pitch, yaw]) = (origin.xyz.0, origin.rpy.0);
    let rotation = UnitQuaternion::from_euler_angles(roll, pitch, yaw);
    Isometry3::from_parts(Translation3::new(x, y, z), rotation)
}

/// The inertia that a link declares, in the link frame. A mass of zero makes it a frame, which is
/// for the caller to judge: it may be fixed to a body that has mass.
pub(super) fn inertia(link: &urdf_rs::Link) -> Result<Inertia, RobotError> {
    let (mass, i) = (link.inertial.mass.value, &link.inertial.inertia);
    if mass.is_nan() || mass < 0.0 {
        return Err(RobotError::MassNotPositive { link: link.name.clone(), mass });
    }
    let origin = &link.inertial.origin;
    let thing = || format!("link {}", link.name);
    finite(thing, "mass", &[mass], Most::MASS)?;
    finite(thing, "centre of mass", &origin.xyz.0, Most::LENGTH)?;
    finite(thing, "rpy", &origin.rpy.0, Most::ANGLE)?;
    let moments = [i.ixx, i.ixy, i.ixz, i.iyy, i.iyz, i.izz];
    finite(thing, "inertia", &moments, Most::INERTIA)?;
    let about_com = Matrix3::new(
        i.ixx, i.ixy, i.ixz, //
        i.ixy, i.iyy, i.iyz, //
        i.ixz, i.iyz, i.izz,
    );
    let in_own_axes = Inertia { mass, com_in_link: Vector3::zeros(), about_com };
    Ok(in_own_axes.in_frame(&pose(origin)))
}

/// A moving joint, given the pose of its parent link in the body that link belongs to.
pub(super) fn joint(
    joint: &urdf_rs::Joint,
    body_from_parent: &Isometry3<f64>,
) -> Result<Joint, RobotError> {
    let kind = kind(joint)?;
    let any_length = Most(f64::MAX, "a finite number");
    finite(|| format!("joint {}", joint.name), "axis", &joint.axis.xyz.0, any_length)?;
    let axis = Vector3::from(joint.axis.xyz.0);
    // Scaled first: the square of a very short axis would vanish.
    let axis = axis.unscale(if axis.amax() > 0.0 { axis.amax() } else { 1.0 });
    let axis_in_joint = Unit::try_new(axis, 0.0)
        .ok_or_else(|| RobotError::ZeroAxis { joint: joint.name.clone() })?;
    Ok(Joint {
        name: joint.name.clone(),
        kind,
        parent_from_joint: body_from_parent * origin(joint)?,
        axis_in_joint,
        limits: limits(joint, kind)?,
    })
}

/// How a joint that moves follows another one, if it does.
pub(super) fn mimic(joint: &urdf_rs::Joint) -> Result<Option<Mimic>, RobotError> {
    let moves = joint.joint_type != JointType::Fixed;
    let Some(mimic) = joint.mimic.as_ref().filter(|_| moves) else { return Ok(None) };
    let (multiplier, offset) = (mimic.multiplier.unwrap_or(1.0), mimic.offset.unwrap_or(0.0));
    let thing = || format!("joint {}", joint.name);
    finite(thing, "mimic multiplier", &[multiplier], Most::NUMBER)?;
    finite(thing, "mimic offset", &[offset], Most::ANGLE)?;
    Ok(Some(Mimic { master: mimic.joint.clone(), multiplier, offset }))
}

/// The type of a joint between the world and a base that moves freely; it is held.
pub(super) fn of_free_base(joint: &urdf_rs::Joint) -> Option<&'static str> {
    match joint.joint_type {
        JointType::Floating => Some("floating"),
        JointType::Planar => Some("planar"),
        _ => None,
    }
}

fn kind(joint: &urdf_rs::Joint) -> Result<JointKind, RobotError> {
    let kind = match joint.joint_type {
        JointType::Revolute => return Ok(JointKind::Revolute),
        JointType::Continuous => return Ok(JointKind::Continuous),
        JointType::Prismatic => return Ok(JointKind::Prismatic),
        JointType::Fixed => "fixed",
        JointType::Floating => "floating",
        JointType::Planar => "planar",
        JointType::Spherical => "spherical",
    };
    Err(RobotError::UnsupportedJoint { joint: joint.name.clone(), kind })
}

/// The limits; a missing attribute is read as 0 and means that the limit is not known.
fn limits(joint: &urdf_rs::Joint, kind: JointKind) -> Result<Limits, RobotError> {
    let limit = &joint.limit;
    let (lower, upper) = (limit.lower, limit.upper);
    for (quantity, value) in [("lower limit", lower), ("upper limit", upper)] {
        if value.is_nan() {
            return Err(out_of_range(joint, quantity, value, "a number"));
        }
    }
    if lower > upper {
        let joint = joint.name.clone();
        return Err(RobotError::LimitsReversed { joint, lower, upper });
    }
    let unknown = lower.abs() <= 0.0 && upper.abs() <= 0.0;
    let endless = lower < -LARGEST && upper > LARGEST;
    let bounded = kind != JointKind::Continuous && !unknown && !endless;
    Ok(Limits {
        position: bounded.then_some((lower, upper)),
        velocity: largest(joint, "velocity limit", limit.velocity)?,
        effort: largest(joint, "effort limit", limit.effort)?,
    })
}

fn largest(
    joint: &urdf_rs::Joint,
    quantity: &'static str,
    value: f64,
) -> Result<Option<f64>, RobotError> {
    if value.is_nan() || value < 0.0 {
        return Err(out_of_range(joint, quantity, value, "a number not below 0"));
    }
    Ok(Some(value).filter(|v| *v > 0.0 && *v < LARGEST))
}

fn out_of_range(
    joint: &urdf_rs::Joint,
    quantity: &'static str,
    value: f64,
    expected: &'static str,
) -> RobotError {
    RobotError::OutOfRange { thing: format!("joint {}", joint.name), quantity, value, expected }
}

fn finite(
    thing: impl Fn() -> String,
    quantity: &'static str,
    values: &[f64],
    Most(most, expected): Most,
) -> Result<(), RobotError> {
    match values.iter().copied().find(|v| v.is_nan() || v.abs() > most) {
        Some(value) if value.is_finite() => {
            Err(RobotError::OutOfRange { thing: thing(), quantity, value, expected })
        }
        Some(value) => Err(RobotError::NotFinite { thing: thing(), quantity, value }),
        None => Ok(()),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The nine entries written out: an independent formula for `pose`.
    fn by_hand([r, p, y]: [f64; 3]) -> Matrix3<f64> {
        let (sr, cr) = r.sin_cos();
        let (sp, cp) = p.sin_cos();
        let (sy, cy) = y.sin_cos();
        Matrix3::new(
            cy * cp,
            cy * sp * sr - sy * cr,
            cy * sp * cr + sy * sr, //
            sy * cp,
            sy * sp * sr + cy * cr,
            sy * sp * cr - cy * sr, //
            -sp,
            cp * sr,
            cp * cr,
        )
    }

    #[test]
    fn rpy_makes_the_round_trip_at_full_precision() {
        for i in 0..200 {
            let i = f64::from(i);
            let rpy = [(0.7 * i).sin() * 3.1, (1.3 * i).cos() * 1.5, (2.1 * i).sin() * 3.1];
            let origin = urdf_rs::Pose { xyz: urdf_rs::Vec3::default(), rpy: urdf_rs::Vec3(rpy) };
            let pose = pose(&origin);
            let error = pose.rotation.to_rotation_matrix().into_inner() - by_hand(rpy);
            assert!(error.amax() < 1e-15, "rpy {rpy:?}: rotation is wrong by {}", error.amax());
            // Near a pitch of a quarter turn the angles lose digits: cos(1.5) = 0.07.
            let (r, p, y) = pose.rotation.euler_angles();
            let error = Vector3::new(r, p, y) - Vector3::from(rpy);
            assert!(error.amax() < 1e-13, "rpy {rpy:?}: angles are wrong by {}", error.amax());
        }
    }

    #[test]
    fn a_quarter_turn_leaves_no_more_than_rounding() {
        let quarter = std::f64::consts::FRAC_PI_2;
        let origin = urdf_rs::Pose {
            xyz: urdf_rs::Vec3::default(),
            rpy: urdf_rs::Vec3([quarter, 0.0, 0.0]),
        };
        let turned = pose(&origin) * Vector3::y();
        assert!((turned - Vector3::z()).amax() < 3e-16, "{turned}");
    }
}
