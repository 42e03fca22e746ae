use std::borrow::Cow;

use effects::Hypothesis;
use logs::LogError;
use robot::Robot;

use crate::columns::design::Design;
use crate::regression::blocks::Block;
use crate::regression::body_errors::{choose_body_errors, prior_of_bodies};
use crate::regression::extend_robot::extend_robot;
use crate::regression::fit::Fit;
use crate::regression::gram::{Grams, Information};
use crate::regression::linear_fit::LinearFit;
use crate::regression::physical_inertias::physical_inertias;
use crate::regression::problem::{HypothesisSet, Problem};
use crate::signals::log::Log;

/// Most rounds of fitting again about the extended robot.
const ROUNDS: usize = 8;

/// Relative fall of the deviance below which a round counts as converged.
const CONVERGED: f64 = 1e-4;

/// Shortest share of a step that is tried.
const SHORTEST: f64 = 0.125;

/// A fit about the robot with the findings, for columns that are only tangents.
#[derive(Debug, Clone)]
pub(crate) struct Refit {
    /// The robot about which the columns are made.
    pub about: Robot,
    pub design: Design,
    pub grams: Grams,
    pub model: HypothesisSet,
    /// Remaining changes of the weights.
    pub weights: Vec<f64>,
    /// Weighted sum of squares of the robot's residual.
    left: f64,
    /// Deviance predicted by the linear model.
    expected: f64,
}

impl Refit {
    fn new(
        about: Robot,
        log: &Log,
        problem: &Problem,
        hypotheses: &[Hypothesis],
    ) -> Result<Self, LogError> {
        let design = problem.design.about(&about, log, hypotheses)?;
        let grams = Grams::new(&design, problem.blocks);
        let model: HypothesisSet = (0..design.groups.len()).collect();
        let (weights, left, expected) = (Vec::new(), 0.0, 0.0);
        let mut refit = Self { about, design, grams, model, weights, left, expected };
        refit.fit(problem, &problem.of);
        Ok(refit)
    }

    /// Fits the weights of the model to the blocks `of`.
    fn fit(&mut self, problem: &Problem, of: &[usize]) {
        let info = self.grams.information(of, &problem.weight);
        let sizes = &problem.thresholds.sizes;
        self.weights = physical_inertias(&self.design, &self.model, &info, &self.about, sizes);
        self.left = without_changes(&self.design, &info);
        self.expected = info.deviance(&self.weights);
    }

    /// A hypothesis whose fitted change of the robot is impossible.
    fn find_impossible(&self) -> Option<usize> {
        let (robot, priors) = (self.after_step(1.0), &self.design.priors);
        self.model.iter().copied().find(|&g| {
            let group = &self.design.groups[g];
            let own: Vec<f64> = group.columns.iter().map(|&k| self.weights[k]).collect();
            let is_change = own.iter().any(|w| w.abs() > 0.0);
            let hypothesis = group.hypothesis;
            is_change
                && !(hypothesis.admissible(&self.about, &own, priors)
                    && hypothesis.is_sound(&robot, priors))
        })
    }

    /// The robot after a share of the remaining step.
    fn after_step(&self, share: f64) -> Robot {
        extend_robot(&self.about, &self.design, &self.model, &scale(&self.weights, share))
    }
}

/// The robot with the findings of a model.
#[derive(Debug, Clone)]
pub(crate) struct FittedModel {
    pub model: HypothesisSet,
    /// Weights of the model about the robot without findings.
    pub weights: Vec<f64>,
    pub robot: Robot,
    /// `None` where the columns of every effect are linear.
    pub refit: Option<Refit>,
}

impl FittedModel {
    /// Residual of the robot at joint `j` in a block (N·m or N); `first` is the design about the robot without findings.
    pub fn remaining(&self, first: &Design, block: &Block, j: usize) -> Vec<f64> {
        let (design, weights) = match &self.refit {
            Some(Refit { design, weights, .. }) => (design, weights),
            None => (first, &self.weights),
        };
        block.remaining(design, j, &design.own_weights(weights))
    }

    /// The robot of a model with changes by `hypotheses` beside its own, which keep their sizes. They are not fitted yet.
    pub fn beside(
        &self,
        log: &Log,
        problem: &Problem,
        hypotheses: &[Hypothesis],
    ) -> Result<Self, LogError> {
        let refit = Some(Refit::new(self.robot.clone(), log, problem, hypotheses)?);
        Ok(Self { refit, ..self.clone() })
    }

    /// The errors of the described bodies, in errors of CAD, for which the changes beside the model have the most
    /// evidence.
    pub fn choose_body_errors(&self, problem: &Problem, candidates: &[f64]) -> Option<f64> {
        let Refit { design, grams, about, .. } = self.refit.as_ref()?;
        let info = grams.information(&problem.of, &problem.weight);
        choose_body_errors(design, about, &info, candidates)
    }

    /// Sets the prior of the changes of bodies to `errors` of CAD, if there are any.
    pub fn set_body_errors(&mut self, errors: Option<f64>) {
        let (Some(refit), Some(errors)) = (&mut self.refit, errors) else { return };
        refit.design.prior = prior_of_bodies(&refit.design, &refit.about, errors);
    }

    /// Fits those changes beside the model that `are_taken` to the blocks `of`, without those whose best size is
    /// physically impossible, such as a negative rotor inertia.
    pub fn fit_beside(
        &mut self,
        problem: &Problem,
        of: &[usize],
        are_taken: impl Fn(Hypothesis) -> bool,
    ) {
        let Some(refit) = &mut self.refit else { return };
        let groups = refit.design.groups.iter().enumerate();
        refit.model = groups.filter(|(_, g)| are_taken(g.hypothesis)).map(|(g, _)| g).collect();
        refit.fit(problem, of);
        while let Some(impossible) = refit.find_impossible() {
            refit.model.remove(&impossible);
            refit.fit(problem, of);
        }
        self.robot = refit.after_step(1.0);
    }

    /// The last linear fit; `first` is the one about the robot without findings.
    pub fn last_fit<'a>(&'a self, first: LinearFit<'a>) -> LinearFit<'a> {
        let Some(Refit { about, design, grams, model, weights, .. }) = &self.refit else {
            return first;
        };
        let problem = Cow::Owned(first.problem.about(design, grams));
        LinearFit { problem, model, weights, about, nominal: first.nominal }
    }
}

/// Fits a model, and the robot that results.
///
/// Columns of some effects are only tangents: a gain scales the torque of the other findings, a tilt turns gravity
/// along a circle, a softer spring twists more. These effects are fitted again about the robot with the findings, by
/// Gauss-Newton. A step is halved while it raises the deviance, and the iteration ends when the deviance no longer
/// falls.
pub(crate) fn fit_model(
    robot: &Robot,
    log: &Log,
    problem: &Problem,
    model: &HypothesisSet,
) -> Result<FittedModel, LogError> {
    let sizes = &problem.thresholds.sizes;
    let first = physical_inertias(problem.design, model, &problem.info, robot, sizes);
    let hypotheses: Vec<Hypothesis> =
        model.iter().map(|&g| problem.design.groups[g].hypothesis).collect();
    if !hypotheses.iter().any(|h| h.is_tangent()) {
        let robot = extend_robot(robot, problem.design, model, &first);
        return Ok(FittedModel { model: model.clone(), weights: first, robot, refit: None });
    }
    let (mut best, mut worse): (Option<Refit>, Option<Refit>) = (None, None);
    let (mut least, mut share) = (without_changes(problem.design, &problem.info), 1.0);
    for _ in 0..ROUNDS {
        let about = match &best {
            Some(best) => best.after_step(share),
            None => extend_robot(robot, problem.design, model, &scale(&first, share)),
        };
        let fit = Refit::new(about, log, problem, &hypotheses)?;
        if fit.left > (1.0 + CONVERGED) * least {
            worse = Some(fit);
            share *= 0.5;
            if share < SHORTEST {
                break;
            }
            continue;
        }
        let has_converged =
            fit.left >= (1.0 - CONVERGED) * least || fit.expected >= (1.0 - CONVERGED) * fit.left;
        (least, share, worse) = (fit.left, 1.0, None);
        best = Some(fit);
        if has_converged {
            break;
        }
    }
    // A last step that leads to a larger deviance is not taken.
    if let Some(best) = best.as_mut().filter(|_| worse.is_some()) {
        best.weights.fill(0.0);
    }
    let refit = best.or(worse);
    let robot = refit.as_ref().map_or_else(
        || extend_robot(robot, problem.design, model, &first),
        |refit| refit.after_step(1.0),
    );
    Ok(FittedModel { model: model.clone(), weights: first, robot, refit })
}

/// The deviance of the robot of a design, with what the logs have in common with others at its best.
fn without_changes(design: &Design, info: &Information) -> f64 {
    let common = Fit::new(info, design.columns(&HypothesisSet::new()), design.weight_prior());
    common.map_or(info.yy, |fit| info.deviance(&fit.expand(design.width)))
}

fn scale(weights: &[f64], share: f64) -> Vec<f64> {
    weights.iter().map(|w| share * w).collect()
}
