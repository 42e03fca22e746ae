use std::f64::consts::TAU;

/// What the sensors of a joint add, in the torque of that joint.
///
/// ```text
/// variance of a sample at frequency f = (sigma_tau^2 + step_tau^2 / 12) / n
///                                     + (M_jj (2 pi f)^2)^2 (sigma_q^2 + step_q^2 / 12) / n
/// ```
///
/// with `n` the samples of the log that were averaged, and `M_jj` what the joint turns.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointNoise {
    /// Variance of the effort reading (N^2 m^2 or N^2), its steps included.
    pub effort: f64,
    /// Variance of the position reading (rad^2 or m^2), its steps included.
    pub position: f64,
    /// What the joint turns (kg m2 or kg).
    pub inertia: f64,
}

impl JointNoise {
    /// From deviations and steps of the readings: a step spreads evenly over its width.
    pub fn new([sigma_tau, step_tau]: [f64; 2], [sigma_q, step_q]: [f64; 2], inertia: f64) -> Self {
        let variance = |sigma: f64, step: f64| sigma * sigma + step * step / 12.0;
        Self { effort: variance(sigma_tau, step_tau), position: variance(sigma_q, step_q), inertia }
    }

    /// Variance of a mean over `n` samples at a frequency (Hz).
    pub(crate) fn at(&self, hz: f64, n: usize) -> f64 {
        let carried = self.inertia * (TAU * hz).powi(2);
        (self.effort + carried * carried * self.position) / n as f64
    }
}
