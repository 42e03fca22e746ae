//! Pinocchio's numbers for arms in some states (`tests/golden/dynamics_*.json`).

use serde::Deserialize;

use crate::arms::workspace_root;

/// One arm.
#[derive(Debug, Clone, Deserialize)]
pub struct Golden {
    /// Free fall in the base frame (m/s²).
    pub gravity: [f64; 3],
    /// Names of the joints.
    pub joints: Vec<String>,
    /// Rotor inertia of every joint (kg m²).
    pub rotor_inertia: Vec<f64>,
    /// Inertial parameters of every link, about its origin.
    pub inertial_parameters: Vec<[f64; 10]>,
    /// The states.
    pub states: Vec<State>,
}

/// One state, and what Pinocchio computes in it (SI).
#[derive(Debug, Clone, Deserialize)]
pub struct State {
    /// Positions.
    pub q: Vec<f64>,
    /// Velocities.
    pub qd: Vec<f64>,
    /// Accelerations.
    pub qdd: Vec<f64>,
    /// Torques without rotors.
    pub tau_rigid_body: Vec<f64>,
    /// Torques with rotors.
    pub tau_with_rotor: Vec<f64>,
    /// Rows of the mass matrix.
    pub mass_matrix: Vec<Vec<f64>>,
    /// Gravity torques.
    pub gravity: Vec<f64>,
    /// Coriolis and centrifugal torques.
    pub coriolis: Vec<f64>,
    /// Accelerations from the torques.
    pub qdd_from_tau: Vec<f64>,
    /// Sums over the rows of the regressor.
    pub regressor_row_sums: Vec<f64>,
}

/// The arm called `name` in the names of the files.
pub fn golden(name: &str) -> Golden {
    let path = workspace_root().join(format!("tests/golden/dynamics_{name}.json"));
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}
