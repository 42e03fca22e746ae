//! Shared by all formats: limits, damage, errors, tables and numbers.

pub(crate) mod allowance;
pub(crate) mod bounds;
pub(crate) mod damage;
pub(crate) mod dates;
pub(crate) mod error;
pub(crate) mod excerpt;
pub(crate) mod guard;
pub(crate) mod numeral;
pub(crate) mod sha256;
pub(crate) mod table;
pub(crate) mod unread_kinds;
pub(crate) mod words;
