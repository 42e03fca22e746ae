//! Files: JSON, hashes, provenance, and folders written whole.

pub(crate) mod error;
pub(crate) mod files;
pub(crate) mod json;
pub(crate) mod provenance;
pub(crate) mod schema;
