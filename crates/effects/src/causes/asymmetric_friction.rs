use catalogue::EffectKind;
use robot::Robot;

use crate::bounds::{down_to_zero, unbounded};
use crate::column::{Column, at_joint};
use crate::effect::Explain;
use crate::motion::frame::Frame;
use crate::motion::run_motion::Motion;
use crate::motion::scale::Scale;
use crate::place::{Place, every_joint};
use crate::quantity::{Quantity, actuator_quantity};
use crate::traits::{Law, Linearity, Nature, Relation, Seat, Weights};

/// `forward` for positive and `-backward` for negative velocity: two weights a joint,
/// the change of the mean level and half the change of the difference.
pub(crate) struct AsymmetricFriction;

/// Largest believable difference of the two levels, as a share of their sum: one that is three times
/// the other.
const LARGEST_SKEW: f64 = 0.5;

impl Explain for AsymmetricFriction {
    fn kind(&self) -> EffectKind {
        EffectKind::AsymmetricFriction
    }

    fn nature(&self) -> Nature {
        const RELATIONS: &[Relation] = &[
            Relation::Together(&[EffectKind::CoulombFriction, EffectKind::TorqueOffset]),
            Relation::PlainerHere(EffectKind::CoulombFriction),
        ];
        Nature::new(Linearity::Exact, Law::Rough, Seat::Elsewhere, Weights::Direct, RELATIONS)
    }

    fn places(&self, robot: &Robot) -> Vec<Place> {
        every_joint(robot)
    }

    fn columns(&self, place: Place, motion: &Motion) -> Vec<Column> {
        let Place::Joint(j) = place else { return Vec::new() };
        let against = motion.coulomb(j).zip(&motion.direction[j]).map(|(c, s)| c * s.signum());
        vec![at_joint(j, motion.coulomb(j)), at_joint(j, against)]
    }

    /// Levels as large as the effort itself.
    fn prior(&self, place: Place, _: &Robot, scale: &Scale) -> Vec<f64> {
        let Place::Joint(j) = place else { return Vec::new() };
        vec![scale.effort[j]; 2]
    }

    fn bounds(&self, place: Place, robot: &Robot) -> Vec<(f64, f64)> {
        let Place::Joint(j) = place else { return Vec::new() };
        let a = &robot.links()[j].actuator;
        [down_to_zero(a.coulomb_forward.min(a.coulomb_backward)), unbounded(1)].concat()
    }

    /// A larger difference is that of an offset.
    fn admissible(&self, place: Place, robot: &Robot, weights: &[f64]) -> bool {
        let (Place::Joint(j), [level, skew]) = (place, weights) else { return false };
        let a = &robot.links()[j].actuator;
        let (forward, backward) =
            (a.coulomb_forward + level + skew, a.coulomb_backward + level - skew);
        (forward - backward).abs() <= LARGEST_SKEW * (forward + backward)
    }

    /// Half the change of the difference: without it both levels have changed alike.
    fn more_than_plain(
        &self,
        place: Place,
        [nominal, extended]: [&Robot; 2],
        _: &Frame,
    ) -> Vec<(usize, f64)> {
        let Place::Joint(j) = place else { return Vec::new() };
        let skew = |robot: &Robot| {
            let a = &robot.links()[j].actuator;
            0.5 * (a.coulomb_forward - a.coulomb_backward)
        };
        vec![(1, skew(extended) - skew(nominal))]
    }

    fn extend(&self, place: Place, robot: &mut Robot, weights: &[f64], _: &Frame) {
        let (Place::Joint(j), [level, skew]) = (place, weights) else { return };
        if let Some(link) = robot.link_mut(j) {
            link.actuator.coulomb_forward += level + skew;
            link.actuator.coulomb_backward += level - skew;
        }
    }

    fn quantities(&self, place: Place, nominal: &Robot, extended: &Robot) -> Vec<Quantity> {
        let Place::Joint(j) = place else { return Vec::new() };
        let robots = [nominal, extended];
        vec![
            actuator_quantity(self.kind(), 0, j, robots, |a| a.coulomb_forward),
            actuator_quantity(self.kind(), 1, j, robots, |a| a.coulomb_backward),
        ]
    }
}
