use catalogue::EffectKind;
use robot::{Actuator, Robot};

use crate::abilities::CanBeUnsound;
use crate::bounds::down_to_zero;
use crate::column::{EffectColumn, at_joint};
use crate::effect::Effect;
use crate::motion::frame::Frame;
use crate::motion::run_motion::RunMotion;
use crate::motion::scale::Scale;
use crate::place::{AtJoint, every_joint};
use crate::priors::Priors;
use crate::quantity::{EffectQuantity, actuator_quantity};
use crate::traits::{Imitable, Law, Linearity, Location, Traits, Weights};

/// `rotor_inertia qdd`: one weight a joint, the change of the rotor inertia.
pub(crate) struct RotorInertia;

impl Effect for RotorInertia {
    type At = AtJoint;

    fn kind(&self) -> EffectKind {
        EffectKind::RotorInertia
    }

    fn traits(&self) -> Traits {
        Traits::new(
            Linearity::Exact,
            Imitable::No,
            Law::Exact,
            Location::Elsewhere,
            Weights::Direct,
            &[],
        )
    }

    fn remedy(&self) -> Result<&'static str, &'static str> {
        Ok("its torque at the acceleration of the motor")
    }

    fn omission(&self, _: &Actuator) -> Option<&'static str> {
        None
    }

    fn places(&self, robot: &Robot) -> Vec<AtJoint> {
        every_joint(robot)
    }

    fn columns(&self, AtJoint(j): AtJoint, motion: &RunMotion) -> Vec<EffectColumn> {
        vec![at_joint(j, motion.qdd[j].iter().map(|a| motion.gain[j] * a))]
    }

    /// A torque as large as the effort itself at the largest acceleration.
    fn prior(&self, AtJoint(j): AtJoint, _: &Robot, scale: &Scale, _: &Priors) -> Vec<f64> {
        vec![scale.effort_per(j, &scale.acceleration)]
    }

    fn bounds(&self, AtJoint(j): AtJoint, robot: &Robot, _: &Priors) -> Vec<(f64, f64)> {
        down_to_zero(robot.links()[j].actuator.rotor_inertia)
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
            link.actuator.rotor_inertia += change;
        }
    }

    fn quantities(
        &self,
        AtJoint(j): AtJoint,
        nominal: &Robot,
        extended: &Robot,
    ) -> Vec<EffectQuantity> {
        vec![actuator_quantity(self.kind(), 0, j, [nominal, extended], |a| a.rotor_inertia)]
    }

    fn can_be_unsound(&self) -> Option<&dyn CanBeUnsound<AtJoint>> {
        Some(self)
    }
}

impl CanBeUnsound<AtJoint> for RotorInertia {
    /// Whether the rotor inertia is above zero. A fit that removes all of it imitates another cause.
    fn is_sound(&self, AtJoint(j): AtJoint, extended: &Robot, _: &Priors) -> bool {
        extended.links()[j].actuator.rotor_inertia > 0.0
    }
}
