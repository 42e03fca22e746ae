use robot::Robot;

use crate::regression::extended::extended;
use crate::regression::problem::{Model, Problem};

/// A model as it was last fitted, about a robot that may have the findings already.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Fitted<'a> {
    pub problem: &'a Problem<'a>,
    pub model: &'a Model,
    pub weights: &'a [f64],
    /// The robot that the columns are about.
    pub about: &'a Robot,
    /// The robot as it was described.
    pub nominal: &'a Robot,
}

impl Fitted<'_> {
    /// The robot with what was fitted.
    pub fn robot(&self) -> Robot {
        extended(self.about, self.problem.design, self.model, self.weights)
    }
}
