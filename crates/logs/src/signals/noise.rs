use std::f64::consts::TAU;

/// Origin of the density of a channel's noise.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NoiseSource {
    /// The step of the readings: `step^2 / 12`, spread over the band in which the readings change.
    Step,
    /// The spectrum above the motion, where it is flat over an octave and a half or more.
    AboveTheMotion,
    /// Unknown, with a density of zero. The readings have no step. Above the motion the spectrum is not flat, or it is
    /// lower than that of any sensor, behind the edge of a low-pass.
    Unknown,
}

/// White noise of a channel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChannelNoise {
    /// One-sided density (unit^2/Hz).
    pub density: f64,
    /// Step of the readings (unit), where they lie on a lattice.
    pub step: Option<f64>,
    /// Origin of the density.
    pub source: NoiseSource,
}

/// Noise of the channels of a joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointNoise {
    /// Noise of the position (rad or m).
    pub position: ChannelNoise,
    /// Noise of the velocity column (rad/s or m/s). `None` where the column is not used, where its noise is
    /// unknown, or where the column is a difference of the positions and has their noise.
    pub velocity: Option<ChannelNoise>,
    /// Noise of the acceleration column (rad/s² or m/s²), where it is used.
    pub acceleration: Option<ChannelNoise>,
    /// Noise of the second encoder (rad or m), where there is one.
    pub link: Option<ChannelNoise>,
    /// Noise of the effort (N·m or N).
    pub effort: ChannelNoise,
}

/// Integrals over all `x` of `x^(2 n) / (1 + x^8)^2`, with `n` the number of differentiations:
/// `(1 / 8) B((2 n + 1) / 8, (15 - 2 n) / 8)`.
const PASSED: [f64; 3] = [0.897_91, 0.265_66, 0.159_39];

impl ChannelNoise {
    /// A channel whose noise is unknown.
    pub const UNKNOWN: Self = Self { density: 0.0, step: None, source: NoiseSource::Unknown };
}

impl JointNoise {
    /// A joint whose noise is unknown.
    pub const UNKNOWN: Self = Self {
        position: ChannelNoise::UNKNOWN,
        velocity: None,
        acceleration: None,
        link: None,
        effort: ChannelNoise::UNKNOWN,
    };

    /// One-sided density of the noise of the acceleration at a frequency, before the low-pass
    /// (unit²/Hz; (rad/s²)²/Hz or (m/s²)²/Hz):
    ///
    /// ```text
    /// S = S_qdd                                   where the acceleration column is used
    ///   = (2 pi f)^2 min(S_qd, (2 pi f)^2 S_q)    where the velocity column is used
    ///   = (2 pi f)^4 S_q                          else
    /// ```
    ///
    /// A robot may compute its velocity from the positions, by difference and low-pass. The noise of such a velocity is
    /// that of the positions below the cut-off of that low-pass, and looks white above.
    pub fn acceleration_density(&self, hz: f64) -> f64 {
        let each = self.under_acceleration().map(|(density, n)| (TAU * hz).powi(2 * n) * density);
        each.fold(f64::INFINITY, f64::min)
    }

    /// Standard deviation of the noise of the acceleration after the low-pass of
    /// [`crate::prepare`] (rad/s² or m/s²):
    ///
    /// ```text
    /// sigma^2 = integral of S(f) / (1 + (f / cutoff)^8)^2
    ///         = .159 (2 pi cutoff)^4 cutoff S_q
    /// ```
    ///
    /// for a position. It is `.266 (2 pi cutoff)^2 cutoff S_qd` for a velocity, and `.898 cutoff S_qdd` for an
    /// acceleration. Where the velocity is used, the smaller of the values of position and velocity is taken.
    /// The cut-off is assumed to be far below the sampling rate.
    pub fn acceleration_rms(&self, cutoff_hz: f64) -> f64 {
        let squares = self.under_acceleration().map(|(density, n)| {
            PASSED[n as usize] * (TAU * cutoff_hz).powi(2 * n) * density * cutoff_hz
        });
        squares.fold(f64::INFINITY, f64::min).sqrt()
    }

    /// Standard deviation of the noise of the position after the same low-pass (rad or m).
    pub fn position_rms(&self, cutoff_hz: f64) -> f64 {
        (PASSED[0] * self.position.density * cutoff_hz).sqrt()
    }

    /// Standard deviation of the noise of the velocity after the same low-pass (rad/s or m/s).
    pub fn velocity_rms(&self, cutoff_hz: f64) -> f64 {
        let differentiated = PASSED[1] * (TAU * cutoff_hz).powi(2) * self.position.density;
        let own = self.velocity.map_or(f64::INFINITY, |v| PASSED[0] * v.density);
        (differentiated.min(own) * cutoff_hz).sqrt()
    }

    /// Noise densities from which the acceleration may be computed, and the number of differentiations of each,
    /// 0 to 2.
    fn under_acceleration(&self) -> impl Iterator<Item = (f64, i32)> {
        let own = self.acceleration.map(|a| (a.density, 0));
        let below = own.is_none();
        let velocity = self.velocity.filter(|_| below).map(|v| (v.density, 1));
        let position = below.then_some((self.position.density, 2));
        own.into_iter().chain(velocity).chain(position)
    }
}
