use logs::LogError;
use robot::Robot;

use crate::regression::problem::{Model, Problem};
use crate::regression::solved::{Solved, solved};
use crate::signals::log::Log;
use crate::thresholds::EVIDENCE_OF_DOUBTFUL;

/// The effect of a solved model, if any, that does less than its columns and for whose sake the
/// robot is no nearer to the logs.
///
/// ```text
/// D(robot) > D(columns) + 2.0 * EVIDENCE_OF_DOUBTFUL          some effect does less than its columns
/// D(robot without g) < D(robot) + 2.0 * EVIDENCE_OF_DOUBTFUL  and this one does nothing; if several, the least
/// ```
///
/// with `D` the weighted sum of squares that is left. Columns are those of a small change: a spring so
/// soft that the link rings with the motion is another torque than its columns, which then explain
/// something else.
pub(crate) fn idle(
    robot: &Robot,
    log: &Log,
    (problem, model): (&Problem, &Model),
    solution: &Solved,
) -> Result<Option<usize>, LogError> {
    let left = solution.left(problem);
    if left <= problem.info.deviance(&solution.weights) + 2.0 * EVIDENCE_OF_DOUBTFUL {
        return Ok(None);
    }
    let mut least: Option<(f64, usize)> = None;
    let is_bent = |g: &&usize| problem.design.groups[**g].hypothesis.is_tangent();
    for &g in model.iter().filter(is_bent) {
        let mut without = model.clone();
        without.remove(&g);
        let other = solved(robot, log, problem, &without)?.left(problem);
        if other < left + 2.0 * EVIDENCE_OF_DOUBTFUL && least.is_none_or(|(least, _)| other < least)
        {
            least = Some((other, g));
        }
    }
    Ok(least.map(|(_, g)| g))
}
