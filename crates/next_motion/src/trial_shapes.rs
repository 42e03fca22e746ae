use std::collections::BTreeMap;

use effects::{Germ, germs};
use robot::Robot;

use crate::known::scale_of_limits;

/// The robot with a trial shape of every effect that needs one: the middle one of its trial values.
///
/// A question that concerns Stribeck friction, say, is asked of a robot that has a Stribeck velocity.
pub fn with_trial_shapes(robot: &Robot) -> Robot {
    let mut trials: BTreeMap<_, Vec<Germ>> = BTreeMap::new();
    for germ in germs(robot, &scale_of_limits(robot), &effects::Priors::default()) {
        trials.entry(germ.hypothesis).or_default().push(germ);
    }
    let mut shaped = robot.clone();
    trials.values().for_each(|trials| trials[trials.len() / 2].sow(&mut shaped));
    shaped
}
