//! The format of MuJoCo.

pub(crate) mod joint;
pub(crate) mod position;
pub(crate) mod write;
