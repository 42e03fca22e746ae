use diagnosis::{EffectAt, Finding, Verdict};
use experiment::stored;
use population::{Corner, Knowledge, TrueStranger, TruthSheet};
use serde::{Deserialize, Serialize};

use crate::panel::answers::{Answers, Costs};
use crate::panel::judged_cause::{JudgedCause, finite};
use crate::panel::judged_finding::{BaselineClaim, JudgedFinding};
use crate::panel::judged_reasons::JudgedReasons;
use crate::panel::judged_spoiling::JudgedSpoiling;
use crate::panel::place::place;
use crate::panel::prediction::Prediction;
use crate::statistics::rate::Fraction;

/// How well one trial was answered.
///
/// Where the logs are spoilt so that an oracle sees it, a right answer says so: such a trial counts by
/// [`spoilings`](Self::spoilings) alone, and every other score of it is `None` or of nothing.
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
    /// Effects of no catalogue that are in the arm.
    pub strangers: Vec<TrueStranger>,
    /// What spoils the logs so that an oracle sees it.
    pub spoilings: Vec<JudgedSpoiling>,
    /// The reasons for which effects are ruled out.
    pub reasons: JudgedReasons,
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
        let mut found: Vec<&Finding> =
            diagnosis.iter().flat_map(|diagnosis| &diagnosis.findings).collect();
        found.sort_by(|a, b| b.share_explained.total_cmp(&a.share_explained));
        let causes: Vec<EffectAt> = sheet.causes.iter().map(place).collect();
        let least_squares = BaselineClaim::all(&answers.least_squares, &causes);
        let ruled_out = diagnosis.map_or(&[][..], |diagnosis| &diagnosis.ruled_out);
        let judge =
            |cause| JudgedCause::new((cause, &sheet.causes), &found, ruled_out, &least_squares);
        let findings = JudgedFinding::all(&found, &sheet.causes);
        let spoilings = JudgedSpoiling::all(&sheet.strangers, diagnosis, &findings);
        let strangers = sheet.strangers.iter().filter(|other| !JudgedSpoiling::is_one(other));
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
            findings,
            strangers: strangers.map(stranger).collect(),
            spoilings,
            reasons: diagnosis.map(JudgedReasons::new).unwrap_or_default(),
            prediction: Prediction::new(&answers.held_out, &sheet.torque_rms),
            costs: answers.costs,
            least_squares,
        }
    }

    /// The causes that an oracle detects.
    pub fn visible(&self) -> impl Iterator<Item = &JudgedCause> {
        self.causes.iter().filter(|cause| cause.visible())
    }

    /// The causes that a right answer names: the visible ones, and none in spoilt logs.
    pub fn causes_to_name(&self) -> impl Iterator<Item = &JudgedCause> {
        self.visible().filter(|_| !self.is_spoilt())
    }

    /// Whether the logs are spoilt so that an oracle sees it.
    pub fn is_spoilt(&self) -> bool {
        !self.spoilings.is_empty()
    }

    /// Whether the data contain something that an oracle detects.
    pub fn hides(&self) -> bool {
        self.visible().next().is_some() || self.hides_strangers()
    }

    /// Share of the findings that are true; `None` where the data have unknown causes or the logs are spoilt.
    pub fn precision(&self) -> Option<Fraction> {
        self.of_findings(|_| 1.0)
    }

    /// The same, each finding weighted by its share of the gap's power.
    pub fn precision_by_torque(&self) -> Option<Fraction> {
        self.of_findings(JudgedFinding::weight)
    }

    /// Share of the visible causes that a finding names: it is the cause, has it as a rival or bears it.
    pub fn recall(&self) -> Fraction {
        self.of_causes(JudgedCause::is_named)
    }

    /// The same, each cause weighted by its torque, at most that of its joints. A nominal friction that is a hundred
    /// times too large thus weighs as much as the whole effort.
    pub fn recall_by_torque(&self) -> Fraction {
        let weight = |cause: &JudgedCause| cause.strength.torque.min(1.0);
        Fraction::of(self.causes_to_name().map(|cause| (cause.is_named(), weight(cause))))
    }

    /// Share of the visible causes that the diagnosis rules out, with a reason that is then untrue.
    pub fn ruled_out(&self) -> Fraction {
        self.of_causes(|cause| !cause.is_named() && cause.ruled_out.is_some())
    }

    /// Share of the reasons that contradict the answer.
    pub fn contradicting(&self) -> Fraction {
        let wrong = self.reasons.contradicting.len();
        let (hits, of) = (wrong as f64, self.reasons.given as f64);
        Fraction { hits, of, items: self.reasons.given }
    }

    /// Share of the findings of which the logs determine a size.
    pub fn sizes_told(&self) -> Fraction {
        Fraction::of(self.unspoilt_findings().map(|f| (f.sharpness.is_some(), 1.0)))
    }

    /// Relative widths of the intervals of the findings of which the logs determine a size.
    pub fn sharpness(&self) -> impl Iterator<Item = f64> {
        self.unspoilt_findings().filter_map(|finding| finding.sharpness)
    }

    /// Share of the findings about links whose mass or centre of mass is off the truth by more than its interval, each
    /// weighted by its mass (kg); nothing where the data have unknown causes.
    pub fn bodies_off(&self) -> Fraction {
        let known = self.unspoilt_findings().filter(|_| self.is_all_known());
        let bodies = known.filter_map(|finding| finding.body);
        Fraction::of(bodies.map(|body| (!body.holds, body.weight())))
    }

    /// Share of the intervals of determined sizes that hold the truth, where a finding names a visible cause.
    pub fn coverage(&self) -> Fraction {
        let sizes = self.causes_to_name().flat_map(|cause| &cause.sizes);
        let estimates = sizes.filter_map(|size| size.estimate.as_ref());
        Fraction::of(estimates.filter(|e| e.determined).map(|e| (e.covers, 1.0)))
    }

    /// Share of the names of plain least squares that are true; `None` where the data have unknown causes or the logs
    /// are spoilt.
    pub(crate) fn precision_of_least_squares(&self) -> Option<Fraction> {
        let claims = || self.least_squares.iter().map(|claim| (claim.is_true, 1.0));
        self.is_precision_known().then(|| Fraction::of(claims()))
    }

    /// Share of the visible causes that it names.
    pub(crate) fn recall_of_least_squares(&self) -> Fraction {
        self.of_causes(|cause| cause.least_squares)
    }

    /// The torque errors, where they follow from logs that are not spoilt.
    pub fn fair_prediction(&self) -> Option<&Prediction> {
        (!self.is_spoilt()).then_some(&self.prediction)
    }

    /// Whether the verdict calls a visible gap closed: "consistent", or "explained" although a visible cause is not
    /// named or an effect outside the catalogue is visible. `None` where an oracle detects no cause, or where the logs
    /// are spoilt.
    pub fn false_assurance(&self) -> Option<bool> {
        let misses = || self.visible().any(|cause| !cause.is_named()) || self.hides_strangers();
        (self.hides() && !self.is_spoilt()).then(|| match self.verdict {
            Verdict::Consistent => true,
            Verdict::Explained => misses(),
            _ => false,
        })
    }

    /// Whether the diagnosis names a cause or leaves structure open in data without a cause. `None` where an oracle
    /// detects a cause, where not all causes are known, or where the logs are spoilt.
    pub fn false_alarm(&self) -> Option<bool> {
        let alarm = || self.names_falsely() || self.is_open();
        (self.is_precision_known() && !self.hides()).then(alarm)
    }

    /// Whether spoilt logs are taken for what they are not: another fault is told, or none and the logs are closed.
    /// `None` where they are not spoilt.
    pub fn is_misled(&self) -> Option<bool> {
        let misleads = |one: &JudgedSpoiling| !one.outcome.is_right();
        self.is_spoilt().then(|| self.spoilings.iter().any(misleads))
    }

    /// Whether every visible cause is named and, where all causes are known, no false one is; of spoilt logs, whether
    /// nobody is misled. `None` for logs whose causes are unknown.
    pub fn right(&self) -> Option<bool> {
        if let Some(misled) = self.is_misled() {
            return Some(!misled);
        }
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

    /// Whether it says that something is left, in refusing the logs too, and names nothing false.
    pub(crate) fn abstains(&self) -> bool {
        (self.is_open() || self.refused.is_some()) && !self.names_falsely()
    }

    /// Whether a finding is false, where all causes are known.
    pub fn names_falsely(&self) -> bool {
        self.is_all_known() && self.findings.iter().any(|finding| !finding.is_true)
    }

    /// Whether all causes in the data are known.
    pub fn is_all_known(&self) -> bool {
        self.knowledge == Knowledge::Whole
    }

    /// Whether names can be told true from false: all causes are known, and the logs are not spoilt.
    pub(crate) fn is_precision_known(&self) -> bool {
        self.is_all_known() && !self.is_spoilt()
    }

    /// Number of samples of a joint over all logs.
    pub fn samples(&self) -> f64 {
        (self.corner.rate_hz * self.corner.length_s).round()
    }

    /// The findings, none in spoilt logs.
    pub(crate) fn unspoilt_findings(&self) -> impl Iterator<Item = &JudgedFinding> {
        self.findings.iter().filter(|_| !self.is_spoilt())
    }

    pub(crate) fn hides_strangers(&self) -> bool {
        self.strangers.iter().any(|stranger| stranger.strength.visible())
    }

    fn of_causes(&self, is: impl Fn(&JudgedCause) -> bool) -> Fraction {
        Fraction::of(self.causes_to_name().map(|cause| (is(cause), 1.0)))
    }

    fn of_findings(&self, weight: impl Fn(&JudgedFinding) -> f64) -> Option<Fraction> {
        self.is_precision_known()
            .then(|| Fraction::of(self.findings.iter().map(|f| (f.is_true, weight(f)))))
    }
}
