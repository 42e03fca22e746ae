//! What became of places that are known to be true, for whoever knows the truth: a benchmark. [`crate::diagnose`] never
//! comes here.

pub(crate) mod place_account;
pub(crate) mod place_test;
pub(crate) mod search_account;
pub(crate) mod truth_comparison;
