use std::fmt;

use serde::{Deserialize, Serialize};

/// A stage of the way from a log to a name, and from a name to its judgement.
///
/// A missed cause has the first stage that it does not pass; a false finding the first that would have kept it out,
/// had the search known the true names.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum LossStage {
    /// The judge: logs that are spoilt or refused, a cause below the real noise of the efforts, a cause inside another
    /// form of dry friction that is named; a false finding in spoilt logs or beside a visible stranger.
    Judge,
    /// No hypothesis: the joint does not move, or the logs have no column for it.
    NoHypothesis,
    /// A line of the spectrum above the band in which lines are looked for.
    OutsideTheBand,
    /// A line in that band which was not found; a false line.
    Line,
    /// Too little evidence beside all other true names, with the known noise of the efforts.
    KnownNoise,
    /// Evident with the known noise, but not with the noise that the true names leave; a false finding that passes
    /// every test beside the true names.
    TrueNames,
    /// Evident beside the true names, but not beside what was found; a false finding that is evident only there.
    FoundNames,
    /// It does not lower the held-out error by enough, or its joint keeps its description.
    HeldOut,
    /// Its best size is held physically impossible.
    Physical,
    /// A found name does its work, and no exchange tries it in that place.
    Exchange,
    /// Its size would have to vary.
    SizeVaries,
    /// Named as another: a found name that changes the same numbers, or explains more in an exchange; a false finding
    /// in the place of a missed cause.
    OtherName,
}

impl LossStage {
    /// All stages, in the order in which they are passed.
    pub const ALL: [Self; 12] = [
        Self::Judge,
        Self::NoHypothesis,
        Self::OutsideTheBand,
        Self::Line,
        Self::KnownNoise,
        Self::TrueNames,
        Self::FoundNames,
        Self::HeldOut,
        Self::Physical,
        Self::Exchange,
        Self::SizeVaries,
        Self::OtherName,
    ];

    /// A word for the head of a column.
    pub fn short(self) -> &'static str {
        match self {
            Self::Judge => "judge",
            Self::NoHypothesis => "no hyp.",
            Self::OutsideTheBand => "band",
            Self::Line => "line",
            Self::KnownNoise => "noise",
            Self::TrueNames => "truth",
            Self::FoundNames => "found",
            Self::HeldOut => "held out",
            Self::Physical => "physical",
            Self::Exchange => "exchange",
            Self::SizeVaries => "varies",
            Self::OtherName => "other",
        }
    }
}

impl fmt::Display for LossStage {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Judge => "judge",
            Self::NoHypothesis => "no hypothesis",
            Self::OutsideTheBand => "outside the band",
            Self::Line => "line of the spectrum",
            Self::KnownNoise => "evidence with the known noise",
            Self::TrueNames => "evidence beside the true names",
            Self::FoundNames => "evidence beside what was found",
            Self::HeldOut => "held-out gain",
            Self::Physical => "physical",
            Self::Exchange => "exchange",
            Self::SizeVaries => "size varies",
            Self::OtherName => "named as another",
        })
    }
}
