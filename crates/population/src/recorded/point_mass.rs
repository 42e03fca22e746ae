use logs::Run;
use nalgebra::{Isometry3, Point3, Vector3};
use robot::Robot;

use crate::recorded::signals::{acceleration, average};

/// A point mass on the last link.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct PointMass {
    /// Mass (kg).
    pub mass: f64,
    /// Where it is (m), in the frame of the link.
    pub com: [f64; 3],
}

/// Torques that move and carry a point mass on the last link of a robot, joint by joint (N m or N):
///
/// ```text
/// tau_j = mass (dp/dq_j) . (p'' - g)
/// dp/dq_j = a_j x (p - o_j)  for a rotation about the axis a_j through o_j,  a_j  for a translation
/// ```
///
/// `p` is the position of the mass in the base frame along the run, averaged over 20 ms to either side, and
/// `p''` its second difference over the same time. Only kinematics of the robot enter. Joints that do not carry
/// the last link get zero.
pub fn point_mass_torque(robot: &Robot, run: &Run, body: &PointMass) -> Vec<Vec<f64>> {
    let smooth: Vec<Vec<f64>> =
        run.joints.iter().map(|joint| average(&run.time, &joint.position)).collect();
    let carrying = carrying(robot);
    let mut place = [const { Vec::new() }; 3];
    let mut slopes = vec![Vec::with_capacity(run.time.len()); robot.joint_count()];
    let at = |row: usize| poses(robot, |joint| smooth[joint][row]);
    for poses in (0..run.time.len()).map(at) {
        let tip = poses.last().map_or_else(Point3::origin, |pose| pose * Point3::from(body.com));
        place.iter_mut().zip(tip.coords.iter()).for_each(|(axis, x)| axis.push(*x));
        for &joint in &carrying {
            slopes[joint].push(slope(robot, &poses, joint, tip));
        }
    }
    let [x, y, z] = place.map(|axis| acceleration(&run.time, &axis));
    let force =
        |row: usize| body.mass * (Vector3::new(x[row], y[row], z[row]) - robot.gravity_in_base());
    let torque = |slopes: &Vec<Vector3<f64>>| -> Vec<f64> {
        let along = |row: usize| slopes.get(row).map_or(0.0, |slope| slope.dot(&force(row)));
        (0..run.time.len()).map(along).collect()
    };
    slopes.iter().map(torque).collect()
}

/// Poses of the links in the base frame at positions `q(joint)`.
fn poses(robot: &Robot, q: impl Fn(usize) -> f64) -> Vec<Isometry3<f64>> {
    let mut poses: Vec<Isometry3<f64>> = Vec::with_capacity(robot.joint_count());
    for (joint, link) in robot.links().iter().enumerate() {
        let parent = link.parent.map_or_else(Isometry3::identity, |parent| poses[parent]);
        poses.push(parent * link.joint.parent_from_child(q(joint)));
    }
    poses
}

/// Joints between the base and the last link.
fn carrying(robot: &Robot) -> Vec<usize> {
    let last = robot.joint_count().checked_sub(1);
    let up = |joint: &usize| robot.links()[*joint].parent;
    std::iter::successors(last, up).collect()
}

/// Motion of a point of the base frame per motion of a joint that carries it.
fn slope(
    robot: &Robot,
    poses: &[Isometry3<f64>],
    joint: usize,
    point: Point3<f64>,
) -> Vector3<f64> {
    let (pose, kind) = (&poses[joint], &robot.links()[joint].joint);
    let axis = pose.rotation * kind.axis_in_joint.into_inner();
    if kind.kind.is_rotation() {
        axis.cross(&(point.coords - pose.translation.vector))
    } else {
        axis
    }
}
