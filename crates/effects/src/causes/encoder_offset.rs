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

/// `tau(q - offset) - tau(q)`: one weight a joint, the change of the offset (rad or m).
///
/// The column is the slope of the torque of every joint by the position of this one.
pub(crate) struct EncoderOffset;

/// Standard deviation of an offset before any data (rad or m): a scribed zero is good to a few
/// hundredths.
const OFFSET_SD: f64 = 0.05;

impl Explain for EncoderOffset {
    fn kind(&self) -> EffectKind {
        EffectKind::EncoderOffset
    }

    fn nature(&self) -> Nature {
        Nature::new(Linearity::Doubtful, Law::Firm, Seat::BeforeTheLink, Weights::Direct, &[])
    }

    fn places(&self, robot: &Robot) -> Vec<Place> {
        every_joint(robot)
    }

    fn columns(&self, place: Place, motion: &Motion) -> Vec<Column> {
        let Place::Joint(j) = place else { return Vec::new() };
        let moved = vec![-motion.drives[j].transmission_ratio; motion.samples()];
        let still = vec![0.0; motion.samples()];
        vec![motion.displaced(j, [&moved, &still, &still])]
    }

    fn twist(&self, place: Place, motion: &Motion) -> Vec<Column> {
        let Place::Joint(j) = place else { return Vec::new() };
        vec![at_joint(j, motion.q[j].iter().map(|_| 1.0))]
    }

    fn prior(&self, _: Place, _: &Robot, _: &Scale) -> Vec<f64> {
        vec![OFFSET_SD]
    }

    fn bounds(&self, _: Place, _: &Robot) -> Vec<(f64, f64)> {
        unbounded(1)
    }

    fn extend(&self, place: Place, robot: &mut Robot, weights: &[f64], _: &Frame) {
        let (Place::Joint(j), [change]) = (place, weights) else { return };
        if let Some(link) = robot.link_mut(j) {
            link.actuator.encoder_offset += change;
        }
    }

    fn quantities(&self, place: Place, nominal: &Robot, extended: &Robot) -> Vec<Quantity> {
        let Place::Joint(j) = place else { return Vec::new() };
        vec![actuator_quantity(self.kind(), 0, j, [nominal, extended], |a| a.encoder_offset)]
    }
}
