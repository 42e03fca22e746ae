//! A motion tracked with each model fed forward: the runs, their files and their errors.

pub(crate) mod outputs;
pub(crate) mod predictions;
pub(crate) mod stream;
pub(crate) mod sweep;
pub(crate) mod track;
pub(crate) mod tracked_error;
pub(crate) mod tracked_run;
pub(crate) mod words;
