use std::collections::BTreeSet;

use crate::columns::design::Design;
use crate::regression::problem::{Model, Problem};
use crate::result::InverseGain;
use crate::thresholds::RISE;

/// What was fitted and predicts efforts that took no part worse than the description does.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub(crate) struct Failed {
    /// Joints that keep their description.
    pub joints: BTreeSet<usize>,
    /// Effects of several joints that are left out.
    pub groups: Model,
    /// What had a name over the whole record.
    pub dropped: Model,
}

impl Failed {
    /// Whether hypothesis `g` is left out.
    pub fn drops(&self, design: &Design, g: usize) -> bool {
        let keep_theirs = |j: &usize| self.joints.contains(j);
        self.groups.contains(&g) || design.groups[g].joints.iter().all(keep_theirs)
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
        let worse = worse(gain, 1.0).filter(|j| !self.joints.contains(j));
        let mut failed = self.clone();
        failed.joints.extend(worse);
        (failed != *self).then_some(failed)
    }

    /// Effects of several joints of a model, each of which may be what predicts one of them worse.
    pub fn suspects(&self, design: &Design, model: &Model, gain: &InverseGain) -> Vec<usize> {
        let worse: Vec<usize> = worse(gain, RISE).collect();
        let reaches = |g: &usize| design.groups[*g].joints.iter().any(|j| worse.contains(j));
        model.iter().copied().filter(|g| !self.drops(design, *g) && reaches(g)).collect()
    }

    /// The same without hypothesis `g`.
    pub fn without(&self, g: usize) -> Self {
        let mut failed = self.clone();
        failed.groups.insert(g);
        failed
    }
}

/// Joints whose held-out error is over `rise` times that of the description.
fn worse(gain: &InverseGain, rise: f64) -> impl Iterator<Item = usize> {
    let pairs = gain.rms_before_nm.iter().zip(&gain.rms_after_nm).enumerate();
    pairs.filter(move |(_, (before, after))| **after > rise * **before).map(|(j, _)| j)
}

/// How much larger held-out errors are than those of the description, over all joints: the sum of the
/// logarithms of their ratios.
pub(crate) fn rise(gain: &InverseGain) -> f64 {
    let pairs = gain.rms_before_nm.iter().zip(&gain.rms_after_nm);
    pairs.filter(|(before, after)| **before > 0.0 && **after > 0.0).map(|(b, a)| (a / b).ln()).sum()
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

    #[test]
    fn the_rise_over_all_joints_is_none_where_one_halves_and_one_doubles() {
        assert!(rise(&gain(&[1.0, 3.0], &[2.0, 1.5])).abs() < 1e-12);
        assert!(rise(&gain(&[1.0, 3.0], &[2.0, 2.0])) > 0.0);
    }
}
