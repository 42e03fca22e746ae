use std::collections::BTreeMap;
use std::path::Path;

use diagnosis::SearchAccount;
use document::Document;
use population::{EffortClass, TruthSheet};
use serde::Deserialize;

use crate::error::BenchmarkError;

/// Share of a joint's torque that the oracle adds to the noise of every effort: the digits of a log.
const DIGITS: f64 = 1e-4;

/// Rate at which the oracle looks at logs (Hz).
const ORACLE_RATE_HZ: f64 = 50.0;

/// Integral of `1 / (1 + x^8)^2` over all positive `x`: noise in the band of a diagnosis, in cut-offs.
const PASSED: f64 = 0.897_91;

/// Noise of the efforts as the oracle of a trial takes it from the sensors.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct OracleEffortNoise {
    /// Two-sided density of each joint ((N m)^2/Hz or N^2/Hz); none where it is the known one.
    pub density: Vec<f64>,
}

#[derive(Deserialize)]
struct TruthScenario {
    #[serde(default)]
    sensors: EffortSensors,
}

#[derive(Default, Deserialize)]
struct EffortSensors {
    #[serde(default)]
    effort_noise_nm: BTreeMap<String, f64>,
    #[serde(default)]
    effort_resolution_nm: BTreeMap<String, f64>,
}

impl OracleEffortNoise {
    /// Reads the scenario of a trial's folder. Where the effort is a command it has no densities: there the oracle
    /// measures the noise in the logs themselves, so that it is the known one.
    ///
    /// ```text
    /// density = (deviation^2 + step^2 / 12) / rate of the log + (1e-4 scale)^2 / rate of the oracle
    /// ```
    ///
    /// # Errors
    ///
    /// Those of reading it.
    pub fn read(folder: &Path, sheet: &TruthSheet) -> Result<Self, BenchmarkError> {
        if sheet.corner.effort == EffortClass::Command {
            return Ok(Self::default());
        }
        let document = Document::read(folder.join("truth").join("scenario.toml"))?;
        let sensors = document.parse::<TruthScenario>()?.sensors;
        let joint = |(name, scale): (&String, &f64)| {
            let of = |map: &BTreeMap<String, f64>| map.get(name).copied().unwrap_or(0.0);
            let step = of(&sensors.effort_resolution_nm);
            let variance = of(&sensors.effort_noise_nm).powi(2) + step * step / 12.0;
            variance / sheet.corner.rate_hz + (DIGITS * scale).powi(2) / ORACLE_RATE_HZ
        };
        Ok(Self { density: sheet.joints.iter().zip(&sheet.torque_rms).map(joint).collect() })
    }

    /// The oracle's noise over the known one at a joint, at most one; the noise of the encoders counts in both.
    pub(super) fn share_of_known(&self, joint: usize, account: &SearchAccount) -> f64 {
        let (Some(density), Some(reach)) = (self.density.get(joint), account.joints.get(joint))
        else {
            return 1.0;
        };
        let effort = (2.0 * PASSED * account.cutoff_hz * density).sqrt();
        let known = reach.effort_noise.hypot(reach.encoder_noise);
        if known > 0.0 { (effort.hypot(reach.encoder_noise) / known).min(1.0) } else { 1.0 }
    }
}
