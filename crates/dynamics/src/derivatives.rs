use nalgebra::DMatrix;

use crate::error::{DynamicsError, check};
use crate::link_in_base::{LinkInBase, VelocityChange};
use crate::model::{Dynamics, Workspace};

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
                let mut f = link.inertia.apply(&link.s_rate.times(2.0));
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
        ws.in_base[0] = LinkInBase::at_rest();
        ws.in_base[0].a.linear = -self.gravity_in_base;
        for (i, joint) in self.joints.iter().enumerate() {
            let parent = &ws.in_base[joint.parent];
            let pose = parent.pose.then(&joint.pose(q[i]));
            let s = pose.motion_to_parent(&joint.axis);
            let s_rate = parent.v.cross(&s);
            let mut a_by_q = parent.a.cross(&s);
            a_by_q.add(&parent.v.cross(&s_rate));
            let mut v = s.times(qd[i]);
            v.add(&parent.v);
            let mut a = s.times(qdd[i]);
            a.add(&s_rate.times(qd[i]));
            a.add(&parent.a);
            let inertia = pose.inertia_to_parent(&joint.inertia);
            let mut f = inertia.apply(&a);
            f.add(&v.cross_force(&inertia.apply(&v)));
            let change = VelocityChange::of(&inertia, &v);
            ws.in_base[i + 1] = LinkInBase { pose, s, v, a, s_rate, a_by_q, inertia, change, f };
        }
    }
}
