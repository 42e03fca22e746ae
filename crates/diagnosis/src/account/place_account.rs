use serde::Serialize;

use crate::account::place_test::PlaceTest;
use crate::result::EffectAt;

/// What became of one effect at one place.
#[derive(Debug, Clone, PartialEq, Serialize)]
pub struct PlaceAccount {
    /// The effect and its place.
    #[serde(flatten)]
    pub at: EffectAt,
    /// Whether and how it was looked for.
    pub looked_for: LookedFor,
    /// What the search made of it.
    pub fate: SearchFate,
    /// The tests of the search beside all other true names, with the noise that these leave, or what was found where
    /// that leaves less.
    pub beside_truth: Option<PlaceTest>,
    /// The same with the noise of the efforts that is known from its sources.
    pub with_known_noise: Option<PlaceTest>,
    /// The tests of the search beside what it found.
    pub beside_found: Option<PlaceTest>,
    /// Found names in its place.
    pub takers: Vec<Taker>,
}

/// Whether and how a diagnosis looks for an effect at a place.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum LookedFor {
    /// By its columns in the regression.
    ByColumns,
    /// As a line of the spectrum or as a limit.
    AsLine,
    /// Nowhere, for this reason.
    Nowhere(String),
}

/// What the search over all blocks made of a hypothesis.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum SearchFate {
    /// It is no part of what was found.
    NotFound,
    /// It was found, and its size would have to vary with this signal.
    SizeVaries(String),
    /// It was found, and dropped since: its size is not determined, or a twin or plainer names do its work.
    Dropped,
    /// It was found and kept.
    Kept,
}

/// A found name in the place of another: one that excludes it, or one that is not true and without which the other has
/// enough evidence.
#[derive(Debug, Clone, PartialEq, Eq, Serialize)]
pub struct Taker {
    /// The found name.
    #[serde(flatten)]
    pub at: EffectAt,
    /// Whether the two change the same numbers, so that one model cannot have both.
    pub excludes: bool,
    /// Whether an exchange of the search tries the true name in its place.
    pub is_exchanged: bool,
}
