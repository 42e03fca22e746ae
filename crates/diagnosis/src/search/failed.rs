use std::collections::BTreeSet;

use crate::columns::design::Design;
use crate::regression::problem::{Model, Problem};
use crate::result::InverseGain;

/// What was fitted and predicts efforts that took no part worse than the description does.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct Failed {
    /// Joints that keep their description.
    pub joints: BTreeSet<usize>,
    /// What had a name over the whole record.
    pub dropped: Model,
}

impl Failed {
    /// Whether hypothesis `g` is left out.
    pub fn drops(&self, design: &Design, g: usize) -> bool {
        let keep_theirs = |j: &usize| self.joints.contains(j);
        design.groups[g].joints.iter().all(keep_theirs)
    }

    /// What is left of a model.
    pub fn kept(&self, problem: &Problem, model: &Model) -> Model {
        model.iter().copied().filter(|g| !self.drops(problem.design, *g)).collect()
    }

    /// Whether anything that had a name at joint `j` is left out.
    pub fn is_told_at(&self, design: &Design, j: usize) -> bool {
        self.dropped.iter().any(|g| design.groups[*g].joints.contains(&j))
    }

    /// The same with every other joint that a fit predicts worse than the description; none where
    /// there is no such joint.
    pub fn with_worse_joints(&self, gain: &InverseGain) -> Option<Self> {
        let worse = worse(gain).filter(|j| !self.joints.contains(j));
        let mut failed = self.clone();
        failed.joints.extend(worse);
        (failed != *self).then_some(failed)
    }
}

/// Joints whose held-out error is larger than that of the description.
pub(crate) fn worse(gain: &InverseGain) -> impl Iterator<Item = usize> {
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
        let none = Failed::default();
        let failed = none.with_worse_joints(&gain(&[1.0, 1.0, 0.0], &[0.5, 1.001, 0.0])).unwrap();
        assert_eq!(failed.joints, BTreeSet::from([1]));
        assert_eq!(failed.with_worse_joints(&gain(&[1.0, 1.0], &[0.5, 1.001])), None);
    }
}
