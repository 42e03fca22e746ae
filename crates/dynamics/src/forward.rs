use nalgebra::DVector;

use crate::cholesky::{factor, solve_factored};
use crate::error::{DynamicsError, check};
use crate::model::{Dynamics, Workspace};
use crate::rotor::Rotors;

impl Dynamics {
    /// Joint accelerations (rad/s² or m/s²) that the torque `tau` (N·m or N) produces.
    ///
    /// ```text
    /// qdd = (M(q) + rotors)^-1 (tau - C(q, qd) qd - g(q))
    /// ```
    ///
    /// `tau` is what reaches the rigid bodies and the rotors: friction is subtracted
    /// beforehand. Solved with a Cholesky factor of the mass matrix: for the arms at
    /// hand (n below 10) that is as fast as the articulated-body algorithm and shares
    /// its code with [`Dynamics::mass_matrix`].
    ///
    /// # Errors
    ///
    /// [`DynamicsError::WrongLength`], [`DynamicsError::NotFinite`], and
    /// [`DynamicsError::MassMatrixNotPositive`] when the inertias are not physical.
    pub fn forward_dynamics(
        &self,
        q: &[f64],
        qd: &[f64],
        tau: &[f64],
        rotors: Rotors,
    ) -> Result<DVector<f64>, DynamicsError> {
        self.check_state(q, qd)?;
        check("tau", tau, self.joint_count())?;
        let mut qdd = DVector::from_column_slice(tau);
        self.forward_dynamics_into(&mut self.workspace(), q, qd, rotors, qdd.as_mut_slice())?;
        Ok(qdd)
    }

    /// [`Dynamics::forward_dynamics`] for a loop: `tau_to_qdd` holds the torque on entry
    /// and the acceleration on return; allocates nothing.
    ///
    /// # Errors
    ///
    /// [`DynamicsError::MassMatrixNotPositive`]; `tau_to_qdd` is then meaningless.
    ///
    /// # Panics
    ///
    /// When a slice does not have n entries or `ws` belongs to another robot.
    pub fn forward_dynamics_into(
        &self,
        ws: &mut Workspace,
        q: &[f64],
        qd: &[f64],
        rotors: Rotors,
        tau_to_qdd: &mut [f64],
    ) -> Result<(), DynamicsError> {
        let n = self.joint_count();
        let mut matrix = std::mem::take(&mut ws.matrix);
        // The right-hand side, with the bias torque in the first row of the scratch matrix.
        self.inverse_dynamics_bias(ws, q, qd, &mut matrix[..n]);
        tau_to_qdd.iter_mut().zip(&matrix).for_each(|(tau, bias)| *tau -= bias);

        self.mass_matrix_into(ws, q, &mut matrix);
        if rotors == Rotors::Included {
            self.rotor_inertia.iter().enumerate().for_each(|(i, ia)| matrix[i * n + i] += ia);
        }
        let factored = factor(&mut matrix, n);
        if factored.is_ok() {
            solve_factored(&matrix, tau_to_qdd);
        }
        ws.matrix = matrix;
        factored.map_err(|(joint, pivot)| DynamicsError::MassMatrixNotPositive { joint, pivot })
    }

    /// `C(q, qd) qd + g(q)`.
    fn inverse_dynamics_bias(&self, ws: &mut Workspace, q: &[f64], qd: &[f64], tau: &mut [f64]) {
        self.assert_lengths(ws, [q.len(), qd.len(), tau.len()]);
        self.outward(ws, q, -self.gravity_in_base, |i| (qd[i], 0.0));
        self.inward(ws, tau);
    }
}
