//! The format of MuJoCo.

pub(crate) mod joint;
pub(crate) mod names;
pub(crate) mod position;
pub(crate) mod write;
