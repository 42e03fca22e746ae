//! What a curve is, and its colour: the same in reports, figures and recordings.
//!
//! ```text
//! Role { Measured, Nominal, Extended, Desired, Error } -> Colour { on_white, on_dark }
//! model(index)                                         -> Colour, of models side by side
//! ```
//!
//! The hues of nominal, extended, desired and error are those of vermillion, blue, reddish purple
//! and bluish green of Okabe & Ito (2008), made for eyes without one of the
//! three cones; vermillion and green are darker on white, so that numbers in them can be read there.
//! The tests of this crate measure how far apart all of them are for each kind of eye, with the
//! matrices of Machado et al. (2009).

mod colour;
mod role;
#[cfg(test)]
mod vision;

pub use colour::{Colour, Rgb};
pub use role::{MODELS, Role, model};
