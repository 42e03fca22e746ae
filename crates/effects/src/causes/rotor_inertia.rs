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

/// `rotor_inertia qdd`: one weight a joint, the change of the rotor inertia.
pub(crate) struct RotorInertia;

impl Explain for RotorInertia {
    fn kind(&self) -> EffectKind {
        EffectKind::RotorInertia
    }

    fn nature(&self) -> Nature {
        Nature::new(Linearity::Exact, Law::Firm, Seat::Elsewhere, Weights::Direct, &[])
    }

    fn places(&self, robot: &Robot) -> Vec<Place> {
        every_joint(robot)
    }

    fn columns(&self, place: Place, motion: &Motion) -> Vec<Column> {
        let Place::Joint(j) = place else { return Vec::new() };
        vec![at_joint(j, motion.qdd[j].iter().map(|a| motion.gain[j] * a))]
    }

    /// A torque as large as the effort itself at the largest acceleration.
    fn prior(&self, place: Place, _: &Robot, scale: &Scale) -> Vec<f64> {
        let Place::Joint(j) = place else { return Vec::new() };
        vec![scale.effort_per(j, &scale.acceleration)]
    }

    fn bounds(&self, place: Place, robot: &Robot) -> Vec<(f64, f64)> {
        let Place::Joint(j) = place else { return Vec::new() };
        down_to_zero(robot.links()[j].actuator.rotor_inertia)
    }

    /// Whether a rotor is left: one that weighs nothing is what takes the place of another cause.
    fn is_sound(&self, place: Place, extended: &Robot) -> bool {
        let Place::Joint(j) = place else { return false };
        extended.links()[j].actuator.rotor_inertia > 0.0
    }

    fn extend(&self, place: Place, robot: &mut Robot, weights: &[f64], _: &Frame) {
        let (Place::Joint(j), [change]) = (place, weights) else { return };
        if let Some(link) = robot.link_mut(j) {
            link.actuator.rotor_inertia += change;
        }
    }

    fn quantities(&self, place: Place, nominal: &Robot, extended: &Robot) -> Vec<Quantity> {
        let Place::Joint(j) = place else { return Vec::new() };
        vec![actuator_quantity(self.kind(), 0, j, [nominal, extended], |a| a.rotor_inertia)]
    }
}
