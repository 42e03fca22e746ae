use robot::Robot;

use crate::column::Column;
use crate::hypothesis::Hypothesis;
use crate::model::{MODELLED, model};
use crate::motion::run_motion::Motion;
use crate::motion::scale::Scale;
use crate::place::Place;

/// An effect of no size at a joint, with a trial value of the parameter that its columns are not
/// linear in: a Stribeck velocity, periods in a turn, a play.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Germ {
    /// The effect and its joint.
    pub hypothesis: Hypothesis,
    /// The trial value.
    pub shape: f64,
}

/// Every germ that could be sown in this robot.
pub fn germs(robot: &Robot, scale: &Scale) -> Vec<Germ> {
    let models = MODELLED.into_iter().filter_map(|kind| Some((kind, model(kind).ok()?)));
    let joints = 0..robot.joint_count();
    let at = |(kind, joint)| Hypothesis { kind, place: Place::Joint(joint) };
    models
        .flat_map(|(kind, model)| {
            joints.clone().flat_map(move |joint| {
                let shapes = model.shapes(joint, robot, scale).into_iter();
                shapes.map(move |shape| Germ { hypothesis: at((kind, joint)), shape })
            })
        })
        .collect()
}

/// `robot` without the germs that stayed without size: there it is as `nominal` is. Where less friction was
/// found than a drive was described to lose by warming up, it loses that.
pub fn weeded(mut robot: Robot, nominal: &Robot) -> Robot {
    for (j, link) in nominal.links().iter().enumerate() {
        let Some(changed) = robot.link_mut(j) else { continue };
        let (drive, before) = (&mut changed.actuator, &link.actuator);
        drive.backlash_trial = before.backlash_trial;
        if drive.stribeck.is_some_and(|s| s.excess <= 0.0) {
            drive.stribeck = before.stribeck;
        }
        if drive.coupling.is_some_and(|c| c.level.iter().chain(&c.viscous).all(|v| *v <= 0.0)) {
            drive.coupling = before.coupling;
        }
        if drive.warming.is_some_and(|w| w.viscous_lost <= 0.0 && w.coulomb_lost <= 0.0) {
            drive.warming = before.warming;
        }
        drive.warming = drive.warming.map(|warming| drive.lost_at_most(warming));
        if drive.friction_wave.is_some_and(|w| w.share <= 0.0) {
            drive.friction_wave = before.friction_wave;
        }
    }
    robot
}

impl Germ {
    /// The robot with the germ: it moves as it did.
    pub fn sow(self, robot: &mut Robot) {
        let (Place::Joint(j), Ok(model)) = (self.hypothesis.place, model(self.hypothesis.kind))
        else {
            return;
        };
        if let Some(link) = robot.link_mut(j) {
            model.sow(j, &mut link.actuator, self.shape);
        }
    }

    /// The columns of the effect in a robot with the germ, along a motion of the robot without.
    pub fn columns(self, motion: &mut Motion) -> Vec<Column> {
        let (Place::Joint(j), Ok(model)) = (self.hypothesis.place, model(self.hypothesis.kind))
        else {
            return Vec::new();
        };
        let before = motion.drives[j].clone();
        model.sow(j, &mut motion.drives[j], self.shape);
        let columns = self.hypothesis.columns(motion);
        motion.drives[j] = before;
        columns
    }
}
