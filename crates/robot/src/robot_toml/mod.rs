//! `robot.toml`: its keys, how they are put into a robot, and how they are written.

pub(crate) mod description;
pub(crate) mod file;
pub(crate) mod joint_entry;
pub(crate) mod schema;
pub(crate) mod write;
