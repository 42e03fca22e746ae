//! The gap effects by name: what each is, its equation and parameters, and what
//! it is confused with. Words and units, no arithmetic.
//!
//! ```text
//! effort = torque_gain (M qdd + C qd + g + sum of effects) + torque_offset
//! ```
//!
//! `q` and `effort` are the values in a log. The equation of an effect is the term that it adds to
//! the right side, for a log of commanded efforts; `tau` in it is the torque of everything else. A
//! torque that resists positive motion is positive.
//!
//! The model side of an effect is in `effects`, the truth side is elsewhere under the same name.

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

pub use entry::{EffectEntry, Parameter};
pub use family::Family;
pub use kind::{EffectKind, UnknownEffect};
