use std::ops::Range;

use effects::Hypothesis;
use nalgebra::{DMatrix, DVector};

/// What other logs of the same arm say of the weights `v` that both have in common, about the same robot: the normal
/// equations of their fit, each sum over their samples with the weights of their noise,
///
/// ```text
/// h = sum X' X,  g = sum X' y,  yy = sum y' y,  scores = sum over blocks s_b s_b',  s_b = X_b' (y_b - X_b v)
/// ```
#[derive(Debug, Clone)]
pub(crate) struct Common {
    /// The hypotheses with the indices of their weights.
    pub groups: Vec<(Hypothesis, Vec<usize>)>,
    /// Standard deviation of each weight before any data.
    pub prior: Vec<f64>,
    pub h: DMatrix<f64>,
    pub g: DVector<f64>,
    pub yy: f64,
    pub scores: DMatrix<f64>,
}

/// The part of a design that is common to its logs and to others. Its columns are those of hypotheses once more, with
/// weights of their own, which every model has:
///
/// ```text
/// logs of the design  y = X w + X v + noise
/// other logs          y = X v + noise
/// ```
///
/// The weights `w` of the hypotheses are then changes from the other logs to those of the design.
#[derive(Debug, Clone)]
pub(crate) struct CommonPart {
    /// The columns in the design.
    pub columns: Range<usize>,
    /// What the other logs say of their weights.
    pub of_others: Common,
}

impl Common {
    /// Adds the weights of a hypothesis of which the logs say nothing, with their prior.
    pub fn add_unknown(&mut self, hypothesis: Hypothesis, prior: &[f64]) {
        let (from, added) = (self.prior.len(), prior.len());
        self.prior.extend(prior);
        let all = from + added;
        self.h.resize_mut(all, all, 0.0);
        self.scores.resize_mut(all, all, 0.0);
        self.g.resize_vertically_mut(all, 0.0);
        self.groups.push((hypothesis, (from..all).collect()));
    }
}

#[cfg(test)]
mod tests {
    use catalogue::EffectKind;
    use effects::Place;

    use super::*;

    /// A weight that the other logs do not have is unknown: its information is zero, the others keep theirs.
    #[test]
    fn nothing_is_known_of_a_hypothesis_that_the_other_logs_do_not_have() {
        let hypothesis = |place| Hypothesis { kind: EffectKind::TorqueOffset, place };
        let mut common = Common {
            groups: vec![(hypothesis(Place::Joint(0)), vec![0])],
            prior: vec![2.0],
            h: DMatrix::from_element(1, 1, 9.0),
            g: DVector::from_element(1, 3.0),
            yy: 1.0,
            scores: DMatrix::from_element(1, 1, 4.0),
        };
        common.add_unknown(hypothesis(Place::Joint(1)), &[5.0]);
        assert_eq!(common.groups[1].1, [1]);
        assert_eq!(common.prior, [2.0, 5.0]);
        assert_eq!(common.h, DMatrix::from_diagonal(&DVector::from_vec(vec![9.0, 0.0])));
        assert_eq!(common.g, DVector::from_vec(vec![3.0, 0.0]));
        assert_eq!(common.scores, DMatrix::from_diagonal(&DVector::from_vec(vec![4.0, 0.0])));
    }
}
