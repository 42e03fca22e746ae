//! A simulated arm beside the measured one: its drift, and recordings of both.

pub(crate) mod forward_gap;
pub(crate) mod record_diagnosis;
pub(crate) mod replayed;
