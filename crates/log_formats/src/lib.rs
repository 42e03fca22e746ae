//! Columns of numbers in the log files of many programs.
//!
//! ```text
//! path -> open -> Opened -> column_names, load(Needed) -> Table
//! ```
//!
//! [`open`] identifies the kind of a file by its first bytes, independent of its name, and unpacks gzip and zstd. This
//! crate does not know the meaning of a column: the caller says which column is time and which columns it needs.
//!
//! A format is a folder in `src/formats` and a line in the list of `src/formats/mod.rs`. Its folder has one type that
//! implements `FileFormat` and one that implements [`Opened`].

mod arrays;
mod columns;
mod common;
mod content;
mod counted_rows;
mod file_format;
mod formats;
mod joined_files;
mod open;
mod packed;

pub use columns::Columns;
pub use common::damage::Damage;
pub use common::error::FormatError;
pub use common::excerpt::{Excerpt, ExcerptFilter, TimeScale};
pub use common::table::{Needed, Table};
pub use common::words::{columns, list, quote, suggestion};
pub use counted_rows::CountedRows;
pub use file_format::{Opened, Request};
pub use formats::lerobot::dataset::LerobotDataset;
pub use formats::parquet::nesting::check_parquet_nesting;
pub use joined_files::{files_of_run, is_there, name_of_run, path_of_run};
pub use open::{column_names, open};
