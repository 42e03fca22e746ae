//! The model side of the effects: the columns that explain it in a log, what its
//! weights mean, and its place in the robot's description.
//!
//! ```text
//! effort - nominal effort = sum over hypotheses of columns(motion) weights + noise
//! ```
//!
//! The README of this crate says how an effect is added. One file an effect, under the name it has in `catalogue` (delay and lag are `late_torque`);
//! [`model`] finds it, or says what an effect without one would need. [`Compensation`] asks the
//! motors for what undoes the effects that a robot's description holds, and [`remedy`] says
//! which those are.

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
    BetweenEncoders, CanBeUnsound, CanHide, HasCadError, HasPlainer, HasShape, IsRare, IsRestricted,
};
pub use any_effect::AnyEffect;
pub use column::{Column, Part};
pub use compensation::feedforward::{Compensated, Compensation, CompensationWorkspace};
pub use compensation::left_out::left_out;
pub use effect::Effect;
pub use hypothesis::{Hypothesis, hypotheses};
pub use model::{MODELLED, model, remedy};
pub use motion::drive::drive_torque;
pub use motion::encoders::Encoders;
pub use motion::frame::Frame;
pub use motion::run_motion::Motion;
pub use motion::scale::Scale;
pub use place::{AtBase, AtJoint, InLink, Place, TypedPlace};
pub use priors::Priors;
pub use quantity::Quantity;
pub use traits::{Law, Linearity, Nature, Relation, Seat, Shows, Weights};
pub use trial_shape::{Germ, germs, weeded};
