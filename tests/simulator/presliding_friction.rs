use crate::rig::{Row, STEPPING, flywheel, run, simulator};

const INERTIA: f64 = 0.5;
const STIFFNESS: f64 = 2000.0;

fn bristles(damping: f64, level: f64) -> String {
    format!(
        "[[effect]]\npresliding_friction = {{ joint = 'joint', stiffness_nm_per_rad = {STIFFNESS}, \
         damping_nm_s_per_rad = {damping}, level_nm = {level} }}"
    )
}

/// Slow cycles between `-x level` and `x level`: the torque along each branch is
/// `level (1 - (1 + x) exp(-stiffness way / level))`, so that the loop closes with width and area
///
/// ```text
/// width = level / stiffness ln((1 + x) / (1 - x))
/// area = 2 level^2 / stiffness (ln((1 + x) / (1 - x)) - 2 x)
/// ```
#[test]
fn oracle_the_loop_below_the_level_is_closed_and_free_of_the_rate() {
    let (level, x) = (1.0, 0.6_f64);
    let width = level / STIFFNESS * ((1.0 + x) / (1.0 - x)).ln();
    let area = 2.0 * level * (width - 2.0 * x * level / STIFFNESS);
    for hz in [0.25, 0.5] {
        let mut wheel = simulator(&flywheel(0.01, 0.01), &bristles(0.1, level), STEPPING).unwrap();
        wheel.start(&[0.0]);
        let torque = |t: f64| x * level * (std::f64::consts::TAU * hz * t).sin();
        let rows = run(&mut wheel, 3.0 / hz, |r| vec![torque(r.time_s)]).unwrap();
        let cycle = &rows[2 * rows.len() / 3..];
        let positions = || cycle.iter().map(|r| r.q_true[0]);
        let found = positions().fold(f64::MIN, f64::max) - positions().fold(f64::MAX, f64::min);
        assert!((found / width - 1.0).abs() < 2e-3, "{hz} Hz: width {found}, not {width}");
        let work = |w: &[Row]| torque(w[0].time_s) * (w[1].q_true[0] - w[0].q_true[0]);
        let found: f64 = cycle.windows(2).map(work).sum();
        assert!((found / area - 1.0).abs() < 2e-3, "{hz} Hz: area {found}, not {area}");
        let gap = (cycle[cycle.len() - 1].q_true[0] - cycle[0].q_true[0]).abs();
        assert!(gap < 0.02 * width, "{hz} Hz: the loop is open by {gap}");
    }
}

/// Far below the level the bristles are a spring with damping: `omega^2 = k / I - delta^2`,
/// `delta = damping / (2 I)`.
#[test]
fn oracle_small_vibrations_have_the_bristles_frequency_and_damping() {
    let damping = 3.0;
    let mut wheel =
        simulator(&flywheel(INERTIA - 0.1, 0.1), &bristles(damping, 1000.0), STEPPING).unwrap();
    wheel.start_moving(&[0.0], &[1e-4]);
    let delta = 0.5 * damping / INERTIA;
    let omega = (STIFFNESS / INERTIA - delta * delta).sqrt();
    for row in run(&mut wheel, 0.5, |_| vec![0.0]).unwrap() {
        let t = row.time_s;
        let expected = 1e-4 / omega * (-delta * t).exp() * (omega * t).sin();
        assert!((row.q_true[0] - expected).abs() < 2e-3 * 1e-4 / omega, "{t} s");
    }
}

/// Sliding, the friction is `level`; with damping or without.
#[test]
fn oracle_a_wheel_that_slides_is_braked_by_the_level() {
    for damping in [0.0, 30.0] {
        let mut wheel =
            simulator(&flywheel(INERTIA - 0.1, 0.1), &bristles(damping, 0.75), STEPPING).unwrap();
        wheel.start_moving(&[0.0], &[3.0]);
        let rows = run(&mut wheel, 1.5, |_| vec![0.0]).unwrap();
        let (early, late) = (&rows[100], &rows[700]);
        let braking = (early.qd_true[0] - late.qd_true[0]) / (late.time_s - early.time_s);
        assert!((braking * INERTIA / 0.75 - 1.0).abs() < 1e-6, "{braking}");
    }
}
