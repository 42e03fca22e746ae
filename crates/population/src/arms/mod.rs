//! Arms drawn from a seed: bodies, drives and electronics, and the nominal model that a user has of them.

pub(crate) mod arm;
pub(crate) mod bodies;
pub(crate) mod chain;
pub(crate) mod draw;
pub(crate) mod drives;
pub(crate) mod electronics;
pub(crate) mod generated;
pub(crate) mod make;
pub(crate) mod urdf_text;
pub(crate) mod wam;
