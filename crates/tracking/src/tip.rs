use nalgebra::{Isometry3, Point3};
use robot::Robot;

/// A point of the last link in the base frame (m) when the joints are at `q` (rad or m).
///
/// ```text
/// point_in_base = product over the joints that carry it of parent_from_child(q) * point_in_link
/// ```
pub(crate) fn tip_in_base(robot: &Robot, point_in_link: &Point3<f64>, q: &[f64]) -> Point3<f64> {
    let mut base_from_tip = Isometry3::identity();
    let mut next = robot.joint_count().checked_sub(1);
    while let Some(index) = next {
        let link = &robot.links()[index];
        base_from_tip = link.joint.parent_from_child(q[index]) * base_from_tip;
        next = link.parent;
    }
    base_from_tip * point_in_link
}
