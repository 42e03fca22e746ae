//! What robots in use have and the ordinary draws of a trial lack: wrong descriptions, strong friction, late drives,
//! exchanged joints, tilted bases, tools taken off and payloads that change.

pub(crate) mod delay;
pub(crate) mod faults;
pub(crate) mod friction;
pub(crate) mod inertial;
pub(crate) mod misread;
pub(crate) mod mount;
pub(crate) mod payload;
pub(crate) mod tool;
pub(crate) mod wrong_urdf;
