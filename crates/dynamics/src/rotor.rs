use nalgebra::DVector;

use crate::error::{DynamicsError, check};
use crate::model::Dynamics;

/// Whether the inertia of rotors and gears moves with the joints.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Rotors {
    /// Rigid bodies only.
    Excluded,
    /// The rotor inertia of every joint on the diagonal of the mass matrix.
    Included,
}

impl Dynamics {
    /// Inertia of rotor and gear seen at each joint (kg m² or kg), from the robot's actuators.
    pub fn rotor_inertia(&self) -> &DVector<f64> {
        &self.rotor_inertia
    }

    /// Adds what the rotors ask for, `tau += rotor_inertia qdd` per joint (N·m or N).
    ///
    /// The gyroscopic moments of fast rotors are neglected, as in the diagonal
    /// "armature" of other engines.
    ///
    /// # Errors
    ///
    /// [`DynamicsError::WrongLength`] and [`DynamicsError::NotFinite`].
    pub fn add_rotor_torque(&self, qdd: &[f64], tau: &mut [f64]) -> Result<(), DynamicsError> {
        check("qdd", qdd, self.joint_count())?;
        check("tau", tau, self.joint_count())?;
        for ((tau, qdd), inertia) in tau.iter_mut().zip(qdd).zip(&self.rotor_inertia) {
            *tau += inertia * qdd;
        }
        Ok(())
    }
}
