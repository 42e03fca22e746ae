use nalgebra::{DVector, Vector3};

use crate::error::{DynamicsError, check};
use crate::model::{Dynamics, JointModel, LinkState, Workspace};
use crate::spatial::{Force, SpatialMotion, multiply, multiply_transposed};

impl Dynamics {
    /// Joint torques that produce the acceleration `qdd` in the state `(q, qd)`.
    ///
    /// Evaluates, in O(n) and without forming any of the three terms,
    ///
    /// ```text
    /// tau = M(q) qdd + C(q, qd) qd + g(q)
    /// ```
    ///
    /// of the rigid bodies. Rotor inertia is left out (add it with
    /// [`Dynamics::add_rotor_torque`]), and so is friction.
    ///
    /// # Arguments
    ///
    /// | symbol | length | unit (revolute / prismatic) | meaning                  |
    /// |--------|--------|-----------------------------|--------------------------|
    /// | `q`    | n      | rad / m                     | position, URDF zero      |
    /// | `qd`   | n      | rad/s / m/s                 | velocity                 |
    /// | `qdd`  | n      | rad/s² / m/s²               | acceleration             |
    /// | return | n      | N·m / N                     | torque on the child link |
    ///
    /// Entries follow the order of `robot.links()`. A positive torque accelerates
    /// its joint in the positive direction.
    ///
    /// # Errors
    ///
    /// [`DynamicsError::WrongLength`] and [`DynamicsError::NotFinite`].
    ///
    /// # Source
    ///
    /// Luh, Walker & Paul 1980; Featherstone 2008, chapter 5. Gravity enters as an
    /// upward acceleration of the base.
    pub fn inverse_dynamics(
        &self,
        q: &[f64],
        qd: &[f64],
        qdd: &[f64],
    ) -> Result<DVector<f64>, DynamicsError> {
        self.check_state(q, qd)?;
        check("qdd", qdd, self.joint_count())?;
        Ok(self.allocating(|ws, tau| self.inverse_dynamics_into(ws, q, qd, qdd, tau)))
    }

    /// [`Dynamics::inverse_dynamics`] for a loop: writes `tau`, allocates nothing.
    ///
    /// # Panics
    ///
    /// When a slice does not have n entries or `ws` belongs to another robot.
    pub fn inverse_dynamics_into(
        &self,
        ws: &mut Workspace,
        q: &[f64],
        qd: &[f64],
        qdd: &[f64],
        tau: &mut [f64],
    ) {
        self.assert_lengths(ws, [q.len(), qd.len(), qdd.len(), tau.len()]);
        self.outward(ws, q, -self.gravity_in_base, |i| (qd[i], qdd[i]));
        self.inward(ws, tau);
    }

    /// Gravity torque `g(q)` (N·m or N): what holds the robot still.
    ///
    /// # Errors
    ///
    /// [`DynamicsError::WrongLength`] and [`DynamicsError::NotFinite`].
    pub fn gravity(&self, q: &[f64]) -> Result<DVector<f64>, DynamicsError> {
        check("q", q, self.joint_count())?;
        Ok(self.allocating(|ws, tau| self.gravity_into(ws, q, tau)))
    }

    /// [`Dynamics::gravity`] for a loop: writes `tau`, allocates nothing.
    ///
    /// # Panics
    ///
    /// When a slice does not have n entries or `ws` belongs to another robot.
    pub fn gravity_into(&self, ws: &mut Workspace, q: &[f64], tau: &mut [f64]) {
        self.assert_lengths(ws, [q.len(), tau.len()]);
        self.outward(ws, q, -self.gravity_in_base, |_| (0.0, 0.0));
        self.inward(ws, tau);
    }

    /// Coriolis and centrifugal torque `C(q, qd) qd` (N·m or N).
    ///
    /// # Errors
    ///
    /// [`DynamicsError::WrongLength`] and [`DynamicsError::NotFinite`].
    pub fn coriolis(&self, q: &[f64], qd: &[f64]) -> Result<DVector<f64>, DynamicsError> {
        self.check_state(q, qd)?;
        Ok(self.allocating(|ws, tau| self.coriolis_into(ws, q, qd, tau)))
    }

    /// [`Dynamics::coriolis`] for a loop: writes `tau`, allocates nothing.
    ///
    /// # Panics
    ///
    /// When a slice does not have n entries or `ws` belongs to another robot.
    pub fn coriolis_into(&self, ws: &mut Workspace, q: &[f64], qd: &[f64], tau: &mut [f64]) {
        self.assert_lengths(ws, [q.len(), qd.len(), tau.len()]);
        self.outward(ws, q, Vector3::zeros(), |i| (qd[i], 0.0));
        self.inward(ws, tau);
    }

    /// Outward: pose, angular velocity and acceleration of every link.
    #[inline(always)]
    pub(crate) fn outward(
        &self,
        ws: &mut Workspace,
        q: &[f64],
        base_acceleration: Vector3<f64>,
        rates: impl Fn(usize) -> (f64, f64),
    ) {
        ws.links[0].a.linear = base_acceleration;
        ws.links[0].f = Force::zero();
        for (i, (joint, &q)) in self.joints.iter().zip(q).enumerate() {
            let parent = &ws.links[joint.parent];
            let (qd, qdd) = rates(i);
            ws.links[i + 1] = joint.child_state(parent, q, qd, qdd);
        }
    }

    /// Inward: the wrench of every link, handed down to its parent, and its torque.
    #[inline(always)]
    pub(crate) fn inward(&self, ws: &mut Workspace, tau: &mut [f64]) {
        for (i, (joint, tau)) in self.joints.iter().zip(tau).enumerate().rev() {
            let link = &ws.links[i + 1];
            let mut f = joint.body_wrench(link);
            f.add(&link.f);
            *tau = joint.axis.dot(&f);
            let handed_down = link.pose.force_to_parent(&f);
            ws.links[joint.parent].f.add(&handed_down);
        }
    }

    pub(crate) fn check_state(&self, q: &[f64], qd: &[f64]) -> Result<(), DynamicsError> {
        check("q", q, self.joint_count())?;
        check("qd", qd, self.joint_count())
    }

    pub(crate) fn assert_lengths<const K: usize>(&self, ws: &Workspace, lengths: [usize; K]) {
        let n = self.joint_count();
        assert!(lengths.iter().all(|&length| length == n), "every vector has {n} entries");
        assert_eq!(ws.links.len(), n + 1, "the workspace belongs to another robot");
    }

    fn allocating(&self, fill: impl FnOnce(&mut Workspace, &mut [f64])) -> DVector<f64> {
        let mut tau = DVector::zeros(self.joint_count());
        fill(&mut self.workspace(), tau.as_mut_slice());
        tau
    }
}

impl JointModel {
    /// State of the link from that of its parent. With `w`, `a` of the parent turned into
    /// the link's axes, and `p` the link's origin,
    ///
    /// ```text
    /// linear  = a.linear + a.angular x p + w x (w x p)
    /// revolute:  w_i = w + s qd,  angular += s qdd + w x s qd
    /// prismatic: w_i = w,         linear  += s qdd + 2 w x s qd
    /// ```
    #[inline(always)]
    fn child_state(&self, parent: &LinkState, q: f64, qd: f64, qdd: f64) -> LinkState {
        let pose = self.pose(q);
        let p = &pose.origin;
        let at_origin =
            parent.a.linear + parent.a.angular.cross(p) + parent.w.cross(&parent.w.cross(p));
        let mut w = multiply_transposed(&pose.rotation, &parent.w);
        let mut a = SpatialMotion {
            angular: multiply_transposed(&pose.rotation, &parent.a.angular),
            linear: multiply_transposed(&pose.rotation, &at_origin),
        };
        if self.is_rotation {
            let s = &self.axis.angular;
            a.angular += s * qdd + w.cross(s) * qd;
            w += s * qd;
        } else {
            let s = &self.axis.linear;
            a.linear += s * qdd + w.cross(s) * (2.0 * qd);
        }
        LinkState { pose, w, a, f: Force::zero() }
    }

    /// Newton and Euler about the link's origin:
    ///
    /// ```text
    /// force  = m a + wd x h + w x (w x h)
    /// moment = I wd + w x (I w) + h x a
    /// ```
    #[inline(always)]
    fn body_wrench(&self, link: &LinkState) -> Force {
        let mut f = self.inertia.apply(&link.a);
        f.linear += link.w.cross(&link.w.cross(&self.inertia.h));
        f.angular += link.w.cross(&multiply(&self.inertia.about_origin, &link.w));
        f
    }
}
