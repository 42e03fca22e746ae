use std::collections::{BTreeMap, BTreeSet};
use std::sync::Arc;

use nalgebra::DVector;

use crate::columns::design::Design;
use crate::columns::run_design::JointDesign;
use crate::columns::stratum::Stratum;
use crate::regression::blocks::{Block, Fold, Folding, folds};
use crate::regression::fit::Fit;
use crate::regression::gram::{Grams, Information, JointGram};
use crate::regression::noise::Noise;
use crate::signals::response::Response;
use crate::thresholds::Thresholds;

/// A set of hypotheses, by the indices of their groups.
pub(crate) type HypothesisSet = BTreeSet<usize>;

/// The regression problem on a part of the logs, used by selection, tests and fits.
#[derive(Debug, Clone)]
pub(crate) struct Problem<'a> {
    pub design: &'a Design,
    pub blocks: &'a [Block],
    pub grams: &'a Grams,
    /// The blocks of this part.
    pub of: Vec<usize>,
    /// The folds that are held out in turn.
    pub folds: Vec<Fold>,
    sums: Arc<Sums>,
    /// Weight of the squared residuals, `[stratum]`.
    pub weight: Vec<f64>,
    pub thresholds: &'a Thresholds,
    /// Normal equations of all blocks.
    pub info: Information,
    /// Normal equations of each fold's training blocks.
    pub training: Vec<Information>,
}

/// Statistics of every stratum summed over blocks: all weightings of a problem share them.
#[derive(Debug)]
struct Sums {
    /// Over all blocks of the problem, `[stratum]`.
    all: Vec<JointGram>,
    /// Over the blocks that each fold is fitted to, `[fold][stratum]`.
    training: Vec<Vec<JointGram>>,
    /// Over the blocks that each fold holds out, `[fold][stratum]`.
    tests: Vec<Vec<JointGram>>,
}

impl Sums {
    fn new(grams: &Grams, of: &[usize], folds: &[Fold]) -> Self {
        Self {
            all: grams.sums(of),
            training: folds.iter().map(|fold| grams.sums(&fold.train)).collect(),
            tests: folds.iter().map(|fold| grams.sums(&fold.test)).collect(),
        }
    }
}

/// Squared held-out residuals of a model.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct HeldOutResiduals {
    /// Mean square at each joint.
    pub mean_square: Vec<f64>,
    /// The same of the samples in which the joint slides.
    pub mean_square_sliding: Vec<f64>,
    /// Weighted sum of squares of all joints.
    pub deviance: f64,
}

impl<'a> Problem<'a> {
    /// The problem on the blocks `of`, with the strata weighted by `weight`.
    pub fn new(
        design: &'a Design,
        blocks: &'a [Block],
        grams: &'a Grams,
        of: &[usize],
        weight: Vec<f64>,
        thresholds: &'a Thresholds,
    ) -> Self {
        let folds = folds(design, blocks, of, Folding::ByMotion, &thresholds.blocks);
        let sums = Arc::new(Sums::new(grams, of, &folds));
        let info = grams.weigh(&sums.all, &weight);
        let training = sums.training.iter().map(|sums| grams.weigh(sums, &weight)).collect();
        let of = of.to_vec();
        Self { design, blocks, grams, of, folds, sums, weight, thresholds, info, training }
    }

    /// The same blocks and weights in a design about another robot.
    pub fn about<'b>(&self, design: &'b Design, grams: &'b Grams) -> Problem<'b>
    where
        'a: 'b,
    {
        let weight = self.weight.clone();
        Problem::new(design, self.blocks, grams, &self.of, weight, self.thresholds)
    }

    /// The same problem with other weights.
    pub fn with_weights(&self, weight: Vec<f64>) -> Self {
        let weigh = |sums: &Vec<JointGram>| self.grams.weigh(sums, &weight);
        let info = weigh(&self.sums.all);
        let training = self.sums.training.iter().map(weigh).collect();
        let (of, folds, sums) = (self.of.clone(), self.folds.clone(), Arc::clone(&self.sums));
        let Self { design, blocks, grams, thresholds, .. } = *self;
        Self { design, blocks, grams, of, folds, sums, weight, thresholds, info, training }
    }

    /// The same problem with other folds.
    pub fn with_folding(&self, folding: Folding) -> Self {
        let t = &self.thresholds.blocks;
        let folds = folds(self.design, self.blocks, &self.of, folding, t);
        let sums = Arc::new(Sums::new(self.grams, &self.of, &folds));
        let weigh = |sums: &Vec<JointGram>| self.grams.weigh(sums, &self.weight);
        let training = sums.training.iter().map(weigh).collect();
        Self { folds, sums, training, ..self.clone() }
    }

    /// The blocks in independent groups. Where runs repeat a motion, their residuals repeat too, so that the same
    /// stretch of each run belongs to one group.
    pub fn independent(&self) -> Vec<Vec<usize>> {
        let mut groups: BTreeMap<(usize, usize), Vec<usize>> = BTreeMap::new();
        for &b in &self.of {
            let run = self.blocks[b].run;
            let place = self.blocks[..b].iter().filter(|other| other.run == run).count();
            groups.entry((self.design.motion[run], place)).or_default().push(b);
        }
        groups.into_values().collect()
    }

    /// The score of every independent group of blocks, `sum_j c_j X_j' (y_j - X_j w)`.
    pub fn scores(&self, weights: &[f64]) -> Vec<DVector<f64>> {
        let score = |b: &usize| self.grams.score(*b, &self.weight, weights);
        let sum = |group: &Vec<usize>| group.iter().map(score).sum();
        self.independent().iter().map(sum).collect()
    }

    /// The columns of a model, in increasing order.
    pub fn columns(&self, model: &HypothesisSet) -> Vec<usize> {
        self.design.columns(model)
    }

    /// The columns of `group` that `model` does not have.
    pub fn new_columns(&self, model: &HypothesisSet, group: usize) -> Vec<usize> {
        let have = self.columns(model);
        let of_group = &self.design.groups[group].columns;
        of_group.iter().copied().filter(|k| have.binary_search(k).is_err()).collect()
    }

    /// The fit of a model to all blocks.
    pub fn fit(&self, model: &HypothesisSet) -> Option<Fit> {
        Fit::new(&self.info, self.columns(model), self.design.weight_prior())
    }

    /// All weights of a model fitted to the training blocks of fold `fold`.
    pub fn fold_weights(&self, model: &HypothesisSet, fold: usize) -> Vec<f64> {
        let fit = Fit::new(&self.training[fold], self.columns(model), self.design.weight_prior());
        fit.map_or_else(|| vec![0.0; self.design.width], |f| f.expand(self.design.width))
    }

    /// Squared residuals of a model on held-out blocks.
    pub fn hold_out(&self, model: &HypothesisSet) -> HeldOutResiduals {
        let joints = self.design.joints();
        let mut sums = vec![(0.0, 0_usize); 2 * joints];
        let mut deviance = 0.0;
        for (f, test) in self.sums.tests.iter().enumerate() {
            let w = self.fold_weights(model, f);
            for ((s, gram), weight) in Stratum::all(joints).zip(test).zip(&self.weight) {
                let left = gram.remaining(&self.grams.local(s.joint(), &w));
                deviance += weight * left;
                let (sum, count) = &mut sums[s.index()];
                (*sum, *count) = (*sum + left, *count + gram.count);
            }
        }
        let mean = |sum: f64, count: usize| sum / count.max(1) as f64;
        let both = |of: &[(f64, usize)]| mean(of[0].0 + of[1].0, of[0].1 + of[1].1);
        HeldOutResiduals {
            mean_square: sums.chunks_exact(2).map(both).collect(),
            mean_square_sliding: sums.iter().step_by(2).map(|of| mean(of.0, of.1)).collect(),
            deviance,
        }
    }

    /// The weighted sum of squares of every block, from the fold that holds it out.
    pub fn hold_out_by_block(&self, model: &HypothesisSet) -> Vec<f64> {
        let mut deviance = vec![0.0; self.blocks.len()];
        for (f, fold) in self.folds.iter().enumerate() {
            let w = self.fold_weights(model, f);
            for &b in &fold.test {
                deviance[b] = self.grams.deviance(b, &self.weight, &w);
            }
        }
        deviance
    }

    /// A signal of run `run`, given once for every fold. Each block is taken from the fold that holds it out, or from
    /// the first fold if none does.
    pub fn join_folds(&self, run: usize, folds: &[&[f64]]) -> Vec<f64> {
        let of_run = self.blocks.iter().enumerate().filter(|(_, block)| block.run == run);
        let part = |(b, block): (usize, &Block)| {
            let fold = self.folds.iter().position(|f| f.test.contains(&b)).unwrap_or(0);
            folds.get(fold).map_or(&[][..], |of| &of[block.samples.clone()]).to_vec()
        };
        of_run.flat_map(part).collect()
    }

    /// Held-out residuals, `[joint][run][sample]`. `left` gives the residual of a fold, by its index, in a block at a
    /// joint. Runs outside this part of the logs are left out.
    pub fn held_out_residuals(
        &self,
        left: impl Fn(usize, &Block, usize) -> Vec<f64>,
    ) -> Vec<Vec<Vec<f64>>> {
        self.residuals(left, |_, _| true)
    }

    /// Held-out residuals, `[stratum][run][sample]`.
    fn residuals_by_stratum(
        &self,
        left: impl Fn(usize, &Block, usize) -> Vec<f64>,
    ) -> Vec<Vec<Vec<f64>>> {
        let [sliding, near_rest] = [true, false].map(|slides| {
            self.residuals(&left, move |joint, t| {
                joint.is_informative[t] && joint.slides[t] == slides
            })
        });
        sliding.into_iter().zip(near_rest).flat_map(|(a, b)| [a, b]).collect()
    }

    /// Held-out residuals of the samples that are `taken` of the signals of a joint.
    fn residuals(
        &self,
        left: impl Fn(usize, &Block, usize) -> Vec<f64>,
        taken: impl Fn(&JointDesign, usize) -> bool,
    ) -> Vec<Vec<Vec<f64>>> {
        let fold_of = |b: usize| self.folds.iter().position(|f| f.test.contains(&b));
        let mut residuals = vec![Vec::new(); self.design.joints()];
        for run in 0..self.design.runs.len() {
            let of_run = self.blocks.iter().enumerate().filter(|(_, block)| block.run == run);
            let own: Vec<(&Block, usize)> =
                of_run.filter_map(|(b, block)| Some((block, fold_of(b)?))).collect();
            if own.is_empty() {
                continue;
            }
            for (j, residual) in residuals.iter_mut().enumerate() {
                let signals = &self.design.runs[run].joints[j];
                let part = |(block, f): &(&Block, usize)| {
                    let left = left(*f, block, j).into_iter().zip(block.samples.clone());
                    left.filter(|(_, t)| taken(signals, *t))
                        .map(|(left, _)| left)
                        .collect::<Vec<_>>()
                };
                residual.push(own.iter().flat_map(part).collect());
            }
        }
        residuals
    }

    /// The noise that a model leaves on held-out blocks.
    pub fn noise(&self, model: &HypothesisSet) -> Noise {
        let weights: Vec<Vec<f64>> =
            (0..self.folds.len()).map(|fold| self.fold_weights(model, fold)).collect();
        let residual =
            |fold: usize, block: &Block, j| block.remaining(self.design, j, &weights[fold]);
        Noise::of(&self.residuals_by_stratum(residual), self.thresholds.signals.least_sliding)
    }

    /// The noise that a model leaves on the blocks it is fitted to.
    pub fn training_noise(&self, model: &HypothesisSet) -> Noise {
        let weights = self.fit(model).map(|f| f.expand(self.design.width)).unwrap_or_default();
        let residual = |_, block: &Block, j| block.remaining(self.design, j, &weights);
        Noise::of(&self.residuals_by_stratum(residual), self.thresholds.signals.least_sliding)
    }

    /// The model with every hypothesis at once. In a design of the efforts it leaves out effects that an error
    /// elsewhere may imitate.
    pub fn everything(&self) -> HypothesisSet {
        let groups = &self.design.groups;
        let is_distinct = |g: &usize| {
            self.design.response == Response::Twist || !groups[*g].hypothesis.is_imitable()
        };
        (0..groups.len()).filter(is_distinct).collect()
    }
}
