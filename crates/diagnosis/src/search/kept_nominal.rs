use std::collections::BTreeMap;

use crate::columns::design::Design;
use crate::regression::problem::{HypothesisSet, Problem};
use crate::result::InverseGain;
use crate::search::refusal::Refusal;

/// Joints that keep their description because a fit predicts their held-out efforts worse.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct KeptNominal {
    /// Indices of the joints, each with the held-out errors of the description and of the fit (RMS, N·m or N).
    pub joints: BTreeMap<usize, [f64; 2]>,
    /// Causes of the search over all blocks that are removed for this reason.
    pub dropped: HypothesisSet,
}

impl KeptNominal {
    /// Why hypothesis `g` is refused, where it acts on these joints alone.
    pub fn refusal(&self, design: &Design, g: usize) -> Option<Refusal> {
        let errors = design.groups[g].joints.iter().map(|j| Some((*j, *self.joints.get(j)?)));
        let all: Vec<(usize, [f64; 2])> = errors.collect::<Option<_>>()?;
        let &(at, [described, fitted]) = all.first()?;
        Some(Refusal::KeepsDescription { at, described, fitted })
    }

    /// A model without the hypotheses that act on these joints alone.
    pub fn remaining(&self, problem: &Problem, model: &HypothesisSet) -> HypothesisSet {
        let is_kept = |g: &usize| self.refusal(problem.design, *g).is_none();
        model.iter().copied().filter(is_kept).collect()
    }

    /// Whether a cause at joint `j` was removed.
    pub fn has_dropped_at(&self, design: &Design, j: usize) -> bool {
        self.dropped.iter().any(|g| design.groups[*g].joints.contains(&j))
    }

    /// The same with all other joints added that a fit predicts worse than the description; `None` if there are none.
    pub fn with_worse_joints(&self, gain: &InverseGain) -> Option<Self> {
        let more = joints_predicted_worse(gain).filter(|j| !self.joints.contains_key(j));
        let errors = |j: usize| (j, [gain.rms_before_nm[j], gain.rms_after_nm[j]]);
        let mut all = self.clone();
        all.joints.extend(more.map(errors));
        (all.joints.len() > self.joints.len()).then_some(all)
    }
}

/// Joints whose held-out error is larger than that of the description.
pub(crate) fn joints_predicted_worse(gain: &InverseGain) -> impl Iterator<Item = usize> {
    let pairs = gain.rms_before_nm.iter().zip(&gain.rms_after_nm).enumerate();
    pairs.filter(|(_, (before, after))| after > before).map(|(j, _)| j)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn gain(before: &[f64], after: &[f64]) -> InverseGain {
        InverseGain {
            nmse_before: Vec::new(),
            nmse_after: Vec::new(),
            rms_before_nm: before.to_vec(),
            rms_after_nm: after.to_vec(),
            held_out: String::new(),
            folds: Vec::new(),
        }
    }

    #[test]
    fn a_joint_that_is_predicted_worse_fails_once() {
        let none = KeptNominal::default();
        let kept_nominal =
            none.with_worse_joints(&gain(&[1.0, 1.0, 0.0], &[0.5, 1.001, 0.0])).unwrap();
        assert_eq!(kept_nominal.joints, BTreeMap::from([(1, [1.0, 1.001])]));
        assert_eq!(kept_nominal.with_worse_joints(&gain(&[1.0, 1.0], &[0.5, 1.001])), None);
    }
}
