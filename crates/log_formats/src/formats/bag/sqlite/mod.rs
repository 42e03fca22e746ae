//! Bags in SQLite databases, read without the SQLite library.

mod columns;
mod pages;
pub(crate) mod record;
pub(crate) mod sqlite_file;
pub(crate) mod table;
