use std::{fs::File, path::Path};

use crate::{
    common::{damage::Damage, error::FormatError},
    file_format::Magic,
    formats::bag::{mcap::mcap_file, sqlite::sqlite_file, topic::MessageSink},
};

/// Storage format of the messages of a bag.
#[derive(Clone, Copy)]
pub(crate) struct Storage {
    /// Name of the format in errors.
    pub name: &'static str,
    pub magic: &'static [Magic],
    /// Reads the messages of a file.
    pub read: fn(&Path, &File, &mut dyn MessageSink, &mut Damage) -> Result<(), FormatError>,
}

pub(crate) const STORAGES: [Storage; 2] = [MCAP, SQLITE];

pub(crate) const MCAP: Storage =
    Storage { name: mcap_file::NAME, magic: &[(0, b"\x89MCAP0\r\n")], read: mcap_file::read };

pub(crate) const SQLITE: Storage = Storage {
    name: sqlite_file::NAME,
    magic: &[(0, b"SQLite format 3\0")],
    read: sqlite_file::read,
};
