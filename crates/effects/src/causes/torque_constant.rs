use catalogue::EffectKind;
use robot::{Actuator, Robot};

use crate::abilities::IsRestricted;
use crate::column::{EffectColumn, at_joint};
use crate::effect::Effect;
use crate::motion::frame::Frame;
use crate::motion::run_motion::RunMotion;
use crate::motion::scale::Scale;
use crate::place::{AtJoint, every_joint};
use crate::priors::Priors;
use crate::quantity::{EffectQuantity, actuator_quantity};
use crate::traits::{Imitable, Law, Linearity, Location, Traits, Weights};

/// `torque_gain tau`: one weight a joint, the change of the gain.
///
/// The column is the torque of the nominal robot: `d effort / d gain = torque`. It is linear in the gain only about
/// that robot.
pub(crate) struct TorqueConstant;

impl Effect for TorqueConstant {
    type At = AtJoint;

    fn kind(&self) -> EffectKind {
        EffectKind::TorqueConstant
    }

    fn traits(&self) -> Traits {
        Traits::new(
            Linearity::Tangent,
            Imitable::No,
            Law::Exact,
            Location::Elsewhere,
            Weights::Direct,
            &[],
        )
    }

    fn remedy(&self) -> Result<&'static str, &'static str> {
        Ok("asking for as much more or less")
    }

    fn omission(&self, _: &Actuator) -> Option<&'static str> {
        None
    }

    fn places(&self, robot: &Robot) -> Vec<AtJoint> {
        every_joint(robot)
    }

    fn columns(&self, AtJoint(j): AtJoint, motion: &RunMotion) -> Vec<EffectColumn> {
        vec![at_joint(j, motion.torque[j].iter().map(|t| motion.drives[j].transmission_ratio * t))]
    }

    fn prior(&self, _: AtJoint, _: &Robot, _: &Scale, priors: &Priors) -> Vec<f64> {
        vec![priors.torque_gain_sd]
    }

    fn bounds(&self, AtJoint(j): AtJoint, robot: &Robot, priors: &Priors) -> Vec<(f64, f64)> {
        let largest = priors.torque_gain_limit * robot.links()[j].actuator.torque_gain;
        vec![(-largest, largest)]
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
            link.actuator.torque_gain += change;
        }
    }

    fn quantities(
        &self,
        AtJoint(j): AtJoint,
        nominal: &Robot,
        extended: &Robot,
    ) -> Vec<EffectQuantity> {
        vec![actuator_quantity(self.kind(), 0, j, [nominal, extended], |a| a.torque_gain)]
    }

    fn restriction(&self) -> Option<&dyn IsRestricted<AtJoint>> {
        Some(self)
    }
}

impl IsRestricted<AtJoint> for TorqueConstant {
    /// A gain at its limit is rejected.
    fn admissible(
        &self,
        AtJoint(j): AtJoint,
        robot: &Robot,
        weights: &[f64],
        priors: &Priors,
    ) -> bool {
        let [change] = weights else { return false };
        change.abs()
            < (1.0 - 1e-9) * priors.torque_gain_limit * robot.links()[j].actuator.torque_gain
    }
}
