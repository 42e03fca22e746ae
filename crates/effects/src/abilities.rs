//! Abilities of some effects beyond an [`Effect`](crate::effect::Effect), one trait each. `P` is the kind of place of
//! the effect.

use robot::{Actuator, Robot};

use crate::column::EffectColumn;
use crate::motion::frame::Frame;
use crate::motion::run_motion::RunMotion;
use crate::motion::scale::Scale;
use crate::place::AtJoint;
use crate::priors::Priors;

/// What may hold the shape of an effect at a joint.
#[derive(Debug)]
pub struct ShapedDrive<'a> {
    /// The drive of the joint.
    pub drive: &'a mut Actuator,
    /// Its trial gap (rad or m): a drive has no place for a gap of size zero.
    pub trial_gap: &'a mut f64,
}

/// Its columns are not linear in one parameter, the shape. Some trial values of the shape are compared.
pub trait HasShape {
    /// Trial values for the drive of a joint; empty where the drive has a value already.
    fn shapes(&self, at: AtJoint, robot: &Robot, scale: &Scale, priors: &Priors) -> Vec<f64>;

    /// Gives the drive of `joint` the effect with one of its `shapes` and no size.
    fn set_shape(&self, joint: usize, shaped: ShapedDrive<'_>, shape: f64);

    /// Resets the shape to that of the drive `before`, where the effect has kept size zero.
    fn drop_unused_shape(&self, drive: &mut Actuator, before: &Actuator);
}

/// It lies between the first encoder of a joint and the link, so that a second encoder at the link shows it.
pub trait BetweenEncoders {
    /// Change of the position that the first encoder reports, relative to that of the link, per unit of each weight
    /// (rad or m).
    fn twist(&self, at: AtJoint, motion: &RunMotion) -> Vec<EffectColumn>;
}

/// Descriptions made by CAD are usually wrong by a known amount.
pub trait HasCadError<P> {
    /// Standard deviation of each weight due to the errors that every description has.
    fn cad_error_sd(&self, at: P, robot: &Robot, priors: &Priors) -> Vec<f64>;
}

/// Few arms have it.
pub trait IsRare<P> {
    /// Log odds (nats) against the effect at this place, in addition to those against any effect.
    fn prior_log_odds_against(&self, at: P, robot: &Robot, priors: &Priors) -> f64;
}

/// Weights within their bounds may still be impossible together.
pub trait IsRestricted<P> {
    /// Whether the robot changed by `weights`, each within its bounds, is possible.
    fn admissible(&self, at: P, robot: &Robot, weights: &[f64], priors: &Priors) -> bool;
}

/// Only the extended robot shows whether it is possible.
pub trait CanBeUnsound<P> {
    /// Whether the effect is possible in the robot that has it together with all other effects.
    fn is_sound(&self, at: P, extended: &Robot, priors: &Priors) -> bool;
}

/// A simpler effect of the same place is a special case of it.
pub trait HasPlainer<P> {
    /// Indices of the weights that reduce it to a simpler effect at zero, each with its value in the second of the
    /// `robots`, nominal and extended.
    fn more_than_plain(
        &self,
        at: P,
        robots: [&Robot; 2],
        frame: &Frame,
        priors: &Priors,
    ) -> Vec<(usize, f64)>;
}

/// Logs may show one shape of it and hide another.
pub trait CanHide<P> {
    /// Factor by which the effect must be larger than in `robot` for logs of `frame` to show it, in the shape that
    /// they show least.
    fn largest_unseen(&self, at: P, robot: &Robot, frame: &Frame, priors: &Priors) -> f64;
}
