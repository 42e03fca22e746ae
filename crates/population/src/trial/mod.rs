//! A simulated trial: drawn from a seed, made into files.

mod any;
mod background;
mod differences;
mod draw;
mod known;
mod make;
mod pilot;
mod seen;
mod spoilt;
mod step;

pub use any::make_any;
pub use make::make;
pub(crate) use make::write;
