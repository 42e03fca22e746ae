//! Universal Scene Description with the schemas of PhysX and Newton.

pub(crate) mod joint;
pub(crate) mod text;
pub(crate) mod write;
