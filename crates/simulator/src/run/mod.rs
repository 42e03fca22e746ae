//! From a scenario to logs: the controller that follows its motions, hidden effects, what is written.

pub(crate) mod arm_state;
pub(crate) mod effect_sizer;
pub(crate) mod follow;
pub(crate) mod goals;
pub(crate) mod hidden;
pub(crate) mod laws;
pub(crate) mod log;
pub(crate) mod simulate;
pub(crate) mod true_run;
pub(crate) mod write;
