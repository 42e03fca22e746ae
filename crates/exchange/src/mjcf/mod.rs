//! The format of MuJoCo.

pub(crate) mod joint;
pub(crate) mod write;
