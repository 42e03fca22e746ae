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
use crate::traits::{Imitable, Law, Linearity, Location, Traits, Weights};

/// `level sign(qd)`: one weight a joint, the change of both Coulomb levels.
pub(crate) struct CoulombFriction;

impl Effect for CoulombFriction {
    type At = AtJoint;

    fn kind(&self) -> EffectKind {
        EffectKind::CoulombFriction
    }

    fn traits(&self) -> Traits {
        Traits::new(
            Linearity::Exact,
            Imitable::No,
            Law::Approximate,
            Location::Elsewhere,
            Weights::Direct,
            &[],
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
        vec![at_joint(j, motion.coulomb(j))]
    }

    /// A level as large as the effort itself.
    fn prior(&self, AtJoint(j): AtJoint, _: &Robot, scale: &Scale, _: &Priors) -> Vec<f64> {
        vec![scale.effort[j]]
    }

    fn bounds(&self, AtJoint(j): AtJoint, robot: &Robot, _: &Priors) -> Vec<(f64, f64)> {
        let a = &robot.links()[j].actuator;
        down_to_zero(a.coulomb_forward.min(a.coulomb_backward))
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
            link.actuator.coulomb_forward += change;
            link.actuator.coulomb_backward += change;
        }
    }

    fn quantities(
        &self,
        AtJoint(j): AtJoint,
        nominal: &Robot,
        extended: &Robot,
    ) -> Vec<EffectQuantity> {
        let level = |a: &robot::Actuator| 0.5 * (a.coulomb_forward + a.coulomb_backward);
        vec![actuator_quantity(self.kind(), 0, j, [nominal, extended], level)]
    }
}
