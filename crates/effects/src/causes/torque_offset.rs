use catalogue::EffectKind;
use robot::{Actuator, Robot};

use crate::bounds::infinite_bounds;
use crate::column::{EffectColumn, at_joint};
use crate::effect::Effect;
use crate::motion::frame::Frame;
use crate::motion::run_motion::RunMotion;
use crate::motion::scale::Scale;
use crate::place::{AtJoint, every_joint};
use crate::priors::Priors;
use crate::quantity::{EffectQuantity, actuator_quantity};
use crate::traits::{Imitable, Law, Linearity, Location, Relation, Traits, Weights};

/// `offset`: one weight a joint, the change of the effort reported at zero torque.
pub(crate) struct TorqueOffset;

impl Effect for TorqueOffset {
    type At = AtJoint;

    fn kind(&self) -> EffectKind {
        EffectKind::TorqueOffset
    }

    /// Where a joint turns mostly one way, an offset and dry friction are alike, and every joint has dry friction.
    fn traits(&self) -> Traits {
        const RELATIONS: &[Relation] = &[Relation::PlainerHere(EffectKind::CoulombFriction)];
        Traits::new(
            Linearity::Exact,
            Imitable::No,
            Law::Exact,
            Location::Elsewhere,
            Weights::Direct,
            RELATIONS,
        )
    }

    fn remedy(&self) -> Result<&'static str, &'static str> {
        Ok("asking for the offset as well")
    }

    fn omission(&self, _: &Actuator) -> Option<&'static str> {
        None
    }

    fn places(&self, robot: &Robot) -> Vec<AtJoint> {
        every_joint(robot)
    }

    fn columns(&self, AtJoint(j): AtJoint, motion: &RunMotion) -> Vec<EffectColumn> {
        vec![at_joint(j, (0..motion.samples()).map(|_| 1.0))]
    }

    /// An offset as large as the effort itself.
    fn prior(&self, AtJoint(j): AtJoint, _: &Robot, scale: &Scale, _: &Priors) -> Vec<f64> {
        vec![scale.effort[j]]
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
            link.actuator.torque_offset += change;
        }
    }

    fn quantities(
        &self,
        AtJoint(j): AtJoint,
        nominal: &Robot,
        extended: &Robot,
    ) -> Vec<EffectQuantity> {
        vec![actuator_quantity(self.kind(), 0, j, [nominal, extended], |a| a.torque_offset)]
    }
}
