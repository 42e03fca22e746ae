use std::fmt;

use schemars::JsonSchema;
use serde::Serialize;

/// How a file represents a quantity.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
#[serde(rename_all = "snake_case", tag = "fate")]
pub enum Fate {
    /// Exactly.
    Exact {
        /// The element or attribute that holds it.
        place: String,
    },
    /// Approximately.
    Approximated {
        /// What is written, and its error.
        how: String,
    },
    /// Not at all.
    Dropped {
        /// Why, and what to do.
        because: String,
    },
}

impl Fate {
    /// Held by `place`.
    pub(crate) fn exact(place: &str) -> Self {
        Self::Exact { place: place.to_owned() }
    }

    /// Written as `how` says.
    pub(crate) fn near(how: impl Into<String>) -> Self {
        Self::Approximated { how: how.into() }
    }

    /// Left out.
    pub(crate) fn omit(because: &str) -> Self {
        Self::Dropped { because: because.to_owned() }
    }

    /// One word: `exact`, `approximated` or `dropped`.
    pub fn word(&self) -> &'static str {
        match self {
            Self::Exact { .. } => "exact",
            Self::Approximated { .. } => "approximated",
            Self::Dropped { .. } => "dropped",
        }
    }
}

impl fmt::Display for Fate {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Exact { place: text }
            | Self::Approximated { how: text }
            | Self::Dropped { because: text } => f.write_str(text),
        }
    }
}

/// A quantity of the robot and how the file represents it.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct QuantityFate {
    /// The joint, the link or `robot`.
    pub at: String,
    /// The quantity with its size and unit.
    pub what: String,
    /// How the file represents it.
    #[serde(flatten)]
    pub fate: Fate,
}
