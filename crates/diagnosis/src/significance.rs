use rayon::prelude::*;

use crate::flip_test::{p_value, q_values};
use crate::problem::{Model, Problem};
use crate::settings::Settings;
use crate::stability::stability;

/// Least share of half-samples in which a finding must have evidence (Meinshausen &
/// Buhlmann 2010 advise 0.6 to 0.9).
const LEAST_STABILITY: f64 = 0.9;

/// The false-discovery rate of every hypothesis, none for those that cannot be tested
/// because the model already has their columns.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Significance {
    pub p: Vec<Option<f64>>,
    pub q: Vec<Option<f64>>,
}

impl Significance {
    /// Tests every hypothesis against the others of the model.
    pub fn new(problem: &Problem, model: &Model, settings: &Settings) -> Self {
        let p: Vec<Option<f64>> = (0..problem.design.groups.len())
            .into_par_iter()
            .map(|g| p_value(problem, model, g, settings.sign_flips, settings.seed))
            .collect();
        let tested: Vec<usize> = (0..p.len()).filter(|&g| p[g].is_some()).collect();
        let values = q_values(&tested.iter().filter_map(|&g| p[g]).collect::<Vec<_>>());
        let mut q = vec![None; p.len()];
        tested.iter().zip(values).for_each(|(&g, v)| q[g] = Some(v));
        Self { p, q }
    }

    /// Number of hypotheses tested.
    pub fn count(&self) -> usize {
        self.p.iter().flatten().count()
    }
}

/// What tests of a model come to.
pub(crate) enum Tested {
    /// All of it is significant and stable.
    Stands(Significance),
    /// All of it is significant, and this hypothesis is the least stable one.
    Falls(usize),
}

/// Drops hypotheses one at a time, the least significant first, until all that are left are
/// significant; and says whether they are stable.
pub(crate) fn tested(problem: &Problem, mut model: Model, settings: &Settings) -> (Model, Tested) {
    loop {
        let significance = Significance::new(problem, &model, settings);
        let q = |g: &usize| significance.q[*g].unwrap_or(1.0);
        let worst = model.iter().copied().max_by(|a, b| q(a).total_cmp(&q(b)));
        if let Some(g) = worst.filter(|g| q(g) > settings.false_discovery_rate) {
            model.remove(&g);
            continue;
        }
        let stable = stability(problem, &model, settings.seed);
        let least = stable.into_iter().min_by(|a, b| a.1.total_cmp(&b.1));
        match least.filter(|(_, share)| *share < LEAST_STABILITY) {
            Some((g, _)) => return (model, Tested::Falls(g)),
            None => return (model, Tested::Stands(significance)),
        }
    }
}
