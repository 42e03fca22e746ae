use std::sync::OnceLock;

use robot::Robot;

use crate::regression::fit::Fit;
use crate::regression::linear_fit::LinearFit;
use crate::regression::problem::{HeldOutResiduals, HypothesisSet, Problem};
use crate::regression::uncertainty::Uncertainty;
use crate::search::kept_nominal::KeptNominal;

/// Which rules about the last fit are asked.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum SizeQuestion {
    /// Whether sizes are determined.
    Sizes,
    /// Whether sizes are constant.
    Constancy,
    /// Both.
    Both,
}

/// The last fit of a model, about the robot that has its findings.
#[derive(Debug)]
pub(crate) struct LastFit<'a> {
    pub linear: LinearFit<'a>,
    /// Weights of the model about the robot without findings.
    pub first_weights: &'a [f64],
    /// The robot with the fitted changes.
    pub robot: Robot,
    pub uncertainty: Option<Uncertainty>,
    pub question: SizeQuestion,
}

impl<'a> LastFit<'a> {
    pub fn new(linear: LinearFit<'a>, first_weights: &'a [f64], question: SizeQuestion) -> Self {
        let (robot, uncertainty) = (linear.robot(), Uncertainty::of(&linear));
        Self { linear, first_weights, robot, uncertainty, question }
    }
}

/// A model with its fits, about which changes are asked.
#[derive(Debug)]
pub(crate) struct ModelState<'a> {
    problem: &'a Problem<'a>,
    pub model: HypothesisSet,
    /// The fit about the robot without findings.
    pub fit: Fit,
    held_out: OnceLock<HeldOutResiduals>,
    /// `None` in a search, which asks the rules about the first fit alone.
    pub last: Option<LastFit<'a>>,
    /// Joints that keep their description, once it is known.
    pub kept_nominal: Option<&'a KeptNominal>,
}

impl<'a> ModelState<'a> {
    /// A model and its first fit; `None` where the normal equations are not positive definite.
    pub fn new(problem: &'a Problem<'a>, model: HypothesisSet) -> Option<Self> {
        let fit = problem.fit(&model)?;
        Some(Self {
            problem,
            model,
            fit,
            held_out: OnceLock::new(),
            last: None,
            kept_nominal: None,
        })
    }

    /// The same, with its last fit.
    pub fn about(self, last: LastFit<'a>) -> Self {
        Self { last: Some(last), ..self }
    }

    /// The same, where some joints keep their description.
    pub fn keeping(self, kept_nominal: &'a KeptNominal) -> Self {
        Self { kept_nominal: Some(kept_nominal), ..self }
    }

    /// Squared residuals on held-out blocks, of the fits about the robot without findings.
    pub fn held_out(&self) -> &HeldOutResiduals {
        self.held_out.get_or_init(|| self.problem.hold_out(&self.model))
    }
}
