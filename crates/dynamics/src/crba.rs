use nalgebra::DMatrix;

use crate::error::{DynamicsError, check};
use crate::model::{Dynamics, Workspace};

impl Dynamics {
    /// Joint-space inertia `M(q)` of the rigid bodies, symmetric, n x n.
    ///
    /// ```text
    /// kinetic energy = 1/2 qd' M(q) qd
    /// ```
    ///
    /// Entry (i, j) has the unit N·m per rad/s² between revolute joints, N per m/s²
    /// between prismatic ones. Rotor inertia is left out: it would be added to the
    /// diagonal ([`Dynamics::rotor_inertia`]).
    ///
    /// # Errors
    ///
    /// [`DynamicsError::WrongLength`] and [`DynamicsError::NotFinite`].
    ///
    /// # Source
    ///
    /// Featherstone 2008, table 6.2 (composite rigid bodies).
    pub fn mass_matrix(&self, q: &[f64]) -> Result<DMatrix<f64>, DynamicsError> {
        let n = self.joint_count();
        check("q", q, n)?;
        let mut matrix = DMatrix::zeros(n, n);
        self.mass_matrix_into(&mut self.workspace(), q, matrix.as_mut_slice());
        Ok(matrix)
    }

    /// [`Dynamics::mass_matrix`] for a loop: writes the n² entries, allocates nothing.
    ///
    /// # Panics
    ///
    /// When `q` does not have n or `matrix` n² entries, or `ws` belongs to another robot.
    pub fn mass_matrix_into(&self, ws: &mut Workspace, q: &[f64], matrix: &mut [f64]) {
        let n = self.joint_count();
        self.assert_lengths(ws, [q.len()]);
        assert_eq!(matrix.len(), n * n, "the mass matrix has n² entries");
        matrix.fill(0.0);
        self.composites(ws, q);
        for i in (0..n).rev() {
            let joint = &self.joints[i];
            // The wrench that accelerates everything joint i carries, seen by each joint below it.
            let mut f = ws.composite[i + 1].apply(&joint.axis);
            matrix[i * n + i] = joint.axis.dot(&f);
            let mut at = i + 1;
            loop {
                f = ws.links[at].pose.force_to_parent(&f);
                at = self.joints[at - 1].parent;
                if at == 0 {
                    break;
                }
                let entry = self.joints[at - 1].axis.dot(&f);
                matrix[i * n + at - 1] = entry;
                matrix[(at - 1) * n + i] = entry;
            }
        }
    }

    /// Poses at `q`, and the inertia of every link with all it carries, in the link's frame.
    pub(crate) fn composites(&self, ws: &mut Workspace, q: &[f64]) {
        for (i, (joint, &q)) in self.joints.iter().zip(q).enumerate() {
            ws.links[i + 1].pose = joint.pose(q);
            ws.composite[i + 1] = joint.inertia;
        }
        for (i, joint) in self.joints.iter().enumerate().rev() {
            if joint.parent != 0 {
                let carried = ws.links[i + 1].pose.inertia_to_parent(&ws.composite[i + 1]);
                ws.composite[joint.parent].add(&carried);
            }
        }
    }
}
