//! A robot along the logs: what is measured and what the robot expects, low-passed alike and at one
//! rate, with what oscillates in the efforts and what is beyond a limit set aside.

pub(crate) mod along;
pub(crate) mod left_over;
pub(crate) mod limit;
pub(crate) mod log;
pub(crate) mod look;
pub(crate) mod rest;
pub(crate) mod tone;
