use robot::TorqueSource;

/// What the residual of a joint means.
#[derive(Debug, Clone, PartialEq)]
pub struct VerdictThresholds {
    /// Ratio of the residual to the noise up to which it still counts as noise, however long the log is (RMS, 1): a
    /// density read from a spectrum is some ten per cent off.
    pub noise_factor: f64,
    /// The same where the effort is a command, which contains the response of a controller to encoder steps (RMS, 1).
    /// With 1.2, a clean WAM is no longer consistent (`tests/diagnosis/hidden.rs`).
    pub commanded_noise_factor: f64,
    /// Number of standard errors of an RMS by which the residual may exceed that (1). With 3, no trial of 18 changed.
    pub rms_errors: f64,
    /// Share of the effort's RMS above which a remaining error of the size of noise leaves a joint open, unless the
    /// noise is the effort's own and the joint has no cause of its own (1).
    pub drowned: f64,
    /// Share of a joint's effort RMS below which dry friction that goes unseen does not matter (1). Of 78 arms of the
    /// panel that were called consistent or explained, 33 wrongly, .25 leaves 15 wrong and 38 right ones, .1 leaves 13
    /// and 33; the palm of a clean WAM, which needs 1.3 mN m, hides .12.
    pub unseen: f64,
    /// Share of the power of a remaining error that must lie above a frequency, for all of it to be said to be there
    /// (1).
    pub mostly_above: f64,
}

impl VerdictThresholds {
    /// Ratio of the residual to the noise up to which it counts as noise, for an effort of that source (RMS, 1).
    pub fn noise_factor_of(&self, source: TorqueSource) -> f64 {
        if source == TorqueSource::Commanded {
            self.commanded_noise_factor
        } else {
            self.noise_factor
        }
    }
}

impl Default for VerdictThresholds {
    fn default() -> Self {
        Self {
            noise_factor: 1.2,
            commanded_noise_factor: 1.6,
            rms_errors: 2.0,
            drowned: 0.15,
            unseen: 0.25,
            mostly_above: 0.9,
        }
    }
}
