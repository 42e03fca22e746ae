use nalgebra::Cholesky;
use serde::{Deserialize, Serialize};

use crate::regression::problem::{HeldOutResiduals, HypothesisSet};
use crate::search::model_state::ModelState;
use crate::search::select::Selection;

/// What the tests of the search say of one hypothesis beside a model.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct PlaceTest {
    /// Gain in log evidence (nats); zero where the model has all its columns already.
    pub evidence: f64,
    /// The gain that the search asks for (nats).
    pub least_evidence: f64,
    /// Its size over the deviation of its estimate:
    ///
    /// ```text
    /// sigmas^2 = u' B^-1 u
    /// ```
    ///
    /// with `u` and `B` its score and its information beyond the model.
    pub sigmas: f64,
    /// Whether its best size is physically possible.
    pub is_possible: bool,
    /// Whether it lowers the error of held-out blocks by enough.
    pub pays: bool,
    /// Largest fall of the held-out RMS error at one of its joints, in units of the least that counts there.
    pub fall: f64,
}

impl PlaceTest {
    /// Whether its evidence suffices.
    pub fn is_evident(&self) -> bool {
        self.evidence >= self.least_evidence
    }

    /// Whether it passes every test.
    pub fn passes(&self) -> bool {
        self.is_evident() && self.is_possible && self.pays
    }

    /// The tests of hypothesis `g` beside a model, without `g` and without what `g` excludes.
    pub(crate) fn new(selection: &Selection, model: &HypothesisSet, g: usize) -> Option<Self> {
        let problem = selection.problem;
        let larger = selection.with(model, g);
        let mut bare = larger.clone();
        bare.remove(&g);
        let fit = problem.fit(&bare)?;
        let columns = problem.new_columns(&bare, g);
        let least_evidence = selection.least_evidence(g);
        if columns.is_empty() {
            let none = (0.0, 0.0, false, false, 0.0);
            let (evidence, sigmas, is_possible, pays, fall) = none;
            return Some(Self { evidence, least_evidence, sigmas, is_possible, pays, fall });
        }
        let (complement, u) = fit.beyond(&problem.info, &columns, &problem.design.prior);
        let square = Cholesky::new(complement.b).map_or(0.0, |b| u.dot(&b.solve(&u)));
        let before = problem.hold_out(&bare);
        let after = ModelState::new(problem, larger)?;
        Some(Self {
            evidence: finite(selection.evidence_gain(&bare, &fit, g)),
            least_evidence,
            sigmas: finite(square.max(0.0).sqrt()),
            is_possible: selection.is_possible(&after, g).is_ok(),
            pays: selection.pays(&before, &after, g).is_ok(),
            fall: finite(largest_fall(selection, [&before, after.held_out()], g)),
        })
    }
}

/// See [`PlaceTest::fall`].
fn largest_fall(selection: &Selection, [before, after]: [&HeldOutResiduals; 2], g: usize) -> f64 {
    let joints = &selection.problem.design.groups[g].joints;
    let fall = |&j: &usize| {
        let square = (before.mean_square[j] - after.mean_square[j]).max(0.0);
        square.sqrt() / selection.practical[j].max(f64::MIN_POSITIVE)
    };
    joints.iter().map(fall).fold(0.0, f64::max)
}

/// A number that JSON can hold.
fn finite(number: f64) -> f64 {
    if number.is_nan() { 0.0 } else { number.clamp(f64::MIN, f64::MAX) }
}
