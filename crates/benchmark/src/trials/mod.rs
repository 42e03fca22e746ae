//! Campaigns of blind trials: planning, making and storing them.

pub(crate) mod campaign;
pub(crate) mod campaign_folder;
pub(crate) mod failure;
pub(crate) mod hash;
pub(crate) mod hidden;
pub(crate) mod kind_count;
pub(crate) mod part;
pub(crate) mod record;
pub(crate) mod record_columns;
pub(crate) mod record_table;
pub(crate) mod scenario_campaign;
pub(crate) mod scenario_sheet;
pub(crate) mod trial;
pub(crate) mod trial_lock;
pub(crate) mod work;
