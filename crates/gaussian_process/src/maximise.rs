use std::cell::RefCell;
use std::ops::ControlFlow;

use basin::{
    BoxBounds, ConstraintDescription, ConstraintSet, Constraints, CostFunction, Executor,
    FirstOrderState, Gradient, Lbfgsb, Termination,
};

use crate::error::{GpError, check};

/// Largest slope, in units of the objective per unit of a parameter, at a maximum.
const SLOPE: f64 = 1e-4;

/// Relative gain of a step below which a search has converged, as in SciPy's L-BFGS-B.
const RELATIVE_GAIN: f64 = 2.2e-9;

/// Steps that the approximation of the curvature remembers.
const MEMORY: usize = 10;

/// How a search for a maximum ended.
#[derive(Debug, Clone, PartialEq)]
pub enum SearchEnd {
    /// Slope or gain of a step became negligible.
    Converged,
    /// The line search could not go on.
    Stalled {
        /// What the optimiser said.
        because: String,
    },
    /// The number of iterations that was allowed is used up.
    OutOfIterations,
    /// The caller asked for an end.
    Stopped,
}

impl SearchEnd {
    /// In words, with advice where there is any.
    pub fn words(&self) -> String {
        match self {
            Self::Converged => "converged".into(),
            Self::Stalled { because } => format!(
                "stalled ({because}): the likelihood is flat or rough here; \
                 more points, another start or narrower bounds may help"
            ),
            Self::OutOfIterations => {
                "out of iterations: still rising, allow more for the last digits".into()
            }
            Self::Stopped => "stopped before it converged; the best found so far is kept".into(),
        }
    }
}

/// The highest point that a search found.
#[derive(Debug, Clone, PartialEq)]
pub struct Maximum {
    /// Where it lies.
    pub at: Vec<f64>,
    /// Value there.
    pub value: f64,
    /// Evaluations of the objective.
    pub evaluations: usize,
    /// Iterations of the optimiser.
    pub iterations: usize,
    /// How the search ended.
    pub end: SearchEnd,
}

/// What is maximised: fills the gradient at a point and returns the value.
pub type Objective<'a> = dyn FnMut(&[f64], &mut [f64]) -> Result<f64, GpError> + 'a;

/// Receives the number and the value of every evaluation, and returns whether to go on.
pub type SearchWatch<'a> = dyn Fn(usize, f64) -> ControlFlow<()> + 'a;

/// Maximises `objective` within `bounds` from `start` by L-BFGS-B (Byrd, Lu, Nocedal & Zhu
/// 1995), for at most `iterations`.
///
/// A point where the objective cannot be evaluated gets a value far below the first one.
///
/// # Errors
///
/// [`GpError::WrongLength`] and [`GpError::NotFinite`] for the start, and the error of the
/// first evaluation.
pub fn maximise(
    objective: &mut Objective,
    start: &[f64],
    bounds: &[(f64, f64)],
    iterations: usize,
    watch: &SearchWatch,
) -> Result<Maximum, GpError> {
    check("start", start, bounds.len())?;
    let start: Vec<f64> =
        start.iter().zip(bounds).map(|(x, &(low, high))| x.max(low).min(high)).collect();
    let first = objective(&start, &mut vec![0.0; start.len()])?;
    let (low, high): (Vec<f64>, Vec<f64>) = bounds.iter().copied().unzip();
    let best = Maximum {
        at: start.clone(),
        value: first,
        evaluations: 0,
        iterations: 0,
        end: SearchEnd::Stopped,
    };
    let climb = Climb { objective: RefCell::new(objective), best: RefCell::new(best), watch };
    let solver = Lbfgsb::new()
        .with_m_capacity(MEMORY)
        .with_absolute_projected_gradient_tolerance(SLOPE)
        .with_relative_cost_reduction_tolerance(RELATIVE_GAIN);
    let problem = Descent { climb: &climb, low, high, floor: first - 1e3 * (1.0 + first.abs()) };
    let limit = u64::try_from(iterations).unwrap_or(u64::MAX);
    let run = Executor::new(problem, solver, FirstOrderState::new(start)).max_iter(limit).run();
    // An error is the stop that was asked for: the best point says so already.
    let end = run.ok().map(|result| {
        let end = match &result.report.termination {
            Termination::Converged(_) => SearchEnd::Converged,
            Termination::Limit(_) => SearchEnd::OutOfIterations,
            _ => SearchEnd::Stalled { because: format!("{:?}", result.report.code()) },
        };
        (usize::try_from(result.iter()).unwrap_or(usize::MAX), end)
    });
    let mut best = climb.best.borrow().clone();
    if let Some((iterations, end)) = end {
        (best.iterations, best.end) = (iterations, end);
    }
    Ok(best)
}

/// The objective, the best point that it was evaluated at, and who is told.
struct Climb<'a, 'b> {
    objective: RefCell<&'a mut Objective<'b>>,
    best: RefCell<Maximum>,
    watch: &'a SearchWatch<'a>,
}

/// The same with the sign of a minimisation, in the form that the optimiser takes.
struct Descent<'a, 'b> {
    climb: &'a Climb<'a, 'b>,
    low: Vec<f64>,
    high: Vec<f64>,
    floor: f64,
}

/// The caller asked for an end.
#[derive(Debug)]
struct Stop;

impl std::fmt::Display for Stop {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("stopped")
    }
}

impl std::error::Error for Stop {}

impl Constraints for Descent<'_, '_> {
    type Set = ConstraintSet<BoxBounds<Vec<f64>>>;

    fn constraints(&self) -> <Self::Set as ConstraintDescription>::Borrowed<'_> {
        ConstraintSet::new().with_bounds(BoxBounds::new(Some(&self.low), Some(&self.high)))
    }
}

impl CostFunction for Descent<'_, '_> {
    type Param = Vec<f64>;
    type Output = f64;
    type Error = Stop;

    fn cost(&self, x: &Vec<f64>) -> Result<f64, Stop> {
        Ok(self.cost_and_gradient(x)?.0)
    }
}

impl Gradient for Descent<'_, '_> {
    type Gradient = Vec<f64>;

    fn gradient(&self, x: &Vec<f64>) -> Result<Vec<f64>, Stop> {
        Ok(self.cost_and_gradient(x)?.1)
    }

    fn cost_and_gradient(&self, x: &Vec<f64>) -> Result<(f64, Vec<f64>), Stop> {
        let mut slope = vec![0.0; x.len()];
        let found = (self.climb.objective.borrow_mut())(x, &mut slope);
        // No value is a low and level one: the line search needs numbers to come back from.
        let value = found.unwrap_or(self.floor);
        let mut best = self.climb.best.borrow_mut();
        best.evaluations += 1;
        if value > best.value {
            best.value = value;
            best.at.clone_from(x);
        }
        if (self.climb.watch)(best.evaluations, best.value).is_break() {
            return Err(Stop);
        }
        slope.iter_mut().for_each(|g| *g = -*g);
        Ok((-value, slope))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `-(1 - x)² - 100 (y - x²)²`, highest at (1, 1).
    fn rosenbrock(x: &[f64], slope: &mut [f64]) -> Result<f64, GpError> {
        let (a, b) = (1.0 - x[0], x[1] - x[0] * x[0]);
        slope[0] = 2.0 * a + 400.0 * b * x[0];
        slope[1] = -200.0 * b;
        Ok(-a * a - 100.0 * b * b)
    }

    const ON: &SearchWatch = &|_, _| ControlFlow::Continue(());

    #[test]
    fn a_curved_ridge_is_climbed_to_its_top_and_to_a_bound() {
        let free = [(-5.0, 5.0); 2];
        let top = maximise(&mut rosenbrock, &[-1.2, 1.0], &free, 200, ON).unwrap();
        assert_eq!(top.end, SearchEnd::Converged);
        assert!((top.at[0] - 1.0).abs() < 1e-3 && (top.at[1] - 1.0).abs() < 1e-3, "{top:?}");
        let bounds = [(-5.0, 0.5), (-5.0, 5.0)];
        let edge = maximise(&mut rosenbrock, &[-1.2, 1.0], &bounds, 200, ON).unwrap();
        assert!((edge.at[0] - 0.5).abs() < 1e-6 && (edge.at[1] - 0.25).abs() < 1e-3, "{edge:?}");
    }

    #[test]
    fn a_search_that_is_stopped_or_limited_says_so_and_keeps_its_best() {
        let stop: &SearchWatch = &|evaluations, _| match evaluations {
            0..5 => ControlFlow::Continue(()),
            _ => ControlFlow::Break(()),
        };
        let free = [(-5.0, 5.0); 2];
        let stopped = maximise(&mut rosenbrock, &[-1.2, 1.0], &free, 200, stop).unwrap();
        assert_eq!((stopped.end, stopped.evaluations), (SearchEnd::Stopped, 5));
        assert!(stopped.value > -24.2);
        let limited = maximise(&mut rosenbrock, &[-1.2, 1.0], &free, 3, ON).unwrap();
        assert_eq!(limited.end, SearchEnd::OutOfIterations);
    }

    #[test]
    fn points_without_a_value_are_avoided() {
        let mut wall = |x: &[f64], slope: &mut [f64]| match x[0] {
            x if x > 2.0 => Err(GpError::NoPoints),
            x => {
                slope[0] = 2.0 * (1.9 - x);
                Ok(-(x - 1.9) * (x - 1.9))
            }
        };
        let found = maximise(&mut wall, &[-30.0], &[(-50.0, 50.0)], 100, ON).unwrap();
        assert!((found.at[0] - 1.9).abs() < 1e-3, "{found:?}");
        let none = maximise(&mut wall, &[3.0], &[(-50.0, 50.0)], 100, ON);
        assert_eq!(none, Err(GpError::NoPoints));
    }
}
