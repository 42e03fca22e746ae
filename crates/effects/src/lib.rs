//! The model side of the effects: the columns that explain an effect in a log, the meaning of their weights, and the
//! place of the effect in the robot's description.
//!
//! ```text
//! effort - nominal effort = sum over hypotheses of columns(motion) weights + noise
//! ```
//!
//! The README of this crate says how an effect is added. `causes` has one file an effect, with the name of the effect
//! in `catalogue` (delay and lag are in `late_torque`). [`model`] returns the model of an effect, or the reason why
//! it has none. [`Compensation`] computes the feedforward efforts that compensate the effects of a robot's
//! description, and [`remedy`] says how each is compensated.

mod abilities;
mod any_effect;
mod bounds;
mod causes;
mod column;
mod compensation;
mod effect;
mod hypothesis;
mod model;
mod motion;
mod place;
mod priors;
mod quantity;
mod traits;
mod trial_shape;

pub use abilities::{
    BetweenEncoders, CanBeUnsound, CanHide, HasCadError, HasPlainer, HasShape, IsRare,
    IsRestricted, ShapedDrive,
};
pub use any_effect::AnyEffect;
pub use column::{ColumnPart, EffectColumn};
pub use compensation::feedforward::{Compensation, CompensationWorkspace, FeedforwardEfforts};
pub use compensation::left_out::omissions;
pub use effect::Effect;
pub use hypothesis::{Hypothesis, hypotheses};
pub use model::{MODELLED, model, remedy};
pub use motion::drive::drive_torque;
pub use motion::encoders::Encoders;
pub use motion::frame::{Frame, TrialSpring};
pub use motion::run_motion::RunMotion;
pub use motion::scale::Scale;
pub use place::{AtBase, AtJoint, InLink, Place, TypedPlace};
pub use priors::Priors;
pub use quantity::EffectQuantity;
pub use traits::{Law, Linearity, Location, Relation, RevealedBy, Traits, Weights};
pub use trial_shape::{ShapedRobot, TrialShape, trial_shapes, without_unused_shapes};
