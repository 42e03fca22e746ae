//! The gap effects by name: what each is, its equation and parameters, and what
//! it is confused with. Words and units, no arithmetic.
//!
//! ```text
//! effort = torque_gain (M qdd + C qd + g + sum of effects) + torque_offset
//! ```
//!
//! `q` and `effort` are what a log reports. An equation says what its effect adds to the
//! right side, for a log whose effort is what was asked of the drive; `tau` in it is the
//! torque of everything else. What resists a positive motion is positive.
//!
//! `effects` holds the model side of an entry; a truth side may be injected
//! elsewhere under the same name.

mod drive;
mod effect_list;
mod entries;
mod entry;
mod environment;
mod family;
mod friction;
mod inertia;
mod kind;
mod sensing;
mod transmission;

pub use entry::{Entry, Parameter};
pub use family::Family;
pub use kind::{EffectKind, UnknownEffect};
