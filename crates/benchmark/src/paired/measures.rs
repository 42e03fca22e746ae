use std::fmt;

use serde::Serialize;

use crate::panel::judgement::Judgement;
use crate::statistics::rate::Fraction;
use crate::trials::record::Record;

/// Yes-or-no measures of a trial.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum Measure {
    /// Every visible cause or a rival of it is named, and nothing false is. A trial without an answer is not right.
    Right,
    /// The verdict is "consistent" or "explained" although the trial hides a cause that is not named.
    FalseAssurance,
    /// Something is named or left open in a trial that hides nothing.
    FalseAlarm,
    /// The findings make the torque prediction worse by more than 1 %.
    #[serde(rename = "worse")]
    WorsePrediction,
    /// The extended robot predicts the torque worse than plain least squares by more than 2 %.
    WorseThanByHand,
    /// A finding about a link is off in mass or centre of mass by more than its interval.
    BodyOff,
    /// A reason contradicts the answer.
    Contradicting,
    /// Spoilt logs are taken for what they are not.
    Misled,
}

/// Numeric measures of a trial.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum TrialQuantity {
    /// True findings over all findings.
    Precision,
    /// Visible causes that are named, over all visible causes.
    Recall,
    /// Visible causes that are ruled out with a reason, over all visible causes.
    RuledOut,
    /// Findings of which the logs determine a size, over all findings.
    SizesTold,
    /// Held-out torque error with the findings over the error without, clipped to 0.001 to 1000.
    ErrorRatio,
    /// The same over the error of plain least squares.
    ByHandRatio,
    /// Time of the diagnosis (s).
    Time,
}

impl Measure {
    /// All measures.
    pub const ALL: [Self; 8] = [
        Self::Right,
        Self::FalseAssurance,
        Self::FalseAlarm,
        Self::WorsePrediction,
        Self::WorseThanByHand,
        Self::BodyOff,
        Self::Contradicting,
        Self::Misled,
    ];

    /// Whether yes is the better answer.
    pub fn is_yes_better(self) -> bool {
        self == Self::Right
    }

    /// The answer for a trial; `None` where the measure does not apply.
    pub(super) fn of(self, record: &Record) -> Option<bool> {
        match &record.score {
            Err(_) => (self == Self::Right).then_some(false),
            Ok(one) => self.of_judgement(one),
        }
    }

    fn of_judgement(self, one: &Judgement) -> Option<bool> {
        let some = |fraction: Fraction| (fraction.items > 0).then_some(fraction.hits > 0.0);
        match self {
            Self::Right => one.right(),
            Self::FalseAssurance => one.false_assurance(),
            Self::FalseAlarm => one.false_alarm(),
            Self::WorsePrediction => one.fair_prediction()?.worse(),
            Self::WorseThanByHand => one.fair_prediction()?.worse_than_by_hand(),
            Self::BodyOff => some(one.bodies_off()),
            Self::Contradicting => some(one.contradicting()),
            Self::Misled => one.is_misled(),
        }
    }
}

impl TrialQuantity {
    /// All quantities.
    pub const ALL: [Self; 7] = [
        Self::Precision,
        Self::Recall,
        Self::RuledOut,
        Self::SizesTold,
        Self::ErrorRatio,
        Self::ByHandRatio,
        Self::Time,
    ];

    /// Whether it is compared by its logarithm and reported as a factor.
    pub fn is_factor(self) -> bool {
        matches!(self, Self::ErrorRatio | Self::ByHandRatio | Self::Time)
    }

    /// The number for a trial, or its logarithm; `None` where the trial has none.
    pub(super) fn of(self, record: &Record) -> Option<f64> {
        let number = self.of_judgement(record.judgement()?)?;
        match self {
            Self::ErrorRatio | Self::ByHandRatio => Some(number.clamp(1e-3, 1e3).ln()),
            Self::Time => (number > 0.0).then(|| number.ln()),
            Self::Precision | Self::Recall | Self::RuledOut | Self::SizesTold => Some(number),
        }
    }

    fn of_judgement(self, one: &Judgement) -> Option<f64> {
        match self {
            Self::Precision => one.precision()?.value(),
            Self::Recall => one.recall().value(),
            Self::RuledOut => one.ruled_out().value(),
            Self::SizesTold => one.sizes_told().value(),
            Self::ErrorRatio => {
                let prediction = one.fair_prediction()?;
                prediction.ratio(prediction.extended.as_ref())
            }
            Self::ByHandRatio => one.fair_prediction()?.by_hand_ratio(),
            Self::Time => Some(one.costs.diagnosis_s),
        }
    }
}

impl fmt::Display for Measure {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Right => "right",
            Self::FalseAssurance => "false assurance",
            Self::FalseAlarm => "false alarm",
            Self::WorsePrediction => "worse prediction",
            Self::WorseThanByHand => "worse than by hand",
            Self::BodyOff => "a body off",
            Self::Contradicting => "contradicting reason",
            Self::Misled => "misled by spoilt logs",
        })
    }
}

impl fmt::Display for TrialQuantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Precision => "precision",
            Self::Recall => "recall",
            Self::RuledOut => "true, ruled out",
            Self::SizesTold => "sizes told",
            Self::ErrorRatio => "error of torque",
            Self::ByHandRatio => "error over by hand",
            Self::Time => "time",
        })
    }
}
