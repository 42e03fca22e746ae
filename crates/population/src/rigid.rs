//! The torques of rigid bodies, by which drives, gains and motions are sized.

use nalgebra::{DMatrix, Vector3};
use robot::Robot;

use crate::moving::body_torque;

/// Torque that a motion asks for (N m or N), rotors and springs of the robot included.
///
/// ```text
/// tau_i = bodies_i(q, qd, qdd) + rotor_i qdd_i + k_i (q_i - rest_i)
/// ```
pub(crate) fn torque(robot: &Robot, q: &[f64], qd: &[f64], qdd: &[f64]) -> Vec<f64> {
    let mut tau = vec![0.0; robot.joint_count()];
    body_torque(robot, q, qd, qdd, &mut tau);
    for (i, link) in robot.links().iter().enumerate() {
        let drive = &link.actuator;
        tau[i] += drive.rotor_inertia * qdd[i];
        tau[i] += drive.spring_stiffness * (q[i] - drive.spring_rest);
    }
    tau
}

/// Inertia in joint space (kg m^2 or kg), rotors on its diagonal.
pub(crate) fn mass_matrix(robot: &Robot, q: &[f64]) -> DMatrix<f64> {
    let count = robot.joint_count();
    let rest = vec![0.0; count];
    let weightless = robot.clone().with_gravity(Vector3::zeros());
    let mut column = rest.clone();
    let mut matrix = DMatrix::zeros(count, count);
    for j in 0..count {
        let mut unit = rest.clone();
        unit[j] = 1.0;
        body_torque(&weightless, q, &rest, &unit, &mut column);
        matrix.column_mut(j).copy_from_slice(&column);
        matrix[(j, j)] += robot.links()[j].actuator.rotor_inertia;
    }
    0.5 * (&matrix + matrix.transpose())
}
