use catalogue::EffectKind;
use robot::Robot;

use crate::abilities::{HasShape, ShapedDrive};
use crate::column::EffectColumn;
use crate::hypothesis::Hypothesis;
use crate::model::{MODELLED, model};
use crate::motion::frame::TrialSpring;
use crate::motion::run_motion::RunMotion;
use crate::motion::scale::Scale;
use crate::place::{AtJoint, Place, TypedPlace};
use crate::priors::Priors;

/// A trial value of the parameter in which the columns of an effect at a joint are not linear: a Stribeck velocity,
/// periods in a turn, a gap.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TrialShape {
    /// The effect and its joint.
    pub hypothesis: Hypothesis,
    /// The trial value.
    pub shape: f64,
}

/// A robot in which effects of size zero have a trial shape.
#[derive(Debug, Clone, PartialEq)]
pub struct ShapedRobot {
    /// The robot; its efforts are those of the robot without the shapes.
    pub robot: Robot,
    /// Trial gap of each joint (rad or m), for [`Frame::trial_gaps`](crate::Frame::trial_gaps); 0 where none is set.
    pub trial_gaps: Vec<f64>,
    /// Trial spring of each joint, for [`Frame::trial_springs`](crate::Frame::trial_springs); `None` where none is set.
    pub trial_springs: Vec<Option<TrialSpring>>,
    /// Trial time of late goals (s), for [`Frame::trial_lateness_s`](crate::Frame::trial_lateness_s); 0 where none is set.
    pub trial_lateness_s: f64,
}

impl ShapedRobot {
    /// The robot with no trial shape yet.
    pub fn new(robot: Robot) -> Self {
        let trial_gaps = vec![0.0; robot.joint_count()];
        let trial_springs = vec![None; robot.joint_count()];
        Self { robot, trial_gaps, trial_springs, trial_lateness_s: 0.0 }
    }

    /// Gives the robot an effect with this shape and size zero, which does not change its efforts.
    pub fn set_shape(&mut self, trial: TrialShape) {
        let Some((AtJoint(j), effect)) = trial.effect() else { return };
        if let (Some(link), Some(trial_gap)) = (self.robot.link_mut(j), self.trial_gaps.get_mut(j))
        {
            effect.set_shape(j, ShapedDrive { drive: &mut link.actuator, trial_gap }, trial.shape);
        }
    }
}

/// Every trial shape of every effect that this robot could have.
pub fn trial_shapes(robot: &Robot, scale: &Scale, priors: &Priors) -> Vec<TrialShape> {
    let mut all = Vec::new();
    for (kind, effect) in effects_with_shape() {
        for joint in 0..robot.joint_count() {
            let hypothesis = Hypothesis { kind, place: Place::Joint(joint) };
            let shapes = effect.shapes(AtJoint(joint), robot, scale, priors).into_iter();
            all.extend(shapes.map(|shape| TrialShape { hypothesis, shape }));
        }
    }
    all
}

/// The effects that have a shape.
fn effects_with_shape() -> impl Iterator<Item = (EffectKind, &'static dyn HasShape)> {
    MODELLED.into_iter().filter_map(|kind| Some((kind, model(kind).ok()?.shape()?)))
}

/// `robot` with the shapes of `nominal` wherever an effect has kept size zero. The friction that a drive loses by
/// warming up is limited to the friction that it has.
pub fn without_unused_shapes(mut robot: Robot, nominal: &Robot) -> Robot {
    for (j, link) in nominal.links().iter().enumerate() {
        let Some(changed) = robot.link_mut(j) else { continue };
        for (_, effect) in effects_with_shape() {
            effect.drop_unused_shape(&mut changed.actuator, &link.actuator);
        }
    }
    robot
}

impl TrialShape {
    /// The columns of the effect with this shape, along a motion of the robot without it.
    pub fn columns(self, motion: &mut RunMotion) -> Vec<EffectColumn> {
        let Some((AtJoint(j), effect)) = self.effect() else { return Vec::new() };
        let (drive, gap) = (motion.drives[j].clone(), motion.trial_gaps[j]);
        let shaped =
            ShapedDrive { drive: &mut motion.drives[j], trial_gap: &mut motion.trial_gaps[j] };
        effect.set_shape(j, shaped, self.shape);
        let columns = self.hypothesis.columns(motion);
        (motion.drives[j], motion.trial_gaps[j]) = (drive, gap);
        columns
    }

    fn effect(self) -> Option<(AtJoint, &'static dyn HasShape)> {
        let at = AtJoint::of(self.hypothesis.place)?;
        Some((at, model(self.hypothesis.kind).ok()?.shape()?))
    }
}
