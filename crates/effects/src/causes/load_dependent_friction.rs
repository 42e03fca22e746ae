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
use crate::traits::{Law, Linearity, Nature, Relation, Seat, Weights};

/// `coefficient |load| sign(qd)`: one weight a joint, the change of the coefficient.
pub(crate) struct LoadDependentFriction;

/// Standard deviation of a coefficient before any data.
const COEFFICIENT_SD: f64 = 0.2;

impl Explain for LoadDependentFriction {
    fn kind(&self) -> EffectKind {
        EffectKind::LoadDependentFriction
    }

    fn nature(&self) -> Nature {
        const RELATIONS: &[Relation] = &[Relation::PlainerHere(EffectKind::CoulombFriction)];
        Nature::new(Linearity::Doubtful, Law::Rough, Seat::Elsewhere, Weights::Direct, RELATIONS)
    }

    fn places(&self, robot: &Robot) -> Vec<Place> {
        every_joint(robot)
    }

    fn columns(&self, place: Place, motion: &Motion) -> Vec<Column> {
        let Place::Joint(j) = place else { return Vec::new() };
        let pairs = motion.load[j].iter().zip(&motion.direction[j]);
        vec![at_joint(j, pairs.map(|(load, s)| motion.gain[j] * load.abs() * s))]
    }

    fn prior(&self, _: Place, _: &Robot, _: &Scale) -> Vec<f64> {
        vec![COEFFICIENT_SD]
    }

    fn bounds(&self, place: Place, robot: &Robot) -> Vec<(f64, f64)> {
        let Place::Joint(j) = place else { return Vec::new() };
        down_to_zero(robot.links()[j].actuator.load_friction)
    }

    fn extend(&self, place: Place, robot: &mut Robot, weights: &[f64], _: &Frame) {
        let (Place::Joint(j), [change]) = (place, weights) else { return };
        if let Some(link) = robot.link_mut(j) {
            link.actuator.load_friction += change;
        }
    }

    fn quantities(&self, place: Place, nominal: &Robot, extended: &Robot) -> Vec<Quantity> {
        let Place::Joint(j) = place else { return Vec::new() };
        vec![actuator_quantity(self.kind(), 0, j, [nominal, extended], |a| a.load_friction)]
    }
}
