//! Results of the trials of a campaign, in tables.

pub(crate) mod confusion;
pub(crate) mod gained;
pub(crate) mod kind_row;
pub(crate) mod merged;
pub(crate) mod merged_panel;
pub(crate) mod panel_row;
pub(crate) mod panel_tally;
pub(crate) mod panel_text;
pub(crate) mod power;
pub(crate) mod slow_diagnosis;
pub(crate) mod stranger_row;
pub(crate) mod tally;
pub(crate) mod tally_text;
