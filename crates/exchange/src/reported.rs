use nalgebra::{Isometry3, Translation3, UnitQuaternion};
use robot::{Joint, Robot};

/// The same robot in the positions that its encoders report.
///
/// ```text
/// q = q_reported - offset
/// parent_from_child(q) = parent_from_joint motion(-offset) motion(q_reported)
/// ```
///
/// The encoder offsets become 0; limits and spring rests are shifted by them.
pub fn at_reported_positions(robot: &Robot) -> Robot {
    let mut robot = robot.clone();
    for index in 0..robot.joint_count() {
        let Some(link) = robot.link_mut(index) else { continue };
        let offset = std::mem::take(&mut link.actuator.encoder_offset);
        if offset.abs() > 0.0 {
            let moved = motion(&link.joint, -offset);
            let joint = &mut link.joint;
            joint.parent_from_joint *= moved;
            joint.limits.position =
                joint.limits.position.map(|(low, high)| (low + offset, high + offset));
            link.actuator.spring_rest += offset;
        }
    }
    robot
}

/// Pose of a joint at position `q` (rad or m) relative to its pose at zero.
pub fn motion(joint: &Joint, q: f64) -> Isometry3<f64> {
    if joint.kind.is_rotation() {
        let rotation = UnitQuaternion::from_axis_angle(&joint.axis_in_joint, q);
        Isometry3::from_parts(Translation3::identity(), rotation)
    } else {
        let way = Translation3::from(joint.axis_in_joint.into_inner() * q);
        Isometry3::from_parts(way, UnitQuaternion::identity())
    }
}
