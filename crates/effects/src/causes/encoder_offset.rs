use catalogue::EffectKind;
use robot::{Actuator, Robot};

use crate::abilities::BetweenEncoders;
use crate::bounds::infinite_bounds;
use crate::column::{EffectColumn, at_joint};
use crate::effect::Effect;
use crate::motion::frame::Frame;
use crate::motion::run_motion::RunMotion;
use crate::motion::scale::Scale;
use crate::place::{AtJoint, every_joint};
use crate::priors::Priors;
use crate::quantity::{EffectQuantity, actuator_quantity};
use crate::traits::{Imitable, Law, Linearity, Location, Traits, Weights};

/// `tau(q - offset) - tau(q)`: one weight a joint, the change of the offset (rad or m).
///
/// The column is the slope of the torque of every joint by the position of this one.
pub(crate) struct EncoderOffset;

impl Effect for EncoderOffset {
    type At = AtJoint;

    fn kind(&self) -> EffectKind {
        EffectKind::EncoderOffset
    }

    fn traits(&self) -> Traits {
        Traits::new(
            Linearity::Tangent,
            Imitable::Yes,
            Law::Exact,
            Location::BeforeTheLink,
            Weights::Direct,
            &[],
        )
    }

    fn remedy(&self) -> Result<&'static str, &'static str> {
        Ok("a reference that is off as the encoder is")
    }

    fn omission(&self, drive: &Actuator) -> Option<&'static str> {
        (drive.encoder_offset.abs() > 0.0).then_some("encoder_offset_rad")
    }

    fn places(&self, robot: &Robot) -> Vec<AtJoint> {
        every_joint(robot)
    }

    fn columns(&self, AtJoint(j): AtJoint, motion: &RunMotion) -> Vec<EffectColumn> {
        let moved = vec![-motion.drives[j].transmission_ratio; motion.samples()];
        let still = vec![0.0; motion.samples()];
        vec![motion.displacement_column(j, [&moved, &still, &still])]
    }

    fn prior(&self, _: AtJoint, _: &Robot, _: &Scale, priors: &Priors) -> Vec<f64> {
        vec![priors.encoder_offset_sd]
    }

    fn bounds(&self, _: AtJoint, _: &Robot, _: &Priors) -> Vec<(f64, f64)> {
        infinite_bounds(1)
    }

    fn extend(
        &self,
        AtJoint(j): AtJoint,
        robot: &mut Robot,
        weights: &[f64],
        _: &Frame,
        _: &Priors,
    ) {
        let [change] = weights else { return };
        if let Some(link) = robot.link_mut(j) {
            link.actuator.encoder_offset += change;
        }
    }

    fn quantities(
        &self,
        AtJoint(j): AtJoint,
        nominal: &Robot,
        extended: &Robot,
    ) -> Vec<EffectQuantity> {
        vec![actuator_quantity(self.kind(), 0, j, [nominal, extended], |a| a.encoder_offset)]
    }

    fn between_encoders(&self) -> Option<&dyn BetweenEncoders> {
        Some(self)
    }
}

impl BetweenEncoders for EncoderOffset {
    fn twist(&self, AtJoint(j): AtJoint, motion: &RunMotion) -> Vec<EffectColumn> {
        vec![at_joint(j, motion.q[j].iter().map(|_| 1.0))]
    }
}
