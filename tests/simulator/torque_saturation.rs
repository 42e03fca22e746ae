use std::f64::consts::TAU;

use crate::rig::{FINE, acting, flywheel, run, simulator};

/// A sine of 3 N m against a limit of 2 N m: the peaks are cut, the flanks are not, and what is
/// measured at the motor says so.
#[test]
fn oracle_the_torque_follows_its_command_up_to_the_limit_and_no_further() {
    let effect = "[[effect]]\ntorque_saturation = { joint = 'joint', limit_nm = 2.0 }";
    let mut wheel = simulator(&flywheel(0.4, 0.1), effect, FINE).unwrap();
    wheel.start(&[0.0]);
    let command = |t: f64| 3.0 * (TAU * 5.0 * t).sin();
    let rows = run(&mut wheel, 0.4, |r| vec![command(r.time_s)]).unwrap();
    let mut cut = 0;
    for ((time_s, torque), row) in acting(&rows, 0.5).into_iter().zip(&rows[1..]) {
        // Half of the step still belongs to the last command.
        let asked = 0.5 * (command(time_s) + command(time_s - 1e-4));
        let expected = asked.signum() * asked.abs().min(2.0);
        assert!((torque - expected).abs() < 1e-6, "{time_s} s: {torque} N m, not {expected}");
        assert!((row.logged.effort[0] - expected).abs() < 1e-9);
        cut += usize::from(asked.abs() > 2.0);
    }
    // |3 sin| > 2 for 1 - 2 asin(2/3) / pi of the time.
    let share = 1.0 - 2.0 * (2.0_f64 / 3.0).asin() / std::f64::consts::PI;
    assert!((cut as f64 / rows.len() as f64 - share).abs() < 2e-3);
}
