use catalogue::EffectKind;
use robot::Robot;

use crate::bounds::down_to_zero;
use crate::column::{Column, at_joint};
use crate::effect::Explain;
use crate::motion::frame::Frame;
use crate::motion::run_motion::Motion;
use crate::motion::scale::Scale;
use crate::place::{Place, every_joint};
use crate::quantity::{Quantity, actuator_quantity};
use crate::traits::{Law, Linearity, Nature, Seat, Weights};

/// `level sign(qd)`: one weight a joint, the change of both Coulomb levels.
pub(crate) struct CoulombFriction;

impl Explain for CoulombFriction {
    fn kind(&self) -> EffectKind {
        EffectKind::CoulombFriction
    }

    fn nature(&self) -> Nature {
        Nature::new(Linearity::Exact, Law::Rough, Seat::Elsewhere, Weights::Direct, &[])
    }

    fn places(&self, robot: &Robot) -> Vec<Place> {
        every_joint(robot)
    }

    fn columns(&self, place: Place, motion: &Motion) -> Vec<Column> {
        let Place::Joint(j) = place else { return Vec::new() };
        vec![at_joint(j, motion.coulomb(j))]
    }

    /// A level as large as the effort itself.
    fn prior(&self, place: Place, _: &Robot, scale: &Scale) -> Vec<f64> {
        let Place::Joint(j) = place else { return Vec::new() };
        vec![scale.effort[j]]
    }

    fn bounds(&self, place: Place, robot: &Robot) -> Vec<(f64, f64)> {
        let Place::Joint(j) = place else { return Vec::new() };
        let a = &robot.links()[j].actuator;
        down_to_zero(a.coulomb_forward.min(a.coulomb_backward))
    }

    fn extend(&self, place: Place, robot: &mut Robot, weights: &[f64], _: &Frame) {
        let (Place::Joint(j), [change]) = (place, weights) else { return };
        if let Some(link) = robot.link_mut(j) {
            link.actuator.coulomb_forward += change;
            link.actuator.coulomb_backward += change;
        }
    }

    fn quantities(&self, place: Place, nominal: &Robot, extended: &Robot) -> Vec<Quantity> {
        let Place::Joint(j) = place else { return Vec::new() };
        let level = |a: &robot::Actuator| 0.5 * (a.coulomb_forward + a.coulomb_backward);
        vec![actuator_quantity(self.kind(), 0, j, [nominal, extended], level)]
    }
}
