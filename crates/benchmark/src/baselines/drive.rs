use robot::Actuator;

/// State of a joint at one instant: position, velocity, acceleration, direction, and the torque of the bodies.
pub(super) struct Instant {
    pub q: f64,
    pub qd: f64,
    pub qdd: f64,
    pub sign: f64,
    pub body: f64,
}

/// Effort that a described drive is expected to report, without the effects that have a memory:
///
/// ```text
/// load   = body + stiffness x + cubic x³ + counterbalance sin(q + phase),   x = q - rest
/// level  = coulomb (1 + wave(q)) + stribeck(qd) + load_friction |load|
/// effort = ratio gain (load + rotor qdd + viscous qd + level s + ripple(q)) + offset
/// ```
///
/// Hysteresis, presliding, play, elasticity, delay, lag and shared motors are left out.
pub(super) fn effort(a: &Actuator, at: &Instant) -> f64 {
    let x = at.q - a.spring_rest;
    let balance = a.counterbalance.map_or(0.0, |c| c.amplitude * (at.q + c.phase).sin());
    let load = at.body + a.spring_stiffness * x + a.spring_cubic * x * x * x + balance;
    let coulomb = if at.sign > 0.0 { a.coulomb_forward } else { a.coulomb_backward };
    let wave = a.friction_wave.map_or(0.0, |w| w.share * (w.periods * at.q + w.phase).cos());
    let stribeck = a.stribeck.map_or(0.0, |s| s.excess * (-(at.qd / s.velocity).powi(2)).exp());
    let level = coulomb * (1.0 + wave) + stribeck + a.load_friction * load.abs();
    let ripple = a.ripple.map_or(0.0, |r| r.amplitude * (r.periods * at.q + r.phase).sin());
    let torque = load + a.rotor_inertia * at.qdd + a.viscous * at.qd + level * at.sign + ripple;
    a.transmission_ratio * a.torque_gain * torque + a.torque_offset
}
