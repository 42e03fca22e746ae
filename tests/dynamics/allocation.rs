//! The loop versions allocate nothing.

use dynamics::{ColumnSet, Dynamics, Rotors};

use checks::arms::random_tree;

#[test]
fn the_loop_versions_allocate_nothing() {
    let dynamics = Dynamics::new(&random_tree(1));
    let (n, mut ws) = (dynamics.joint_count(), dynamics.workspace());
    let (q, qd, qdd) = (vec![0.3; n], vec![0.7; n], vec![-0.2; n]);
    let (mut tau, mut matrix, mut gravity) = (vec![0.0; n], vec![0.0; n * n], vec![0.0; 3 * n]);
    let (mut y, mut columns) = (vec![0.0; 10 * n * n], vec![0.0; 14 * n * n]);
    let (mut own, mut derivatives) = (vec![0.0; 10 * n], [(); 3].map(|()| vec![0.0; n * n]));
    let counted = allocation_counter::measure(|| {
        dynamics.inverse_dynamics_into(&mut ws, &q, &qd, &qdd, &mut tau);
        dynamics.forward_dynamics_into(&mut ws, &q, &qd, Rotors::Included, &mut tau).unwrap();
        dynamics.gravity_into(&mut ws, &q, &mut tau);
        dynamics.coriolis_into(&mut ws, &q, &qd, &mut tau);
        dynamics.mass_matrix_into(&mut ws, &q, &mut matrix);
        let [dq, dqd, dqdd] = &mut derivatives;
        let state = [q.as_slice(), &qd, &qdd];
        dynamics.inverse_dynamics_derivatives_into(&mut ws, state, [dq, dqd, dqdd]);
        dynamics.gravity_regressor_into(&mut ws, &q, &mut gravity);
        dynamics.torque_regressor_into(&mut ws, &q, &qd, &qdd, &mut y);
        dynamics.link_regressor_into(&mut ws, n - 1, state, &mut own);
        dynamics.columns_into(&mut ws, [&q, &qd, &qdd], ColumnSet::ALL, &mut columns);
    });
    assert_eq!(counted.count_total, 0);
    // The counter does count.
    let allocating = allocation_counter::measure(|| drop(dynamics.gravity(&q)));
    assert!(allocating.count_total > 0);
}
