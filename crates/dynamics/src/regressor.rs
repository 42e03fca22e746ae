use nalgebra::{DMatrix, Vector3};

use crate::error::{DynamicsError, check};
use crate::model::{Dynamics, LinkState, Workspace};
use crate::spatial::{SpatialMotion, multiply};

/// Parameters of one link in the regressor.
pub const PARAMETERS_PER_LINK: usize = 10;

impl Dynamics {
    /// The torque regressor `Y(q, qd, qdd)`, n x 10 n, of the rigid bodies:
    ///
    /// ```text
    /// tau = Y pi,  pi per link = [m, m c (3), Ixx, Ixy, Iyy, Ixz, Iyz, Izz]
    /// ```
    ///
    /// about the link's origin in the link's axes (`robot::Inertia::parameters`), links
    /// in the robot's order. Units are those of [`Dynamics::inverse_dynamics`], whose
    /// result it reproduces with the robot's own parameters.
    ///
    /// # Errors
    ///
    /// [`DynamicsError::WrongLength`] and [`DynamicsError::NotFinite`].
    pub fn torque_regressor(
        &self,
        q: &[f64],
        qd: &[f64],
        qdd: &[f64],
    ) -> Result<DMatrix<f64>, DynamicsError> {
        self.check_state(q, qd)?;
        let n = self.joint_count();
        check("qdd", qdd, n)?;
        let mut y = vec![0.0; n * PARAMETERS_PER_LINK * n];
        self.torque_regressor_into(&mut self.workspace(), q, qd, qdd, &mut y);
        Ok(DMatrix::from_row_slice(n, PARAMETERS_PER_LINK * n, &y))
    }

    /// [`Dynamics::torque_regressor`] for a loop: writes `y` row by row (joint `i` at
    /// `10 n i`), allocates nothing.
    ///
    /// The block of joint i and link j is zero unless joint i carries link j. It is the
    /// power of a unit of joint i's motion, written in link j's frame, against the
    /// inertial wrench of link j.
    ///
    /// # Panics
    ///
    /// When `y` does not have 10 n² or another slice n entries, or `ws` belongs to another robot.
    pub fn torque_regressor_into(
        &self,
        ws: &mut Workspace,
        q: &[f64],
        qd: &[f64],
        qdd: &[f64],
        y: &mut [f64],
    ) {
        let n = self.joint_count();
        let width = PARAMETERS_PER_LINK * n;
        self.assert_lengths(ws, [q.len(), qd.len(), qdd.len()]);
        assert_eq!(y.len(), n * width, "the regressor has 10 n² entries");
        self.outward(ws, q, -self.gravity_in_base, |i| (qd[i], qdd[i]));
        y.fill(0.0);
        for j in 0..n {
            self.axes_at(ws, j);
            let (link, axes) = (&ws.links[j + 1], &ws.axes[j * n..]);
            for i in self.carriers(j) {
                write_block(&axes[i], link, &mut y[i * width + PARAMETERS_PER_LINK * j..]);
            }
        }
    }

    /// The columns of [`Dynamics::torque_regressor_into`] of one link, to the bit: writes `y` row by row (joint
    /// `i` at `10 i`), allocates nothing.
    ///
    /// # Panics
    ///
    /// When `y` does not have 10 n or another slice n entries, there is no such link, or `ws` belongs to another
    /// robot.
    pub fn link_regressor_into(
        &self,
        ws: &mut Workspace,
        link: usize,
        [q, qd, qdd]: [&[f64]; 3],
        y: &mut [f64],
    ) {
        let n = self.joint_count();
        self.assert_lengths(ws, [q.len(), qd.len(), qdd.len()]);
        assert!(link < n && y.len() == PARAMETERS_PER_LINK * n, "10 n entries of one of n links");
        self.outward(ws, q, -self.gravity_in_base, |i| (qd[i], qdd[i]));
        y.fill(0.0);
        // No link carries one that comes before it.
        (0..=link)
            .filter(|&j| self.carriers(link).any(|i| i == j))
            .for_each(|j| self.axes_at(ws, j));
        let (state, axes) = (&ws.links[link + 1], &ws.axes[link * n..]);
        for i in self.carriers(link) {
            write_block(&axes[i], state, &mut y[PARAMETERS_PER_LINK * i..]);
        }
    }

    /// The joints that carry link `j`, its own first.
    fn carriers(&self, j: usize) -> impl Iterator<Item = usize> + '_ {
        let next = |&i: &usize| self.joints[i].parent.checked_sub(1);
        std::iter::successors(Some(j), next)
    }

    /// Writes the motions of the joints that carry link `j` in its frame, where those of the link that carries it
    /// are known.
    fn axes_at(&self, ws: &mut Workspace, j: usize) {
        let (n, joint, link) = (self.joint_count(), &self.joints[j], ws.links[j + 1]);
        let (above, axes) = ws.axes.split_at_mut(j * n);
        axes[j] = joint.axis;
        for i in self.carriers(j).skip(1) {
            axes[i] = link.pose.motion_to_link(&above[(joint.parent - 1) * n + i]);
        }
    }

    /// Derivative of the torque with respect to the gravity vector, n x 3:
    ///
    /// ```text
    /// g(q) = G(q) gravity_in_base
    /// ```
    ///
    /// Entry (i, k) in N·m (or N) per m/s². The torque is linear in gravity, and only
    /// its gravity term depends on it.
    ///
    /// # Errors
    ///
    /// [`DynamicsError::WrongLength`] and [`DynamicsError::NotFinite`].
    pub fn gravity_regressor(&self, q: &[f64]) -> Result<DMatrix<f64>, DynamicsError> {
        let n = self.joint_count();
        check("q", q, n)?;
        let mut g = vec![0.0; 3 * n];
        self.gravity_regressor_into(&mut self.workspace(), q, &mut g);
        Ok(DMatrix::from_row_slice(n, 3, &g))
    }

    /// [`Dynamics::gravity_regressor`] for a loop: writes `g` row by row, allocates nothing.
    ///
    /// # Panics
    ///
    /// When `g` does not have 3 n or `q` n entries, or `ws` belongs to another robot.
    pub fn gravity_regressor_into(&self, ws: &mut Workspace, q: &[f64], g: &mut [f64]) {
        self.assert_lengths(ws, [q.len()]);
        assert_eq!(g.len(), 3 * q.len(), "the gravity regressor has 3 n entries");
        self.composites(ws, q);
        for (i, row) in g.chunks_exact_mut(3).enumerate() {
            // Weight of all that joint i carries: power -(m s_linear + s_angular x h) . gravity.
            let (s, carried) = (&self.joints[i].axis, &ws.composite[i + 1]);
            let mut in_frame = -(carried.mass * s.linear + s.angular.cross(&carried.h));
            let mut at = i + 1;
            while at != 0 {
                in_frame = multiply(&ws.links[at].pose.rotation, &in_frame);
                at = self.joints[at - 1].parent;
            }
            row.copy_from_slice(in_frame.as_slice());
        }
    }
}

/// Row of one joint for the ten parameters of one link: with `s` the joint's motion and
/// `w`, `wd`, `a` the link's state, all in the link's frame,
///
/// ```text
/// force  = m a + wd x h + w x (w x h)
/// moment = I wd + w x (I w) + h x a
/// row pi = s_linear . force + s_angular . moment
/// ```
#[inline(always)]
fn write_block(s: &SpatialMotion, link: &LinkState, row: &mut [f64]) {
    let (sw, sv) = (&s.angular, &s.linear);
    let (w, wd, a) = (&link.w, &link.a.angular, &link.a.linear);
    let h = sv.cross(wd) + w * w.dot(sv) - sv * w.dot(w) + a.cross(sw);
    let u: Vector3<f64> = sw.cross(w);
    row[..PARAMETERS_PER_LINK].copy_from_slice(&[
        sv.dot(a),
        h.x,
        h.y,
        h.z,
        sw.x * wd.x + u.x * w.x,
        sw.x * wd.y + sw.y * wd.x + u.x * w.y + u.y * w.x,
        sw.y * wd.y + u.y * w.y,
        sw.x * wd.z + sw.z * wd.x + u.x * w.z + u.z * w.x,
        sw.y * wd.z + sw.z * wd.y + u.y * w.z + u.z * w.y,
        sw.z * wd.z + u.z * w.z,
    ]);
}
