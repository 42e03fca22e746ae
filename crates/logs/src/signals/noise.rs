use std::f64::consts::TAU;

/// Where the density of a channel's noise comes from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum NoiseSource {
    /// The step of its readings: `step^2 / 12` over the band in which they change.
    Step,
    /// What the channel holds above the motion, flat over an octave and a half or more.
    AboveTheMotion,
    /// Unknown, with a density of zero: the readings have no step, and above the motion there is no flat noise or
    /// less than any sensor has, behind the edge of a low-pass.
    Unknown,
}

/// White noise of a channel.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ChannelNoise {
    /// One-sided density (unit^2/Hz).
    pub density: f64,
    /// Step of the readings, where they lie on a lattice (unit).
    pub step: Option<f64>,
    /// Where the density comes from.
    pub source: NoiseSource,
}

/// Noise of the channels of a joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointNoise {
    /// Of the position (rad or m).
    pub position: ChannelNoise,
    /// Of the velocity column (rad/s or m/s), where it is used and its noise is its own; a column
    /// that is a difference of the positions has theirs.
    pub velocity: Option<ChannelNoise>,
    /// Of the acceleration column (rad/s² or m/s²), where it is used.
    pub acceleration: Option<ChannelNoise>,
    /// Of the second encoder (rad or m), where there is one.
    pub link: Option<ChannelNoise>,
    /// Of the effort (N·m or N).
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
    /// A velocity that the robot makes of its positions, by difference and low-pass, has their
    /// noise below that low-pass's cut-off and looks white above.
    pub fn acceleration_density(&self, hz: f64) -> f64 {
        let each = self.under_acceleration().map(|(density, n)| (TAU * hz).powi(2 * n) * density);
        each.fold(f64::INFINITY, f64::min)
    }

    /// Standard deviation of the noise of the acceleration behind the low-pass of
    /// [`crate::prepare`] (rad/s² or m/s²):
    ///
    /// ```text
    /// sigma^2 = integral of S(f) / (1 + (f / cutoff)^8)^2
    ///         = .159 (2 pi cutoff)^4 cutoff S_q
    /// ```
    ///
    /// for a position, and with .266 and .898 for a velocity and an acceleration; the smaller
    /// where there are two. The cut-off is taken to be far below the sampling rate.
    pub fn acceleration_rms(&self, cutoff_hz: f64) -> f64 {
        let squares = self.under_acceleration().map(|(density, n)| {
            PASSED[n as usize] * (TAU * cutoff_hz).powi(2 * n) * density * cutoff_hz
        });
        squares.fold(f64::INFINITY, f64::min).sqrt()
    }

    /// Standard deviation of the noise of the velocity behind the same low-pass (rad/s or m/s).
    pub fn velocity_rms(&self, cutoff_hz: f64) -> f64 {
        let differentiated = PASSED[1] * (TAU * cutoff_hz).powi(2) * self.position.density;
        let own = self.velocity.map_or(f64::INFINITY, |v| PASSED[0] * v.density);
        (differentiated.min(own) * cutoff_hz).sqrt()
    }

    /// Densities that the acceleration may have its noise from, and how often each channel is
    /// differentiated, 0 to 2.
    fn under_acceleration(&self) -> impl Iterator<Item = (f64, i32)> {
        let own = self.acceleration.map(|a| (a.density, 0));
        let below = own.is_none();
        let velocity = self.velocity.filter(|_| below).map(|v| (v.density, 1));
        let position = below.then_some((self.position.density, 2));
        own.into_iter().chain(velocity).chain(position)
    }
}
