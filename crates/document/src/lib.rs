//! TOML files that extend one another, read into a type, every mistake located in its file.
//!
//! ```text
//! error: unknown key `level`, did you mean `level_nm`?
//!  --> friction.toml:6:39
//!   |
//! 6 | coulomb_friction = { joint = "elbow", level = 0.6 }
//!   |                                       ^^^^^ effect.1.coulomb_friction.level
//!   |
//!   = help: expected `joint` or `level_nm`
//! ```
//!
//! A [`Document`] is read from files, changed by `--set`, and parsed into a type of the
//! reader's own; every value of it remembers where it was written.

mod deserialize;
mod document;
mod error;
mod fault;
mod key_path;
#[cfg(test)]
mod mistakes;
mod names;
mod node;
mod parse_key_path;
mod read;
mod set;
mod source;

pub use document::Document;
pub use error::{Coloring, DocumentError};
pub use key_path::{KeyPath, Segment};
pub use names::suggest;
pub use source::SourceSpan;
