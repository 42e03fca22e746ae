use robot::{Actuator, Warming};

use crate::motion::dry_friction::dry_friction;

/// Torque that a joint's drive needs beside the rigid bodies (N·m or N), in the state
/// `q, qd, qdd`, with `direction` of motion in [-1, 1] and `tau_rb` the rigid bodies' torque:
///
/// ```text
/// load = tau_rb + stiffness x + cubic x³ + hysteresis direction + counterbalance(q),   x = q - rest
/// load - tau_rb + rotor_inertia qdd + viscous qd + dry friction(q, qd, direction, load) + ripple(q)
/// ```
///
/// The friction is that of a warm drive.
pub fn drive_torque(drive: &Actuator, state: [f64; 3], direction: f64, tau_rb: f64) -> f64 {
    let spring = spring_torque(drive, state[0]) + drive.spring_hysteresis * direction;
    spring + motor_torque(drive, state, direction, tau_rb + spring, 1.0)
}

/// Warm-up of a drive after `time` time constants: `1 - exp(-time)`.
pub(crate) fn warmth(time: f64) -> f64 {
    -(-time.max(0.0)).exp_m1()
}

/// The part of the drive's torque that acts at the motor (N·m or N), under the `load` of its transmission, with the
/// warm-up `warmth` of the drive in [0, 1].
pub(crate) fn motor_torque(
    drive: &Actuator,
    [q, qd, qdd]: [f64; 3],
    direction: f64,
    load: f64,
    warmth: f64,
) -> f64 {
    let ripple = drive.ripple.map_or(0.0, |r| r.amplitude * (r.periods * q + r.phase).sin());
    let friction = drive.viscous * qd + dry_friction(drive, [q, qd], direction, load);
    let damping = drive.presliding.and(drive.presliding_damping).unwrap_or(0.0);
    let lost = |w: Warming| warmth * (w.viscous_lost * qd + w.coulomb_lost * direction);
    let friction = friction - drive.warming.map_or(0.0, lost);
    drive.rotor_inertia * qdd + friction + ripple + damping * bending(qd, direction)
}

/// Speed at which bristles bend that hold the share `s` of dry friction: `qd - |qd| s`.
pub(crate) fn bending(qd: f64, s: f64) -> f64 {
    qd - qd.abs() * s
}

/// The torque of a joint's spring without its loop and of its counterbalance (N·m or N):
///
/// ```text
/// stiffness x + cubic x³ + amplitude sin(q + phase),   x = q - rest
/// ```
pub(crate) fn spring_torque(drive: &Actuator, q: f64) -> f64 {
    let x = q - drive.spring_rest;
    let balance = drive.counterbalance.map_or(0.0, |c| c.amplitude * (q + c.phase).sin());
    drive.spring_stiffness * x + drive.spring_cubic * x.powi(3) + balance
}

/// Its derivative by the position (N·m/rad or N/m).
pub(crate) fn spring_slope(drive: &Actuator, q: f64) -> f64 {
    let x = q - drive.spring_rest;
    let balance = drive.counterbalance.map_or(0.0, |c| c.amplitude * (q + c.phase).cos());
    drive.spring_stiffness + 3.0 * drive.spring_cubic * x * x + balance
}

/// The share of dry friction that bristles hold, in [-1, 1], of a joint that follows `q`:
///
/// ```text
/// ds = (dq - |dq| s) / way
/// ```
///
/// It is exact for a position that is linear between samples, and starts without tension.
pub(crate) fn bristles(q: &[f64], way: f64) -> Vec<f64> {
    let mut held = 0.0;
    let mut before = q.first().copied().unwrap_or(0.0);
    let step = |&q: &f64| {
        let moved = q - std::mem::replace(&mut before, q);
        let end = if moved < 0.0 { -1.0 } else { 1.0 };
        held = end + (held - end) * (-moved.abs() / way).exp();
        held
    };
    q.iter().map(step).collect()
}
