//! How the answer changes as logs are spoilt more and more.

pub(crate) mod answer;
pub(crate) mod curves;
pub(crate) mod outcome;
pub(crate) mod text;
pub(crate) mod told;
