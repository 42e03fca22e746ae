use crate::rig::{STEPPING, flywheel, run, simulator};

/// `qd = tau t / (I + J)`, with `J` of the description and of the effects.
#[test]
fn oracle_a_constant_torque_accelerates_link_and_rotors_together() {
    for added in [vec![], vec![0.25], vec![-0.1], vec![0.25, 0.5]] {
        let effect = |j: &f64| {
            format!("[[effect]]\nrotor_inertia = {{ joint = 'joint', inertia_kg_m2 = {j} }}\n")
        };
        let effects: String = added.iter().map(effect).collect();
        let effects = if added.is_empty() { "effect = []".to_owned() } else { effects };
        let mut wheel = simulator(&flywheel(0.4, 0.1), &effects, STEPPING).unwrap();
        wheel.start(&[0.0]);
        let rows = run(&mut wheel, 1.0, |_| vec![1.5]).unwrap();
        let last = rows.last().unwrap();
        let speed = 1.5 * last.time_s / (0.5 + added.iter().sum::<f64>());
        assert!((last.qd_true[0] - speed).abs() < 1e-9 * speed, "{added:?}");
    }
}
