//! What a robot is: links, joints, inertias, actuators, what it looks like, and which of its joints are locked.

pub(crate) mod actuator;
pub(crate) mod control;
pub(crate) mod inertia;
pub(crate) mod joint;
pub(crate) mod link;
pub(crate) mod locked_joint;
pub(crate) mod looks;
pub(crate) mod lumping;
pub(crate) mod moving_body;
pub(crate) mod part;
pub(crate) mod relock;
pub(crate) mod robot;
pub(crate) mod wide_inertia;
