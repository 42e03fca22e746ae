use catalogue::{EffectKind, Parameter};
use robot::{Actuator, Robot};

use crate::column::Column;
use crate::motion::frame::Frame;
use crate::motion::run_motion::Motion;
use crate::motion::scale::Scale;
use crate::place::Place;
use crate::quantity::Quantity;
use crate::traits::Nature;

/// The model side of one effect.
///
/// Weights are changes from the nominal robot: all zero means the robot as described.
pub trait Explain: Sync {
    /// The effect.
    fn kind(&self) -> EffectKind;

    /// What is known of it before any log.
    fn nature(&self) -> Nature;

    /// Those of its parameters that it finds.
    fn parameters(&self) -> &'static [Parameter] {
        self.kind().entry().parameters
    }

    /// Where it could act in this robot.
    fn places(&self, robot: &Robot) -> Vec<Place>;

    /// Trial values of the parameter that its columns are not linear in, where the drive of
    /// `joint` has none yet.
    fn shapes(&self, joint: usize, robot: &Robot, scale: &Scale) -> Vec<f64> {
        let _ = (joint, robot, scale);
        Vec::new()
    }

    /// Gives the drive of `joint` the effect with one of its `shapes` and no size.
    fn sow(&self, joint: usize, drive: &mut Actuator, shape: f64) {
        let _ = (joint, drive, shape);
    }

    /// One column a weight, for the motion of one run.
    fn columns(&self, place: Place, motion: &Motion) -> Vec<Column>;

    /// What one unit of each weight adds to the position that the first encoder of a joint
    /// reports beyond that of the link (rad or m), where a second one shows the link: nothing
    /// where the effect is not between the two.
    fn twist(&self, place: Place, motion: &Motion) -> Vec<Column> {
        let _ = (place, motion);
        Vec::new()
    }

    /// Standard deviation of each weight before any data is seen.
    fn prior(&self, place: Place, robot: &Robot, scale: &Scale) -> Vec<f64>;

    /// Standard deviation of each weight of errors that are in every description and have no name; those of the
    /// prior where nothing is known of them.
    fn everyday(&self, place: Place, robot: &Robot) -> Option<Vec<f64>> {
        let _ = (place, robot);
        None
    }

    /// Log odds (nats) against an arm that has the effect there, beyond those against any effect.
    fn rarity(&self, place: Place, robot: &Robot) -> f64 {
        let _ = (place, robot);
        0.0
    }

    /// Lowest and highest physically possible value of each weight.
    fn bounds(&self, place: Place, robot: &Robot) -> Vec<(f64, f64)>;

    /// Whether the robot changed by `weights`, each within its bounds, is possible.
    fn admissible(&self, place: Place, robot: &Robot, weights: &[f64]) -> bool {
        let _ = (place, robot, weights);
        true
    }

    /// Whether the effect is possible in the robot that has it, all others included.
    fn is_sound(&self, place: Place, extended: &Robot) -> bool {
        let _ = (place, extended);
        true
    }

    /// The weights without a change of which it is a plainer effect of the same place, by index, and
    /// how far the second of the `robots`, nominal and extended, is from that; none where the effect is nothing more than its size.
    fn more_than_plain(
        &self,
        place: Place,
        robots: [&Robot; 2],
        frame: &Frame,
    ) -> Vec<(usize, f64)> {
        let _ = (place, robots, frame);
        Vec::new()
    }

    /// How many times larger than as `robot` has it the effect has to be for logs of `frame` to
    /// show it, in the shape in which they show it least.
    fn largest_unseen(&self, place: Place, robot: &Robot, frame: &Frame) -> f64 {
        let _ = (place, robot, frame);
        1.0
    }

    /// The robot changed by `weights`, whose columns were made in `frame`.
    fn extend(&self, place: Place, robot: &mut Robot, weights: &[f64], frame: &Frame);

    /// The parameters that a user reads, from the robot before and after.
    fn quantities(&self, place: Place, nominal: &Robot, extended: &Robot) -> Vec<Quantity>;
}
