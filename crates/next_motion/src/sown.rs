use std::collections::BTreeMap;

use effects::{Germ, germs};
use robot::Robot;

use crate::known::supposed;

/// The robot with the germ of every effect that needs one, of the middle one of its trial values:
/// a question that concerns Stribeck friction, say, is to be asked of a robot that has the
/// velocity of it.
pub fn sown(robot: &Robot) -> Robot {
    let mut trials: BTreeMap<_, Vec<Germ>> = BTreeMap::new();
    for germ in germs(robot, &supposed(robot), &effects::Priors::default()) {
        trials.entry(germ.hypothesis).or_default().push(germ);
    }
    let mut sown = robot.clone();
    trials.values().for_each(|trials| trials[trials.len() / 2].sow(&mut sown));
    sown
}
