//! For every missed visible cause and every false finding of a campaign the first stage that loses it.

pub(crate) mod account_text;
pub(crate) mod account_work;
pub(crate) mod campaign_account;
pub(crate) mod false_finding;
pub(crate) mod loss_stage;
pub(crate) mod lost_name;
pub(crate) mod missed_cause;
pub(crate) mod oracle_noise;
pub(crate) mod trial_account;
