use nalgebra::{DVector, Isometry3, Matrix3, Matrix3xX, Point3, Vector3};
use robot::Robot;

/// A point of the last link and the joints that carry it.
#[derive(Debug, Clone)]
pub(crate) struct Tip<'a> {
    robot: &'a Robot,
    /// Indices from the base to the last link.
    chain: Vec<usize>,
    point_in_link: Point3<f64>,
}

/// Iterations of the inverse kinematics for one point.
const MOST_ITERATIONS: usize = 500;
/// Longest step of one iteration (rad or m, norm over the joints).
const LONGEST_STEP: f64 = 0.3;
/// Distance at which a point counts as reached (m).
pub(crate) const REACHED_M: f64 = 1e-9;
/// Step at which a posture counts as the nearest (rad or m).
const SETTLED: f64 = 1e-10;

impl<'a> Tip<'a> {
    pub(crate) fn new(robot: &'a Robot, point_in_link: Point3<f64>) -> Self {
        let mut chain = Vec::new();
        let mut next = robot.joint_count().checked_sub(1);
        while let Some(index) = next {
            chain.push(index);
            next = robot.links()[index].parent;
        }
        chain.reverse();
        Self { robot, chain, point_in_link }
    }

    /// The point in the base frame (m).
    pub(crate) fn position(&self, q: &DVector<f64>) -> Point3<f64> {
        self.position_and_jacobian(q).0
    }

    /// The point and its derivative by the joints: `axis x (p - origin)` for a rotation,
    /// `axis` for a translation, all in the base frame.
    fn position_and_jacobian(&self, q: &DVector<f64>) -> (Point3<f64>, Matrix3xX<f64>) {
        let mut base_from_link = Isometry3::identity();
        let mut axes = Vec::new();
        for &index in &self.chain {
            let joint = &self.robot.links()[index].joint;
            base_from_link *= joint.parent_from_child(q[index]);
            // The axis is the same in the frames before and behind the joint.
            axes.push((index, base_from_link * joint.axis_in_joint, base_from_link.translation));
        }
        let point = base_from_link * self.point_in_link;
        let mut jacobian = Matrix3xX::zeros(q.len());
        for (index, axis, origin) in axes {
            let rotates = self.robot.links()[index].joint.kind.is_rotation();
            let lever = point.coords - origin.vector;
            let column = if rotates { axis.cross(&lever) } else { axis.into_inner() };
            jacobian.set_column(index, &column);
        }
        (point, jacobian)
    }

    /// The posture nearest to `home` in which the point is at `target`, from `start` on.
    ///
    /// Damped least squares with the way home in the null space,
    ///
    /// ```text
    /// dq = J^T (J J^T + d I)^-1 (e - J h) + h,   h = home - q,   d = |e|^2 + 1e-12
    /// ```
    ///
    /// with `e` from the point to the target. At convergence `e = 0` and `h` lies in the row space
    /// of `J`: the conditions of the nearest posture. The posture depends on the target alone, so a
    /// closed figure gives a closed motion. The damping vanishes with the error. Returns the
    /// posture and the distance left (m).
    pub(crate) fn reach(
        &self,
        target: &Point3<f64>,
        start: &DVector<f64>,
        home: &DVector<f64>,
    ) -> (DVector<f64>, f64) {
        let mut q = start.clone();
        for _ in 0..MOST_ITERATIONS {
            let (point, jacobian) = self.position_and_jacobian(&q);
            let error: Vector3<f64> = target - point;
            let way_home = home - &q;
            let damping = Matrix3::identity() * (error.norm_squared() + 1e-12);
            let gram: Matrix3<f64> = &jacobian * jacobian.transpose() + damping;
            let Some(inverse) = gram.try_inverse() else { break };
            let mut step =
                jacobian.transpose() * (inverse * (error - &jacobian * &way_home)) + way_home;
            let length = step.norm();
            if length < SETTLED && error.norm() < REACHED_M {
                break;
            }
            step *= (LONGEST_STEP / length).min(1.0);
            q += step;
        }
        let miss = (target - self.position(&q)).norm();
        (q, miss)
    }
}
