use std::collections::BTreeMap;

use crate::regression::problem::HypothesisSet;
use crate::search::refusal::Refusal;

/// Every hypothesis that was refused for good, with the last reason.
#[derive(Debug, Clone, Default)]
pub(crate) struct Ledger {
    refused: BTreeMap<usize, Refusal>,
}

impl Ledger {
    /// Enters a refusal of `g`, in place of an earlier one.
    pub fn refuse(&mut self, g: usize, refusal: Refusal) {
        self.refused.insert(g, refusal);
    }

    /// The refusal of `g`.
    pub fn refusal(&self, g: usize) -> Option<&Refusal> {
        self.refused.get(&g)
    }

    /// All refused hypotheses.
    pub fn hypotheses(&self) -> impl Iterator<Item = usize> {
        self.refused.keys().copied()
    }

    /// Whether a hypothesis of a model was refused before, and may not enter again.
    pub fn refuses_any(&self, model: &HypothesisSet) -> bool {
        model.iter().any(|g| self.varies(*g))
    }

    /// Whether `g` left because its size would have to vary. It has no name then, but its torque is still there.
    pub fn varies(&self, g: usize) -> bool {
        matches!(self.refusal(g), Some(Refusal::Varies(_)))
    }

    /// All hypotheses whose sizes would have to vary.
    pub fn varying(&self) -> impl Iterator<Item = usize> {
        self.refused.keys().copied().filter(|g| self.varies(*g))
    }

    /// Whether `h` does worse than its twin `g`.
    pub fn is_worse_twin(&self, g: usize, h: usize) -> bool {
        matches!(self.refusal(h), Some(Refusal::WorseThanTwin { twin, .. }) if *twin == g)
    }

    /// Removes the refusals of twins of hypotheses outside a model.
    pub fn keep_twins_of(&mut self, model: &HypothesisSet) {
        self.refused.retain(|_, refusal| match refusal {
            Refusal::WorseThanTwin { twin, .. } => model.contains(twin),
            _ => true,
        });
    }
}
