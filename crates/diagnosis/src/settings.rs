use catalogue::EffectKind;

use crate::DiagnosisError;

/// How a diagnosis is made.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// Cut-off of the low-pass filter (Hz); chosen from the data when none is given.
    pub cutoff_hz: Option<f64>,
    /// Rate at which commanded efforts are renewed (Hz); the log's own where none is given.
    pub control_rate_hz: Option<f64>,
    /// Expected share of false causes among the findings.
    pub false_discovery_rate: f64,
    /// Seed of every random draw.
    pub seed: u64,
    /// Number of random sign patterns behind a p-value.
    pub sign_flips: usize,
    /// Least held-out fall of a joint's RMS error that counts, as a share of its effort RMS.
    pub practical_share: f64,
    /// Share of a joint's effort RMS below which what is left beyond the noise is not open.
    pub open_share: f64,
    /// Effects that are not looked for, and named neither as a cause nor as its rival.
    pub without: Vec<EffectKind>,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            cutoff_hz: None,
            control_rate_hz: None,
            false_discovery_rate: 0.05,
            seed: 0,
            // The least p-value, 1e-4, times a hundred and some hypotheses is still below 0.05.
            sign_flips: 9999,
            practical_share: 0.005,
            open_share: 0.02,
            without: Vec::new(),
        }
    }
}

impl Settings {
    /// The settings, if every one of them can be used.
    ///
    /// # Errors
    ///
    /// [`DiagnosisError::Setting`] names the first that cannot.
    pub fn check(&self) -> Result<(), DiagnosisError> {
        let refuse = |name, value, expected| Err(DiagnosisError::Setting { name, value, expected });
        match self.cutoff_hz {
            Some(hz) if !(hz.is_finite() && hz > 0.0) => {
                return refuse("cut-off", hz, "a positive number of hertz");
            }
            _ => {}
        }
        let fdr = self.false_discovery_rate;
        if !(fdr > 0.0 && fdr < 1.0) {
            return refuse("false discovery rate", fdr, "a number between 0 and 1");
        }
        if self.sign_flips < 99 {
            return refuse("number of sign flips", self.sign_flips as f64, "at least 99");
        }
        for (name, share) in
            [("practical share", self.practical_share), ("open share", self.open_share)]
        {
            if !(0.0..1.0).contains(&share) {
                return refuse(name, share, "a number from 0 to below 1");
            }
        }
        Ok(())
    }
}
