use diagnosis::{EffectAt, Finding, Verdict};
use experiment::stored;
use population::{Corner, Knowledge, TrueStranger, TruthSheet};
use serde::{Deserialize, Serialize};

use crate::panel::answers::{Answers, Costs};
use crate::panel::judged_cause::{JudgedCause, finite};
use crate::panel::judged_finding::{BaselineClaim, JudgedFinding};
use crate::panel::place::place;
use crate::panel::prediction::Prediction;
use crate::statistics::rate::Fraction;

/// How well one trial of a population was answered.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Judgement {
    /// The seed of all random draws.
    pub seed: u64,
    /// Its corner of the population.
    pub corner: Corner,
    /// Whether all causes in the data are known.
    pub knowledge: Knowledge,
    /// The verdict over all joints.
    #[serde(deserialize_with = "stored::verdict")]
    pub verdict: Verdict,
    /// Why the diagnosis rejects the logs, if it does; it then names nothing.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub refused: Option<String>,
    /// The findings, the largest share of the gap first.
    pub findings: Vec<JudgedFinding>,
    /// The causes that are in the data.
    pub causes: Vec<JudgedCause>,
    /// Effects of no catalogue that are in the data.
    pub strangers: Vec<TrueStranger>,
    /// Effects that the two questions name.
    pub two_questions: Vec<BaselineClaim>,
    /// Effects that plain least squares names.
    pub least_squares: Vec<BaselineClaim>,
    /// Torque errors on a held-out log.
    pub prediction: Prediction,
    /// Times and memory.
    pub costs: Costs,
}

impl Judgement {
    /// Judges the answers to a trial by its truth.
    pub fn new(sheet: &TruthSheet, answers: &Answers) -> Self {
        let diagnosis = answers.diagnosis.as_ref();
        let mut findings: Vec<&Finding> =
            diagnosis.iter().flat_map(|diagnosis| &diagnosis.findings).collect();
        findings.sort_by(|a, b| b.share_explained.total_cmp(&a.share_explained));
        let causes: Vec<EffectAt> = sheet.causes.iter().map(place).collect();
        let two_questions = BaselineClaim::all(&answers.two_questions, &causes);
        let least_squares = BaselineClaim::all(&answers.least_squares, &causes);
        let claims = [&two_questions[..], &least_squares[..]];
        let judge = |cause| JudgedCause::new((cause, &sheet.causes), &findings, claims);
        let stranger = |other: &TrueStranger| TrueStranger {
            strength: finite(other.strength),
            ..other.clone()
        };
        Self {
            seed: sheet.seed,
            corner: sheet.corner.clone(),
            knowledge: sheet.knowledge,
            verdict: diagnosis.map_or(Verdict::DataInadequate, |diagnosis| diagnosis.verdict),
            refused: diagnosis.err().cloned(),
            causes: sheet.causes.iter().map(judge).collect(),
            findings: JudgedFinding::all(&findings, &causes),
            strangers: sheet.strangers.iter().map(stranger).collect(),
            prediction: Prediction::new(&answers.held_out, &sheet.torque_rms),
            costs: answers.costs,
            two_questions,
            least_squares,
        }
    }

    /// The causes that an oracle detects.
    pub fn visible(&self) -> impl Iterator<Item = &JudgedCause> {
        self.causes.iter().filter(|cause| cause.visible())
    }

    /// Whether the data contain something that an oracle detects.
    pub fn hides(&self) -> bool {
        self.visible().next().is_some() || self.hides_strangers()
    }

    /// Share of the findings that are true; `None` where the data have unknown causes.
    pub fn precision(&self) -> Option<Fraction> {
        self.of_findings(|_| 1.0)
    }

    /// The same, each finding weighted by its share of the gap's power.
    pub fn precision_by_torque(&self) -> Option<Fraction> {
        self.of_findings(JudgedFinding::weight)
    }

    /// Share of the visible causes that a finding or one of its rivals names.
    pub fn recall(&self) -> Fraction {
        Fraction::of(self.visible().map(|cause| (cause.is_named(), 1.0)))
    }

    /// The same, each cause weighted by its torque, at most that of its joints. A nominal friction that is a hundred
    /// times too large thus weighs as much as the whole effort.
    pub fn recall_by_torque(&self) -> Fraction {
        let weight = |cause: &JudgedCause| cause.strength.torque.min(1.0);
        Fraction::of(self.visible().map(|cause| (cause.is_named(), weight(cause))))
    }

    /// Share of a baseline's names that are true; `None` where the data have unknown causes.
    pub(crate) fn precision_of(&self, claims: &[BaselineClaim]) -> Option<Fraction> {
        self.is_all_known().then(|| Fraction::of(claims.iter().map(|claim| (claim.is_true, 1.0))))
    }

    /// Share of the visible causes that a baseline names.
    pub(crate) fn recall_of(&self, names: impl Fn(&JudgedCause) -> bool) -> Fraction {
        Fraction::of(self.visible().map(|cause| (names(cause), 1.0)))
    }

    /// Whether the verdict calls a visible gap closed: "consistent", or "explained" although a visible cause is not
    /// named or an effect outside the catalogue is visible. `None` where an oracle detects no cause.
    pub fn false_assurance(&self) -> Option<bool> {
        let misses = || self.visible().any(|cause| !cause.is_named()) || self.hides_strangers();
        self.hides().then(|| match self.verdict {
            Verdict::Consistent => true,
            Verdict::Explained => misses(),
            _ => false,
        })
    }

    /// Whether the diagnosis names a cause or leaves structure open in data without a cause. `None` where an oracle
    /// detects a cause, or where not all causes are known.
    pub fn false_alarm(&self) -> Option<bool> {
        let alarm = || self.names_falsely() || self.is_open();
        (self.is_all_known() && !self.hides()).then(alarm)
    }

    /// Whether every visible cause is named and, where all causes are known, no false one is. `None` for logs whose
    /// causes are unknown.
    pub fn right(&self) -> Option<bool> {
        let right = || self.visible().all(JudgedCause::is_named);
        match self.knowledge {
            Knowledge::Whole => Some(right() && !self.names_falsely()),
            Knowledge::Added => Some(right()),
            Knowledge::None => None,
        }
    }

    /// Whether the verdict leaves structure open.
    pub fn is_open(&self) -> bool {
        matches!(self.verdict, Verdict::Unexplained | Verdict::PartlyExplained)
    }

    /// Whether a finding is false, where all causes are known.
    pub fn names_falsely(&self) -> bool {
        self.is_all_known() && self.findings.iter().any(|finding| !finding.is_true)
    }

    /// Whether all causes in the data are known.
    pub fn is_all_known(&self) -> bool {
        self.knowledge == Knowledge::Whole
    }

    /// Number of samples of a joint over all logs.
    pub fn samples(&self) -> f64 {
        (self.corner.rate_hz * self.corner.length_s).round()
    }

    fn hides_strangers(&self) -> bool {
        self.strangers.iter().any(|stranger| stranger.strength.visible())
    }

    fn of_findings(&self, weight: impl Fn(&JudgedFinding) -> f64) -> Option<Fraction> {
        self.is_all_known()
            .then(|| Fraction::of(self.findings.iter().map(|f| (f.is_true, weight(f)))))
    }
}
