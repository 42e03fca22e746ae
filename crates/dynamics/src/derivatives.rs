use nalgebra::{DMatrix, Matrix3, Vector3};

use crate::DynamicsError;
use crate::error::check;
use crate::model::{Dynamics, Workspace};
use crate::spatial::{Force, Motion, Pose, RigidInertia, multiply, multiply_transposed};

/// How the torques of inverse dynamics change with the state, each n x n, row i of joint i's torque.
///
/// ```text
/// d tau = dq d q + dqd d qd + dqdd d qdd,   dqdd = M(q)
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct InverseDynamicsDerivatives {
    /// By position (N·m/rad; N/m between prismatic joints).
    pub dq: DMatrix<f64>,
    /// By velocity (N·m s/rad; N s/m).
    pub dqd: DMatrix<f64>,
    /// By acceleration: the mass matrix (kg m²; kg).
    pub dqdd: DMatrix<f64>,
}

/// One link in the base frame, all about the origin of that frame.
#[derive(Debug, Clone, Copy)]
pub(crate) struct InBase {
    pose: Pose,
    /// Motion of a unit of velocity of the joint that carries the link.
    s: Motion,
    v: Motion,
    /// Acceleration relative to free fall.
    a: Motion,
    /// Change of `s` as the link moves, `v x s`.
    s_rate: Motion,
    /// Change of the acceleration by the joint's position, `a_parent x s + v_parent x (v_parent x s)`.
    a_by_q: Motion,
    /// Inertia, momentum's change by velocity and wrench, of the link with all it carries.
    inertia: RigidInertia,
    change: Change,
    f: Force,
}

/// The change of a wrench by a velocity that is not the inertia's own turning,
///
/// ```text
/// B = (v x*) I - I (v x) + (. x* I v) = [ T, 0; -2 [l]x, 0 ]
/// T = [w]x I - I [w]x - h v' - v h' + 2 (v.h) 1 - [I w + h x v]x,   l = m v + w x h
/// ```
///
/// angular part first, with `w`, `v` the velocity, `h` the first and `I` the second moment.
#[derive(Debug, Clone, Copy)]
struct Change {
    t: Matrix3<f64>,
    l: Vector3<f64>,
}

impl Change {
    #[inline(always)]
    fn of(inertia: &RigidInertia, velocity: &Motion) -> Self {
        let RigidInertia { mass, h, about_origin } = inertia;
        let Motion { angular: w, linear: v } = velocity;
        let turned = w.cross_matrix() * about_origin;
        let moment = multiply(about_origin, w) + h.cross(v);
        // I [w]x is the negative transpose of [w]x I.
        let t = turned + turned.transpose() - h * v.transpose() - v * h.transpose()
            + Matrix3::from_diagonal_element(2.0 * v.dot(h))
            - moment.cross_matrix();
        Self { t, l: v * *mass + w.cross(h) }
    }

    /// `B m`.
    #[inline(always)]
    fn apply(&self, m: &Motion) -> Force {
        Force { angular: multiply(&self.t, &m.angular), linear: self.l.cross(&m.angular) * -2.0 }
    }

    /// `B' m`, of which the linear part is zero.
    #[inline(always)]
    fn apply_transposed(&self, m: &Motion) -> Vector3<f64> {
        multiply_transposed(&self.t, &m.angular) + self.l.cross(&m.linear) * 2.0
    }
}

impl InBase {
    pub fn at_rest() -> Self {
        let zero = Vector3::zeros();
        Self {
            pose: Pose::identity(),
            s: Motion::zero(),
            v: Motion::zero(),
            a: Motion::zero(),
            s_rate: Motion::zero(),
            a_by_q: Motion::zero(),
            inertia: RigidInertia { mass: 0.0, h: zero, about_origin: Matrix3::zeros() },
            change: Change { t: Matrix3::zeros(), l: zero },
            f: Force::zero(),
        }
    }
}

impl Dynamics {
    /// Derivatives of [`Dynamics::inverse_dynamics`] by position, velocity and acceleration, of the rigid
    /// bodies alone.
    ///
    /// # Errors
    ///
    /// [`DynamicsError::WrongLength`] and [`DynamicsError::NotFinite`].
    ///
    /// # Source
    ///
    /// Carpentier & Mansard, *Analytical Derivatives of Rigid Body Dynamics Algorithms*, RSS 2018.
    pub fn inverse_dynamics_derivatives(
        &self,
        q: &[f64],
        qd: &[f64],
        qdd: &[f64],
    ) -> Result<InverseDynamicsDerivatives, DynamicsError> {
        self.check_state(q, qd)?;
        let n = self.joint_count();
        check("qdd", qdd, n)?;
        let mut all = [(); 3].map(|()| vec![0.0; n * n]);
        let [dq, dqd, dqdd] = &mut all;
        self.inverse_dynamics_derivatives_into(
            &mut self.workspace(),
            [q, qd, qdd],
            [dq, dqd, dqdd],
        );
        let [dq, dqd, dqdd] = all.map(|rows| DMatrix::from_row_slice(n, n, &rows));
        Ok(InverseDynamicsDerivatives { dq, dqd, dqdd })
    }

    /// [`Dynamics::inverse_dynamics_derivatives`] for a loop, in the state `[q, qd, qdd]`: writes the n²
    /// entries of each, row by row, and allocates nothing.
    ///
    /// # Panics
    ///
    /// When a vector does not have n or a matrix n² entries, or `ws` belongs to another robot.
    pub fn inverse_dynamics_derivatives_into(
        &self,
        ws: &mut Workspace,
        state: [&[f64]; 3],
        [dq, dqd, dqdd]: [&mut [f64]; 3],
    ) {
        let n = self.joint_count();
        self.assert_lengths(ws, state.map(<[f64]>::len));
        let are_square = [&*dq, &*dqd, &*dqdd].iter().all(|matrix| matrix.len() == n * n);
        assert!(are_square, "every matrix has n² entries");
        [&mut *dq, &mut *dqd, &mut *dqdd].into_iter().for_each(|matrix| matrix.fill(0.0));
        self.outward_in_base(ws, state);
        for i in (0..n).rev() {
            let link = ws.in_base[i + 1];
            let by_qdd = link.inertia.apply(&link.s);
            let by_qd = {
                let mut f = link.inertia.apply(&link.s_rate.scaled(2.0));
                f.add(&link.change.apply(&link.s));
                f
            };
            let by_q = {
                let mut f = link.inertia.apply(&link.a_by_q);
                f.add(&link.change.apply(&link.s_rate));
                f.add(&link.s.cross_force(&link.f));
                f
            };
            let turning = link.change.apply_transposed(&link.s);
            let mut at = i + 1;
            while at != 0 {
                let other = &ws.in_base[at];
                let k = at - 1;
                dq[k * n + i] = other.s.dot(&by_q);
                dqd[k * n + i] = other.s.dot(&by_qd);
                let inertia = other.s.dot(&by_qdd);
                dqdd[k * n + i] = inertia;
                if k != i {
                    dqdd[i * n + k] = inertia;
                    dq[i * n + k] = other.a_by_q.dot(&by_qdd) + other.s_rate.angular.dot(&turning);
                    dqd[i * n + k] =
                        2.0 * other.s_rate.dot(&by_qdd) + other.s.angular.dot(&turning);
                }
                at = self.joints[k].parent;
            }
            let parent = &mut ws.in_base[self.joints[i].parent];
            parent.inertia.add(&link.inertia);
            parent.change.t += link.change.t;
            parent.change.l += link.change.l;
            parent.f.add(&link.f);
        }
    }

    /// Motion, inertia and wrench of every link in the base frame.
    fn outward_in_base(&self, ws: &mut Workspace, [q, qd, qdd]: [&[f64]; 3]) {
        ws.in_base[0] = InBase::at_rest();
        ws.in_base[0].a.linear = -self.gravity_in_base;
        for (i, joint) in self.joints.iter().enumerate() {
            let parent = &ws.in_base[joint.parent];
            let pose = parent.pose.then(&joint.pose(q[i]));
            let s = pose.motion_to_parent(&joint.axis);
            let s_rate = parent.v.cross(&s);
            let mut a_by_q = parent.a.cross(&s);
            a_by_q.add(&parent.v.cross(&s_rate));
            let mut v = s.scaled(qd[i]);
            v.add(&parent.v);
            let mut a = s.scaled(qdd[i]);
            a.add(&s_rate.scaled(qd[i]));
            a.add(&parent.a);
            let inertia = pose.inertia_to_parent(&joint.inertia);
            let mut f = inertia.apply(&a);
            f.add(&v.cross_force(&inertia.apply(&v)));
            let change = Change::of(&inertia, &v);
            ws.in_base[i + 1] = InBase { pose, s, v, a, s_rate, a_by_q, inertia, change, f };
        }
    }
}
