use diagnosis::{EffectAt, PlaceAccount, PlaceTest};
use experiment::stored;
use population::Strength;
use serde::{Deserialize, Serialize};

use crate::account::loss_stage::LossStage;

/// A visible cause that was missed or a finding that is false, and the first stage that loses it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct LostName {
    /// The effect and its place.
    #[serde(flatten, deserialize_with = "stored::place")]
    pub at: EffectAt,
    /// Whether it was missed or is false.
    pub error: NameError,
    /// How visible the cause is to the oracle; `None` for a false finding.
    pub strength: Option<Strength>,
    /// The stage.
    pub stage: LossStage,
    /// Why, in words.
    pub because: String,
    /// See [`PlaceAccount::beside_truth`].
    pub beside_truth: Option<PlaceTest>,
    /// See [`PlaceAccount::with_known_noise`].
    pub with_known_noise: Option<PlaceTest>,
    /// See [`PlaceAccount::beside_found`].
    pub beside_found: Option<PlaceTest>,
    /// Found names in its place.
    #[serde(deserialize_with = "stored::places")]
    pub takers: Vec<EffectAt>,
}

/// What is wrong with a name.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum NameError {
    /// A visible cause that no finding names.
    Missed,
    /// A finding that is not true.
    False,
}

impl LostName {
    pub(super) fn new(
        at: &EffectAt,
        strength: Option<Strength>,
        (stage, because): (LossStage, String),
        place: Option<&PlaceAccount>,
    ) -> Self {
        let error = if strength.is_some() { NameError::Missed } else { NameError::False };
        let takers = place.map_or(&[][..], |place| &place.takers);
        Self {
            at: at.clone(),
            error,
            strength,
            stage,
            because,
            beside_truth: place.and_then(|place| place.beside_truth),
            with_known_noise: place.and_then(|place| place.with_known_noise),
            beside_found: place.and_then(|place| place.beside_found),
            takers: takers.iter().map(|taker| taker.at.clone()).collect(),
        }
    }
}
