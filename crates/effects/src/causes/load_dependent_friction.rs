use catalogue::EffectKind;
use robot::{Actuator, Robot};

use crate::bounds::down_to_zero;
use crate::column::{EffectColumn, at_joint};
use crate::effect::{EASED_LEVEL, Effect};
use crate::motion::frame::Frame;
use crate::motion::run_motion::RunMotion;
use crate::motion::scale::Scale;
use crate::place::{AtJoint, every_joint};
use crate::priors::Priors;
use crate::quantity::{EffectQuantity, actuator_quantity};
use crate::traits::{Imitable, Law, Linearity, Location, Relation, Traits, Weights};

/// `coefficient |load| sign(qd)`: one weight a joint, the change of the coefficient.
pub(crate) struct LoadDependentFriction;

impl Effect for LoadDependentFriction {
    type At = AtJoint;

    fn kind(&self) -> EffectKind {
        EffectKind::LoadDependentFriction
    }

    fn traits(&self) -> Traits {
        const RELATIONS: &[Relation] = &[Relation::PlainerHere(EffectKind::CoulombFriction)];
        Traits::new(
            Linearity::Tangent,
            Imitable::Yes,
            Law::Approximate,
            Location::Elsewhere,
            Weights::Direct,
            RELATIONS,
        )
    }

    fn remedy(&self) -> Result<&'static str, &'static str> {
        Ok(EASED_LEVEL)
    }

    fn omission(&self, _: &Actuator) -> Option<&'static str> {
        None
    }

    fn places(&self, robot: &Robot) -> Vec<AtJoint> {
        every_joint(robot)
    }

    fn columns(&self, AtJoint(j): AtJoint, motion: &RunMotion) -> Vec<EffectColumn> {
        let pairs = motion.load[j].iter().zip(&motion.direction[j]);
        vec![at_joint(j, pairs.map(|(load, s)| motion.gain[j] * load.abs() * s))]
    }

    fn prior(&self, _: AtJoint, _: &Robot, _: &Scale, priors: &Priors) -> Vec<f64> {
        vec![priors.load_friction_sd]
    }

    fn bounds(&self, AtJoint(j): AtJoint, robot: &Robot, _: &Priors) -> Vec<(f64, f64)> {
        down_to_zero(robot.links()[j].actuator.load_friction)
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
            link.actuator.load_friction += change;
        }
    }

    fn quantities(
        &self,
        AtJoint(j): AtJoint,
        nominal: &Robot,
        extended: &Robot,
    ) -> Vec<EffectQuantity> {
        vec![actuator_quantity(self.kind(), 0, j, [nominal, extended], |a| a.load_friction)]
    }
}
