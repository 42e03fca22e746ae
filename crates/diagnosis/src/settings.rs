use catalogue::EffectKind;

use crate::error::DiagnosisError;
use crate::thresholds::Thresholds;

/// How a diagnosis is made.
#[derive(Debug, Clone, PartialEq)]
pub struct Settings {
    /// Cut-off of the low-pass filter (Hz); chosen from the data when none is given.
    pub cutoff_hz: Option<f64>,
    /// Rate at which commanded efforts are updated (Hz); the rate of the log if `None`.
    pub control_rate_hz: Option<f64>,
    /// Least held-out fall of a joint's RMS error that counts, as a share of its effort RMS.
    pub practical_share: f64,
    /// Share of a joint's effort RMS below which a residual beyond the noise does not leave the joint open.
    pub open_share: f64,
    /// Effects that are not looked for, neither as findings nor as rivals.
    pub without: Vec<EffectKind>,
    /// Whether the extended robot has nothing but the findings ([`crate::AlsoFitted`] otherwise).
    pub only_findings: bool,
    /// Every other number that decides.
    pub thresholds: Thresholds,
}

impl Default for Settings {
    fn default() -> Self {
        Self {
            cutoff_hz: None,
            control_rate_hz: None,
            practical_share: 0.005,
            open_share: 0.02,
            without: Vec::new(),
            only_findings: false,
            thresholds: Thresholds::default(),
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
