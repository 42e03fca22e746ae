//! Scores of a diagnosis: whether it names the injected effects, and how near their sizes it comes.

pub(crate) mod blinded;
pub(crate) mod score;
pub(crate) mod size;
pub(crate) mod smallest;
pub mod stored;
