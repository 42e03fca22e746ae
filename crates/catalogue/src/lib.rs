//! The gap effects by name: what each is, its equation and parameters, and what
//! it is confused with. Words and units, no arithmetic.
//!
//! ```text
//! effort = torque_gain (M qdd + C qd + g + sum of effects) + torque_offset
//! ```
//!
//! `effects` holds the model side of every entry; a truth side may be injected
//! elsewhere under the same name.

mod entry;
mod kind;

pub use entry::{Entry, Parameter};
pub use kind::{EffectKind, UnknownEffect};
