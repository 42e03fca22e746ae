//! Columns of numbers in the files that programs log to.
//!
//! ```text
//! path -> open -> Opened -> column_names, load(Needed) -> Table
//! ```
//!
//! [`open`] tells the kind of a file by its first bytes, whatever its name, and unpacks gzip and zstd. What a
//! column means is not known here: the caller says which column is time and which ones it needs.
//!
//! A format is a folder in `src/formats`, with a type that implements `FileFormat` and one that implements [`Opened`],
//! and a line in the list of `src/formats/mod.rs`.

mod arrays;
mod columns;
mod common;
mod content;
mod file_format;
mod formats;
mod open;
mod packed;

pub use columns::Columns;
pub use common::damage::Damage;
pub use common::error::FormatError;
pub use common::excerpt::{Excerpt, ExcerptFilter, TimeScale};
pub use common::table::{Needed, Table};
pub use common::words::{list, suggestion};
pub use file_format::{Opened, Request};
pub use formats::lerobot::dataset::LerobotDataset;
pub use open::{column_names, open};
