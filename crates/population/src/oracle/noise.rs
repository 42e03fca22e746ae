use std::f64::consts::TAU;

use crate::oracle::command_noise::CommandNoise;

/// What the sensors of a joint add, in the torque of that joint.
///
/// ```text
/// variance of a sample at frequency f = (sigma_tau^2 + step_tau^2 / 12 + S_command(f)) / n
///                                     + (M_jj (2 pi f)^2)^2 (sigma_q^2 + step_q^2 / 12) / n
/// ```
///
/// with `n` the samples of the log that were averaged, `M_jj` what the joint turns, and [`CommandNoise`] where the
/// effort is a command.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct OracleNoise {
    /// Variance of the effort reading (N^2 m^2 or N^2), its steps included.
    pub effort: f64,
    /// Variance of the position reading (rad^2 or m^2), its steps included.
    pub position: f64,
    /// What gains make of the encoder's steps, in a logged command.
    pub command: CommandNoise,
    /// What the joint turns (kg m2 or kg).
    pub inertia: f64,
}

/// What a sensor's reading is off by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ReadingError {
    /// Standard deviation of its noise.
    pub deviation: f64,
    /// Step of the reading, zero for none.
    pub step: f64,
}

impl ReadingError {
    fn variance(self) -> f64 {
        self.deviation * self.deviation + self.step * self.step / 12.0
    }
}

impl OracleNoise {
    /// From deviations and steps of the readings: a step spreads evenly over its width.
    pub(crate) fn new(effort: ReadingError, position: ReadingError, inertia: f64) -> Self {
        Self {
            effort: effort.variance(),
            position: position.variance(),
            command: CommandNoise::default(),
            inertia,
        }
    }

    /// Variance of an effort (N^2 m^2 or N^2), at its noisiest frequency.
    pub(crate) fn most(&self) -> f64 {
        self.effort + self.command.most()
    }

    /// Variance of a mean over `n` samples at a frequency (Hz).
    pub(crate) fn at(&self, hz: f64, n: usize) -> f64 {
        let carried = self.inertia * (TAU * hz).powi(2);
        (self.effort + self.command.at(hz) + carried * carried * self.position) / n as f64
    }
}
