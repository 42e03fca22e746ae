use effects::Hypothesis;
use logs::LogError;
use robot::Robot;

use crate::columns::design::Design;
use crate::regression::extended::extended;
use crate::regression::fitted::Fitted;
use crate::regression::gram::Grams;
use crate::regression::problem::{Model, Problem};
use crate::regression::settle::settle;
use crate::signals::log::Log;

/// Most rounds of fitting anew about the extended robot.
const ROUNDS: usize = 8;

/// Relative fall of what is left below which a round has changed nothing.
const SETTLED: f64 = 1e-4;

/// Shortest share of a step that is tried.
const SHORTEST: f64 = 0.125;

/// The fit about a robot that already has the findings, where columns are tangents only.
#[derive(Debug, Clone)]
pub(crate) struct Refit {
    /// The robot that it is about.
    pub about: Robot,
    pub design: Design,
    pub grams: Grams,
    pub model: Model,
    /// What is still changed.
    pub weights: Vec<f64>,
    /// Weighted sum of squares that the robot leaves.
    left: f64,
    /// What it would leave were the columns the same with what is still changed.
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
        let model: Model = (0..design.groups.len()).collect();
        let info = grams.information(&problem.of, &problem.weight);
        let weights = settle(&design, &model, &info, &about);
        let (left, expected) = (info.yy, info.deviance(&weights));
        Ok(Self { about, design, grams, model, weights, left, expected })
    }

    /// The robot a share of the way on that is still to go.
    fn stepped(&self, share: f64) -> Robot {
        extended(&self.about, &self.design, &self.model, &scaled(&self.weights, share))
    }
}

/// The robot with the findings of a model.
#[derive(Debug, Clone)]
pub(crate) struct Solved {
    /// Weights of the model about the robot without them.
    pub weights: Vec<f64>,
    pub robot: Robot,
    /// None where every column is the same however large the effect.
    pub refit: Option<Refit>,
}

impl Solved {
    /// What is left of the effort of joint `j` in a run (N·m or N); `first` is the design about the
    /// robot without findings.
    pub fn remaining(&self, first: &Design, run: usize, j: usize) -> Vec<f64> {
        match &self.refit {
            Some(Refit { design, weights, .. }) => design.remaining(run, j, weights),
            None => first.remaining(run, j, &self.weights),
        }
    }

    /// What `tell` says of the last fit: `first` is the one about the robot without findings.
    pub fn tell<T>(&self, first: &Fitted, tell: impl FnOnce(&Fitted) -> T) -> T {
        let Some(Refit { about, design, grams, model, weights, .. }) = &self.refit else {
            return tell(first);
        };
        let Problem { blocks, of, weight, .. } = first.problem;
        let problem = Problem::new(design, blocks, grams, of, weight.clone());
        tell(&Fitted { problem: &problem, model, weights, about, nominal: first.nominal })
    }
}

/// The robot changed by the weights of a model, with what is left of the changes fitted
/// again about it where columns are tangents only: a gain scales what the other findings
/// add, a tilt turns gravity on a circle, and a spring twists the more the softer it is. A Gauss-Newton
/// iteration, whose steps are halved where they lead to worse, and which ends where it gets no better.
pub(crate) fn solved(
    robot: &Robot,
    log: &Log,
    problem: &Problem,
    model: &Model,
) -> Result<Solved, LogError> {
    let first = settle(problem.design, model, &problem.info, robot);
    let hypotheses: Vec<Hypothesis> =
        model.iter().map(|&g| problem.design.groups[g].hypothesis).collect();
    if !hypotheses.iter().any(|h| h.is_tangent()) {
        let robot = extended(robot, problem.design, model, &first);
        return Ok(Solved { weights: first, robot, refit: None });
    }
    let (mut best, mut worse): (Option<Refit>, Option<Refit>) = (None, None);
    let (mut least, mut share) = (problem.info.yy, 1.0);
    for _ in 0..ROUNDS {
        let about = match &best {
            Some(best) => best.stepped(share),
            None => extended(robot, problem.design, model, &scaled(&first, share)),
        };
        let fit = Refit::new(about, log, problem, &hypotheses)?;
        if fit.left > (1.0 + SETTLED) * least {
            worse = Some(fit);
            share *= 0.5;
            if share < SHORTEST {
                break;
            }
            continue;
        }
        let is_settled =
            fit.left >= (1.0 - SETTLED) * least || fit.expected >= (1.0 - SETTLED) * fit.left;
        (least, share, worse) = (fit.left, 1.0, None);
        best = Some(fit);
        if is_settled {
            break;
        }
    }
    // Where the last step led to worse, it is not taken.
    if let Some(best) = best.as_mut().filter(|_| worse.is_some()) {
        best.weights.fill(0.0);
    }
    let refit = best.or(worse);
    let robot = refit
        .as_ref()
        .map_or_else(|| extended(robot, problem.design, model, &first), |refit| refit.stepped(1.0));
    Ok(Solved { weights: first, robot, refit })
}

fn scaled(weights: &[f64], share: f64) -> Vec<f64> {
    weights.iter().map(|w| share * w).collect()
}
