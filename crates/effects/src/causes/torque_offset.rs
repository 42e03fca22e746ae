use catalogue::EffectKind;
use robot::Robot;

use crate::bounds::unbounded;
use crate::column::{Column, at_joint};
use crate::effect::Explain;
use crate::motion::frame::Frame;
use crate::motion::run_motion::Motion;
use crate::motion::scale::Scale;
use crate::place::{Place, every_joint};
use crate::quantity::{Quantity, actuator_quantity};
use crate::traits::{Law, Linearity, Nature, Seat, Weights};

/// `offset`: one weight a joint, the change of the effort reported at zero torque.
pub(crate) struct TorqueOffset;

impl Explain for TorqueOffset {
    fn kind(&self) -> EffectKind {
        EffectKind::TorqueOffset
    }

    fn nature(&self) -> Nature {
        Nature::new(Linearity::Exact, Law::Firm, Seat::Elsewhere, Weights::Direct, &[])
    }

    fn places(&self, robot: &Robot) -> Vec<Place> {
        every_joint(robot)
    }

    fn columns(&self, place: Place, motion: &Motion) -> Vec<Column> {
        let Place::Joint(j) = place else { return Vec::new() };
        vec![at_joint(j, (0..motion.samples()).map(|_| 1.0))]
    }

    /// An offset as large as the effort itself.
    fn prior(&self, place: Place, _: &Robot, scale: &Scale) -> Vec<f64> {
        let Place::Joint(j) = place else { return Vec::new() };
        vec![scale.effort[j]]
    }

    fn bounds(&self, _: Place, _: &Robot) -> Vec<(f64, f64)> {
        unbounded(1)
    }

    fn extend(&self, place: Place, robot: &mut Robot, weights: &[f64], _: &Frame) {
        let (Place::Joint(j), [change]) = (place, weights) else { return };
        if let Some(link) = robot.link_mut(j) {
            link.actuator.torque_offset += change;
        }
    }

    fn quantities(&self, place: Place, nominal: &Robot, extended: &Robot) -> Vec<Quantity> {
        let Place::Joint(j) = place else { return Vec::new() };
        vec![actuator_quantity(self.kind(), 0, j, [nominal, extended], |a| a.torque_offset)]
    }
}
