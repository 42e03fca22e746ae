//! How far a motor is ahead of its link, and its rates.

use robot::Actuator;

/// Acceleration (rad/s² or m/s²) that the load must give the links for its sign to count.
///
/// The smaller it is the more abruptly a motor crosses its free play, and the rotor is asked for
/// up to `0.77 (gap/2) (jerk / acceleration)²`. At 1 rad/s² and a jerk of 100 rad/s³ a gap of
/// 2 mrad asks for 8 rad/s², as the motion itself does.
pub(crate) const CROSSING_ACCELERATION: f64 = 1.0;

/// Time between the states of the differences (s).
pub(crate) const SPACING_S: f64 = 1e-3;

/// Whether motor and link move together.
pub(crate) fn is_rigid(drive: &Actuator) -> bool {
    drive.elasticity.is_none() && drive.backlash <= 0.0
}

/// How far the motor is ahead of its link under a load (rad or m):
///
/// ```text
/// tau / elasticity + (backlash / 2) tanh(tau / tau_0)
/// ```
pub(crate) fn lead(drive: &Actuator, tau: f64, tau_0: f64) -> f64 {
    let twist = drive.elasticity.map_or(0.0, |stiffness| tau / stiffness);
    twist + 0.5 * drive.backlash * (tau / tau_0.max(f64::MIN_POSITIVE)).tanh()
}

/// Value and first two derivatives at the middle of three instants, by central differences.
pub(crate) fn differences([before, now, after]: [f64; 3]) -> [f64; 3] {
    const H: f64 = SPACING_S;
    [now, rate(before, after), (after - 2.0 * now + before) / (H * H)]
}

/// Derivative between two instants that are two spacings apart.
pub(crate) fn rate(before: f64, after: f64) -> f64 {
    (after - before) / (2.0 * SPACING_S)
}
