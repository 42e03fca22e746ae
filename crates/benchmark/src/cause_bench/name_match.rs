use diagnosis::EffectAt;
use population::Knowledge;

use crate::panel::judgement::Judgement;
use crate::statistics::rate::Fraction;

/// The names of an answer beside the causes in the data, each name standing for one cause at most.
///
/// A name that is a cause stands for it. Each other one stands for the first of its rivals that is a cause without a
/// name, a visible one before others: a list of rivals thus wins one cause, however long it is.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub struct NameMatch {
    /// Number of names.
    pub names: usize,
    /// Names that stand for a cause.
    pub true_names: usize,
    /// Number of visible causes.
    pub visible: usize,
    /// Visible causes that are named, or Coulomb friction that another form of dry friction of its joint bears.
    pub named: usize,
}

impl NameMatch {
    /// Of a trial; nothing where its logs are spoilt, or nobody knows its causes.
    pub fn new(judgement: &Judgement) -> Self {
        if judgement.is_spoilt() || judgement.knowledge == Knowledge::None {
            return Self::default();
        }
        let (findings, causes) = (&judgement.findings, &judgement.causes);
        let is_cause = |at: &EffectAt| causes.iter().any(|cause| cause.at == *at);
        let mut is_named: Vec<bool> = causes.iter().map(|cause| cause.finding.is_some()).collect();
        let mut true_names = is_named.iter().filter(|named| **named).count();
        for finding in findings.iter().filter(|finding| !is_cause(&finding.at)) {
            let is_open =
                |k: &usize| !is_named[*k] && finding.not_separable_from.contains(&causes[*k].at);
            let open = (0..causes.len()).filter(is_open);
            if let Some(k) = open.max_by_key(|k| causes[*k].visible()) {
                is_named[k] = true;
                true_names += 1;
            }
        }
        let bears = |k: usize| {
            causes[k]
                .one_of
                .is_some_and(|at| !findings[at].not_separable_from.contains(&causes[k].at))
        };
        let visible: Vec<usize> = (0..causes.len()).filter(|k| causes[*k].visible()).collect();
        let named = visible.iter().filter(|k| is_named[**k] || bears(**k)).count();
        Self { names: findings.len(), true_names, visible: visible.len(), named }
    }

    /// The part of a trial in F1, as a ratio of sums over trials:
    ///
    /// ```text
    /// F1 = (true names + named visible causes) / (names + visible causes)
    /// ```
    ///
    /// which is `2 TP / (2 TP + FP + FN)` where every true name is a visible cause.
    pub fn f1(self) -> Fraction {
        let (hits, of) = (self.true_names + self.named, self.names + self.visible);
        Fraction { hits: hits as f64, of: of as f64, items: of }
    }
}
