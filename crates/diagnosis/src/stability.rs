use rand::SeedableRng;
use rand::seq::SliceRandom;
use rand_chacha::ChaCha8Rng;

use crate::fit::Fit;
use crate::problem::{Model, Problem};

/// Number of complementary pairs of half-samples.
const PAIRS: usize = 25;

/// Share of half-samples of the independent stretches in which each hypothesis of the model still has
/// evidence, given the others.
///
/// # Source
///
/// Complementary pairs after Shah & Samworth 2013.
pub(crate) fn stability(problem: &Problem, model: &Model, seed: u64) -> Vec<(usize, f64)> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let mut kept: Vec<(usize, usize)> = model.iter().map(|&g| (g, 0)).collect();
    for _ in 0..PAIRS {
        let mut groups = problem.independent();
        groups.shuffle(&mut rng);
        let (first, second) = groups.split_at(groups.len() / 2);
        for half in [first, second] {
            let info = problem.grams.information(&half.concat(), &problem.weight);
            let evidence = |m: &Model| {
                Fit::new(&info, problem.columns(m), problem.design.beliefs()).map(|f| f.evidence)
            };
            let full = evidence(model);
            for (g, count) in &mut kept {
                let mut without = model.clone();
                without.remove(g);
                *count += usize::from(full > evidence(&without));
            }
        }
    }
    kept.into_iter().map(|(g, count)| (g, count as f64 / (2 * PAIRS) as f64)).collect()
}
