use robot::Robot;

use crate::columns::design::Design;
use crate::regression::problem::HypothesisSet;

/// Changes a robot by the weights of a model.
pub(crate) fn extend_robot(
    robot: &Robot,
    design: &Design,
    model: &HypothesisSet,
    weights: &[f64],
) -> Robot {
    let mut changed = robot.clone();
    for &g in model {
        let group = &design.groups[g];
        let own: Vec<f64> = group.columns.iter().map(|&k| weights[k]).collect();
        group.hypothesis.extend(&mut changed, &own, &design.frame, &design.priors);
    }
    changed
}
