use document::{Document, DocumentError, KeyPath};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::corner::EffortClass;

/// Least and largest rate of a log (Hz).
const RATES_HZ: [f64; 2] = [1.0, 10_000.0];
/// Least and largest resolution of an encoder (bits a turn).
const BITS: [u8; 2] = [8, 24];

/// What logs are read with, in place of what arms of a class have. Each value of a list is as likely; where a list
/// is empty, arms have what their class has.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct Instruments {
    /// Rates of the logs (Hz), 1 to 10000.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub rates_hz: Vec<f64>,
    /// Resolutions of the encoders (bits a turn), 8 to 24.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub encoder_bits: Vec<u8>,
    /// Sources of the effort.
    #[serde(skip_serializing_if = "Vec::is_empty")]
    pub effort_kinds: Vec<EffortClass>,
}

/// One draw of instruments; `None` is what the class of the arm has.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Instrument {
    /// Rate of the log (Hz).
    pub log_rate_hz: Option<f64>,
    /// Resolution of the encoders (bits a turn).
    pub encoder_bits: Option<u8>,
    /// Source of the effort.
    pub effort: Option<EffortClass>,
}

impl Instruments {
    /// Refuses values that no instrument has. `key` is where they stand in the document.
    ///
    /// # Errors
    ///
    /// [`DocumentError`] at the list with the value.
    pub(crate) fn check(&self, document: &Document, key: &KeyPath) -> Result<(), DocumentError> {
        let mistake = |name: &str, found: String| {
            Err(document.mistake(&key.clone().key("instruments").key(name), found, None))
        };
        let [low, high] = RATES_HZ;
        if let Some(rate) = self.rates_hz.iter().find(|rate| !(low..=high).contains(*rate)) {
            return mistake(
                "rates_hz",
                format!("{rate}, rates from {low} to {high} were expected"),
            );
        }
        let [low, high] = BITS;
        if let Some(bits) = self.encoder_bits.iter().find(|bits| !(low..=high).contains(*bits)) {
            let found = format!("{bits}, whole numbers from {low} to {high} were expected");
            return mistake("encoder_bits", found);
        }
        Ok(())
    }

    /// Draws one of each list.
    pub(crate) fn draw(&self, random: &mut ChaCha8Rng) -> Instrument {
        Instrument {
            log_rate_hz: one(&self.rates_hz, random),
            encoder_bits: one(&self.encoder_bits, random),
            effort: one(&self.effort_kinds, random),
        }
    }
}

/// One value of a list, each as likely; `None` of an empty one, which draws nothing.
fn one<T: Copy>(list: &[T], random: &mut ChaCha8Rng) -> Option<T> {
    (!list.is_empty())
        .then(|| random.random_range(0..list.len()))
        .and_then(|k| list.get(k).copied())
}
