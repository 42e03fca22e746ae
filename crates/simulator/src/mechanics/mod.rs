//! The moving arm on rapier: what it is built from, and the hooks by which effects act on it.

pub(crate) mod arm;
pub(crate) mod engine;
pub(crate) mod inject;
pub(crate) mod plant;
pub(crate) mod rapier;
pub(crate) mod step_order;
pub(crate) mod transmission;
pub(crate) mod tree;
