use catalogue::EffectKind;
use robot::Robot;

use crate::abilities::HasShape;
use crate::column::Column;
use crate::hypothesis::Hypothesis;
use crate::model::{MODELLED, model};
use crate::motion::run_motion::Motion;
use crate::motion::scale::Scale;
use crate::place::{AtJoint, Place, TypedPlace};
use crate::priors::Priors;

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
pub fn germs(robot: &Robot, scale: &Scale, priors: &Priors) -> Vec<Germ> {
    let mut all = Vec::new();
    for (kind, effect) in shaped() {
        for joint in 0..robot.joint_count() {
            let hypothesis = Hypothesis { kind, place: Place::Joint(joint) };
            let shapes = effect.shapes(AtJoint(joint), robot, scale, priors).into_iter();
            all.extend(shapes.map(|shape| Germ { hypothesis, shape }));
        }
    }
    all
}

/// The effects that have a shape.
fn shaped() -> impl Iterator<Item = (EffectKind, &'static dyn HasShape)> {
    MODELLED.into_iter().filter_map(|kind| Some((kind, model(kind).ok()?.shape()?)))
}

/// `robot` without the germs that stayed without size: there it is as `nominal` is. Where less friction was
/// found than a drive was described to lose by warming up, it loses that.
pub fn weeded(mut robot: Robot, nominal: &Robot) -> Robot {
    for (j, link) in nominal.links().iter().enumerate() {
        let Some(changed) = robot.link_mut(j) else { continue };
        for (_, effect) in shaped() {
            effect.drop_unused_shape(&mut changed.actuator, &link.actuator);
        }
    }
    robot
}

impl Germ {
    /// The robot with the germ: it moves as it did.
    pub fn sow(self, robot: &mut Robot) {
        let Some((AtJoint(j), effect)) = self.effect() else { return };
        if let Some(link) = robot.link_mut(j) {
            effect.sow(j, &mut link.actuator, self.shape);
        }
    }

    /// The columns of the effect in a robot with the germ, along a motion of the robot without.
    pub fn columns(self, motion: &mut Motion) -> Vec<Column> {
        let Some((AtJoint(j), effect)) = self.effect() else { return Vec::new() };
        let before = motion.drives[j].clone();
        effect.sow(j, &mut motion.drives[j], self.shape);
        let columns = self.hypothesis.columns(motion);
        motion.drives[j] = before;
        columns
    }

    fn effect(self) -> Option<(AtJoint, &'static dyn HasShape)> {
        let at = AtJoint::of(self.hypothesis.place)?;
        Some((at, model(self.hypothesis.kind).ok()?.shape()?))
    }
}
