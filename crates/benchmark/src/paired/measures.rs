use std::fmt;

use diagnosis::Verdict;
use experiment::Score;
use serde::Serialize;

use crate::panel::judgement::Judgement;
use crate::trials::record::Record;
use crate::trials::scored::Scored;

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
}

/// Numeric measures of a trial.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize)]
#[serde(rename_all = "snake_case")]
pub enum TrialQuantity {
    /// True findings over all findings.
    Precision,
    /// Visible causes that are named, over all visible causes.
    Recall,
    /// Held-out torque error with the findings over the error without, clipped to 0.001 to 1000.
    ErrorRatio,
    /// Time of the diagnosis (s).
    Time,
}

impl Measure {
    /// All measures.
    pub const ALL: [Self; 4] =
        [Self::Right, Self::FalseAssurance, Self::FalseAlarm, Self::WorsePrediction];

    /// Whether yes is the better answer.
    pub fn is_yes_better(self) -> bool {
        self == Self::Right
    }

    /// The answer for a trial; `None` where the measure does not apply.
    pub(super) fn of(self, record: &Record) -> Option<bool> {
        match (&record.score, self) {
            (Err(_), Self::Right) => Some(false),
            (Err(_), _) => None,
            (Ok(Scored::Panel(one)), _) => self.of_panel(one),
            (Ok(Scored::Scenario(one)), _) => self.of_scenario(one),
        }
    }

    fn of_panel(self, one: &Judgement) -> Option<bool> {
        match self {
            Self::Right => one.right(),
            Self::FalseAssurance => one.false_assurance(),
            Self::FalseAlarm => one.false_alarm(),
            Self::WorsePrediction => one.prediction.worse(),
        }
    }

    /// The injected effects of a scenario count as visible, those that are not looked for as effects of no catalogue.
    fn of_scenario(self, one: &Score) -> Option<bool> {
        let hides = !one.injected.is_empty();
        let named = one.looked_for && one.is_found();
        match self {
            Self::Right => Some(one.stray.is_empty() && (named || !one.looked_for)),
            Self::FalseAssurance => hides.then_some(match one.verdict {
                Verdict::Consistent => true,
                Verdict::Explained => !named,
                _ => false,
            }),
            Self::FalseAlarm => (!hides).then(|| {
                let open = matches!(one.verdict, Verdict::Unexplained | Verdict::PartlyExplained);
                open || !one.stray.is_empty()
            }),
            Self::WorsePrediction => {
                let gain = one.gains.as_ref()?.torque?;
                Some(gain.after > 1.01 * gain.before)
            }
        }
    }
}

impl TrialQuantity {
    /// All quantities.
    pub const ALL: [Self; 4] = [Self::Precision, Self::Recall, Self::ErrorRatio, Self::Time];

    /// Whether it is compared by its logarithm and reported as a factor.
    pub fn is_factor(self) -> bool {
        matches!(self, Self::ErrorRatio | Self::Time)
    }

    /// The number for a trial, or its logarithm; `None` where the trial has none.
    pub(super) fn of(self, record: &Record) -> Option<f64> {
        let number = match record.score.as_ref().ok()? {
            Scored::Panel(one) => self.of_panel(one)?,
            Scored::Scenario(one) => self.of_scenario(one)?,
        };
        match self {
            Self::ErrorRatio => Some(number.clamp(1e-3, 1e3).ln()),
            Self::Time => (number > 0.0).then(|| number.ln()),
            Self::Precision | Self::Recall => Some(number),
        }
    }

    fn of_panel(self, one: &Judgement) -> Option<f64> {
        match self {
            Self::Precision => one.precision()?.value(),
            Self::Recall => one.recall().value(),
            Self::ErrorRatio => one.prediction.ratio(one.prediction.extended.as_ref()),
            Self::Time => Some(one.costs.diagnosis_s),
        }
    }

    fn of_scenario(self, one: &Score) -> Option<f64> {
        let part = |hits: usize, of: usize| (of > 0).then(|| hits as f64 / of as f64);
        match self {
            Self::Precision => part(
                one.findings.len() - one.stray.len().min(one.findings.len()),
                one.findings.len(),
            ),
            Self::Recall if !one.looked_for => None,
            Self::Recall => {
                part(one.injected.iter().filter(|p| p.one_of.is_some()).count(), one.injected.len())
            }
            Self::ErrorRatio => {
                let gain = one.gains.as_ref()?.torque?;
                (gain.before > 0.0).then(|| gain.after / gain.before).filter(|r| !r.is_nan())
            }
            Self::Time => None,
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
        })
    }
}

impl fmt::Display for TrialQuantity {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.pad(match self {
            Self::Precision => "precision",
            Self::Recall => "recall",
            Self::ErrorRatio => "error of torque",
            Self::Time => "time",
        })
    }
}
