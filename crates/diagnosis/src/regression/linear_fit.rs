use std::borrow::Cow;

use robot::Robot;

use crate::regression::extend_robot::extend_robot;
use crate::regression::problem::{HypothesisSet, Problem};

/// A model as a linear fit: columns about one robot, and their weights. This robot may include the findings already.
#[derive(Debug, Clone)]
pub(crate) struct LinearFit<'a> {
    pub problem: Cow<'a, Problem<'a>>,
    pub model: &'a HypothesisSet,
    pub weights: &'a [f64],
    /// The robot that the columns are about.
    pub about: &'a Robot,
    /// The robot as it was described.
    pub nominal: &'a Robot,
}

impl LinearFit<'_> {
    /// The robot with the fitted changes.
    pub fn robot(&self) -> Robot {
        extend_robot(self.about, self.problem.design, self.model, self.weights)
    }
}
