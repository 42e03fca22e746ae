//! How well a diagnosis names what was put in, and how near its sizes are.

pub(crate) mod blinded;
pub(crate) mod score;
pub(crate) mod size;
pub(crate) mod smallest;
pub mod stored;
