use crate::regression::problem::HypothesisSet;

/// What a change of a model is for; each kind is held to its own rules.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum ChangeKind {
    /// Hypotheses enter beside those of the model.
    Enter,
    /// A hypothesis is replaced by another that makes the logs more likely.
    Exchange,
    /// A hypothesis is replaced by simpler ones that make the logs about as likely.
    Simplify,
    /// A hypothesis leaves.
    Leave,
}

/// A change of a model: hypotheses that leave, then hypotheses that enter.
///
/// What enters is in the order in which it is asked. Hypotheses that an entrant excludes leave too
/// ([`Selection::apply`](crate::search::select::Selection::apply)).
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Change {
    pub kind: ChangeKind,
    pub leave: HypothesisSet,
    pub enter: Vec<usize>,
    /// Deviance of the model before and after on each independent group of blocks, where both were fitted about the
    /// robots that have their findings.
    pub deviances: Option<[Vec<f64>; 2]>,
}

impl Change {
    /// One hypothesis, or several that predict better together, enter.
    pub fn enter(hypotheses: &[usize]) -> Self {
        Self::new(ChangeKind::Enter, &[], hypotheses)
    }

    /// `g` is exchanged for `h`.
    pub fn exchange(g: usize, h: usize) -> Self {
        Self::new(ChangeKind::Exchange, &[g], &[h])
    }

    /// `g` is exchanged for its twin `h`, with the deviances of both models.
    pub fn twin(g: usize, h: usize, deviances: [Vec<f64>; 2]) -> Self {
        Self { deviances: Some(deviances), ..Self::exchange(g, h) }
    }

    /// Simpler hypotheses take the place of those of `leave`.
    pub fn simplify(leave: &[usize], enter: &[usize]) -> Self {
        Self::new(ChangeKind::Simplify, leave, enter)
    }

    /// `g` leaves.
    pub fn leave(g: usize) -> Self {
        Self::new(ChangeKind::Leave, &[g], &[])
    }

    fn new(kind: ChangeKind, leave: &[usize], enter: &[usize]) -> Self {
        let leave = leave.iter().copied().collect();
        Self { kind, leave, enter: enter.to_vec(), deviances: None }
    }

    /// A model without the hypotheses that leave.
    pub fn rest(&self, model: &HypothesisSet) -> HypothesisSet {
        model.difference(&self.leave).copied().collect()
    }
}
