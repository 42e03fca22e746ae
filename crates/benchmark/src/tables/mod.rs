//! Results of the trials of a campaign, in tables.

pub(crate) mod kind_row;
pub(crate) mod merged_panel;
pub(crate) mod panel_row;
pub(crate) mod panel_tally;
pub(crate) mod panel_text;
pub(crate) mod size_tally;
pub(crate) mod slow_diagnosis;
pub(crate) mod spoiling_row;
pub(crate) mod stranger_row;
