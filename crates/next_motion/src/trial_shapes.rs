use std::collections::BTreeMap;

use effects::{ShapedRobot, TrialShape, trial_shapes};
use robot::Robot;

use crate::known::scale_of_limits;

/// The robot with a trial shape of every effect that needs one: the middle one of its trial values.
///
/// A question that concerns Stribeck friction, say, is asked of a robot that has a Stribeck velocity.
pub fn with_trial_shapes(robot: &Robot) -> ShapedRobot {
    let mut trials: BTreeMap<_, Vec<TrialShape>> = BTreeMap::new();
    for trial in trial_shapes(robot, &scale_of_limits(robot), &effects::Priors::default()) {
        trials.entry(trial.hypothesis).or_default().push(trial);
    }
    let mut shaped = ShapedRobot::new(robot.clone());
    trials.values().for_each(|trials| shaped.set_shape(trials[trials.len() / 2]));
    shaped
}
