//! A ledger of false alarms: what was said of logs in which nothing is wrong, corner by corner.

pub(crate) mod alarm;
pub(crate) mod alarm_ledger;
pub(crate) mod alarm_row;
pub(crate) mod alarm_text;
pub(crate) mod false_name;
pub(crate) mod log_property;
