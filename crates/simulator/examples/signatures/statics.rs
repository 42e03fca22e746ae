use nalgebra::{Isometry3, Point3, Vector3};
use robot::Robot;

/// Torque that holds a joint of a chain at rest (N m), from the moments of all weights it
/// carries:
///
/// ```text
/// g_j = -sum_i m_i (z_j x (c_i - p_j)) . gravity,  i from j on
/// ```
///
/// with `z_j` the axis of the joint through `p_j` and `c_i` the centres of mass.
pub fn gravity_torque(robot: &Robot, q: &[f64], joint: usize) -> f64 {
    let mut base_from_link = Isometry3::identity();
    let (mut axis, mut place) = (Vector3::zeros(), Point3::origin());
    let mut torque = 0.0;
    for (i, link) in robot.links().iter().enumerate() {
        base_from_link *= link.joint.parent_from_child(q[i]);
        if i == joint {
            axis = base_from_link * link.joint.axis_in_joint.into_inner();
            place = base_from_link * Point3::origin();
        }
        let com = base_from_link * Point3::from(link.inertia.com_in_link);
        let moment = axis.cross(&(com - place)) * link.inertia.mass;
        torque -= moment.dot(&robot.gravity_in_base());
    }
    torque
}

/// The torque over positions of one joint, the others where they are in `posture`.
pub fn gravity_curve(robot: &Robot, posture: &[f64], joint: usize, at: &[f64]) -> Vec<[f64; 2]> {
    let mut q = posture.to_vec();
    let mut point = |&x: &f64| {
        q[joint] = x;
        [x, gravity_torque(robot, &q, joint)]
    };
    at.iter().map(&mut point).collect()
}
