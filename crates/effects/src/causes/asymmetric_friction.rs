use catalogue::EffectKind;
use robot::{Actuator, Robot};

use crate::abilities::{HasPlainer, IsRestricted};
use crate::bounds::{down_to_zero, infinite_bounds};
use crate::column::{EffectColumn, at_joint};
use crate::effect::{EASED_LEVEL, Effect};
use crate::motion::frame::Frame;
use crate::motion::run_motion::RunMotion;
use crate::motion::scale::Scale;
use crate::place::{AtJoint, every_joint};
use crate::priors::Priors;
use crate::quantity::{EffectQuantity, actuator_quantity};
use crate::traits::{Imitable, Law, Linearity, Location, Relation, Traits, Weights};

/// `forward` for positive and `-backward` for negative velocity: two weights a joint, the change of the mean level and
/// half the change of the difference. A joint that turns has the mean of both in between.
pub(crate) struct AsymmetricFriction;

impl Effect for AsymmetricFriction {
    type At = AtJoint;

    fn kind(&self) -> EffectKind {
        EffectKind::AsymmetricFriction
    }

    fn traits(&self) -> Traits {
        const RELATIONS: &[Relation] = &[
            Relation::Together(&[EffectKind::CoulombFriction, EffectKind::TorqueOffset]),
            Relation::PlainerHere(EffectKind::CoulombFriction),
        ];
        Traits::new(
            Linearity::Exact,
            Imitable::No,
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
        vec![at_joint(j, motion.coulomb(j)), at_joint(j, motion.coulomb_skew(j))]
    }

    /// Levels as large as the effort itself.
    fn prior(&self, AtJoint(j): AtJoint, _: &Robot, scale: &Scale, _: &Priors) -> Vec<f64> {
        vec![scale.effort[j]; 2]
    }

    fn bounds(&self, AtJoint(j): AtJoint, robot: &Robot, _: &Priors) -> Vec<(f64, f64)> {
        let a = &robot.links()[j].actuator;
        [down_to_zero(a.coulomb_forward.min(a.coulomb_backward)), infinite_bounds(1)].concat()
    }

    fn extend(
        &self,
        AtJoint(j): AtJoint,
        robot: &mut Robot,
        weights: &[f64],
        _: &Frame,
        _: &Priors,
    ) {
        let [level, skew] = weights else { return };
        if let Some(link) = robot.link_mut(j) {
            link.actuator.coulomb_forward += level + skew;
            link.actuator.coulomb_backward += level - skew;
        }
    }

    fn quantities(
        &self,
        AtJoint(j): AtJoint,
        nominal: &Robot,
        extended: &Robot,
    ) -> Vec<EffectQuantity> {
        let robots = [nominal, extended];
        vec![
            actuator_quantity(self.kind(), 0, j, robots, |a| a.coulomb_forward),
            actuator_quantity(self.kind(), 1, j, robots, |a| a.coulomb_backward),
        ]
    }

    fn restriction(&self) -> Option<&dyn IsRestricted<AtJoint>> {
        Some(self)
    }

    fn plainer(&self) -> Option<&dyn HasPlainer<AtJoint>> {
        Some(self)
    }
}

impl IsRestricted<AtJoint> for AsymmetricFriction {
    /// A larger difference is attributed to an offset.
    fn admissible(
        &self,
        AtJoint(j): AtJoint,
        robot: &Robot,
        weights: &[f64],
        priors: &Priors,
    ) -> bool {
        let [level, skew] = weights else { return false };
        let a = &robot.links()[j].actuator;
        let (forward, backward) =
            (a.coulomb_forward + level + skew, a.coulomb_backward + level - skew);
        (forward - backward).abs() <= priors.asymmetry_limit * (forward + backward)
    }
}

impl HasPlainer<AtJoint> for AsymmetricFriction {
    /// Half the change of the difference; at zero both levels change alike.
    fn more_than_plain(
        &self,
        AtJoint(j): AtJoint,
        [nominal, extended]: [&Robot; 2],
        _: &Frame,
        _: &Priors,
    ) -> Vec<(usize, f64)> {
        let skew = |robot: &Robot| {
            let a = &robot.links()[j].actuator;
            0.5 * (a.coulomb_forward - a.coulomb_backward)
        };
        vec![(1, skew(extended) - skew(nominal))]
    }
}
