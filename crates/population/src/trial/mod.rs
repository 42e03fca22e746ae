//! A simulated trial: drawn from a seed, made into files.

pub(crate) mod again;
pub(crate) mod any;
pub(crate) mod background;
pub(crate) mod differences;
pub(crate) mod draw;
pub(crate) mod field;
pub(crate) mod known;
pub(crate) mod log_draw;
pub(crate) mod make;
pub(crate) mod pilot;
pub(crate) mod seen;
pub(crate) mod servo;
pub(crate) mod spoilt;
pub(crate) mod step;
pub(crate) mod workshop;
