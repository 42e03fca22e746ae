use crate::rig::{GRAVITY, STEPPING, flywheel, pendulum, run, simulator};

const COEFFICIENT: f64 = 0.2;
const FRICTION: &str =
    "[[effect]]\nload_dependent_friction = { joint = 'joint', coefficient = 0.2 }";

/// Held level, the transmission carries `m g l`: the pendulum leaves its place at
/// `(1 +- coefficient) m g l`, whatever the mass.
#[test]
fn oracle_the_level_follows_the_mass_that_is_carried() {
    for mass in [1.0, 3.0] {
        let carried = mass * GRAVITY * 0.2;
        for direction in [1.0, -1.0] {
            let mut arm = simulator(&pendulum(mass, 0.2), FRICTION, STEPPING).unwrap();
            arm.start(&[0.0]);
            // Gravity turns the joint positively.
            let torque = |t: f64| -carried * (1.0 - direction * 0.1 * t);
            let rows = run(&mut arm, 2.5, |r| vec![torque(r.time_s)]).unwrap();
            let held = rows.iter().filter(|r| r.time_s < 1.99);
            assert!(held.map(|r| r.q_true[0].abs()).fold(0.0, f64::max) < 1e-6);
            let moving = rows.iter().find(|r| direction * r.qd_true[0] > 1e-4).unwrap();
            let found = (torque(moving.time_s) + carried).abs() / carried;
            assert!((found / COEFFICIENT - 1.0).abs() < 0.01, "{mass} kg: {found}");
        }
    }
}

/// The transmission carries what turns the link, not the rotor. Braked by a torque,
///
/// ```text
/// (J + I) a = tau + coefficient I a,  a = tau / (J + (1 - coefficient) I)
/// ```
#[test]
fn oracle_the_load_of_a_wheel_is_its_inertia_without_the_rotors() {
    let (inertia, rotor, tau) = (0.4, 0.1, 0.5);
    let mut wheel = simulator(&flywheel(inertia, rotor), FRICTION, STEPPING).unwrap();
    wheel.start_moving(&[0.0], &[3.0]);
    let rows = run(&mut wheel, 1.5, |_| vec![-tau]).unwrap();
    let (early, late) = (&rows[10], &rows[700]);
    let braking = (early.qd_true[0] - late.qd_true[0]) / (late.time_s - early.time_s);
    let expected = tau / (rotor + (1.0 - COEFFICIENT) * inertia);
    assert!((braking / expected - 1.0).abs() < 1e-6, "{braking}, not {expected}");
}

/// Load, bristles and readings of an earlier run are gone.
#[test]
fn a_simulator_that_is_started_again_repeats_its_run_bitwise() {
    let bristles = "[[effect]]\npresliding_friction = { joint = 'joint', \
        stiffness_nm_per_rad = 1000.0, damping_nm_s_per_rad = 1.0, level_nm = 0.3 }";
    let effects = format!("{FRICTION}\n{bristles}");
    let mut arm = simulator(&pendulum(1.0, 0.2), &effects, STEPPING).unwrap();
    let mut once = || {
        arm.start(&[0.3]);
        run(&mut arm, 1.0, |r| vec![4.0 * r.time_s - 2.0]).unwrap()
    };
    assert_eq!(once(), once());
}
