use std::path::Path;

use crate::{
    common::{damage::Damage, error::FormatError, unread_kinds::NOT_A_BAG},
    content::{Formats, Kind},
    file_format::{Opened, Request},
    formats::bag::{bag_file::Bag, folder_files::files_of, storage::STORAGES},
};

/// Opens the folder of a bag.
pub(crate) fn open_folder(
    path: &Path,
    request: &Request,
    formats: &Formats,
    damage: &mut Damage,
) -> Result<Box<dyn Opened>, FormatError> {
    let mut files = Vec::new();
    for path in files_of(path)? {
        let (kind, file) = formats.content(&path)?;
        let storage = match kind {
            Kind::Read(format) => STORAGES.into_iter().find(|s| s.name == format.name()),
            Kind::Packed(_) => None,
        };
        let storage = storage.ok_or_else(|| FormatError::other_kind(&path, NOT_A_BAG))?;
        files.push((path, storage, file));
    }
    Ok(Box::new(Bag::open(path, &files, request.topic, damage)?))
}
