//! URDF: what differs written into the text of one, or a new one.

pub(crate) mod edit;
pub(crate) mod inertial;
pub(crate) mod joint_change;
pub(crate) mod tag;
pub(crate) mod write;
