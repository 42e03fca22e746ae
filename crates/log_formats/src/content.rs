use std::{fs::File, io::Read, path::Path};

use crate::{
    common::{
        error::FormatError,
        unread_kinds::{UNKNOWN, is_text, unread_kind},
    },
    file_format::{FileFormat, Magic},
    packed::unpack::{Packing, unpack},
};

/// Number of first bytes that identify the kind of a file.
const FIRST_BYTES: usize = 4096;

/// The supported kinds of file.
pub(crate) struct Formats {
    /// Formats that their first bytes identify.
    pub by_magic: &'static [&'static dyn FileFormat],
    /// The format of text files.
    pub text: &'static dyn FileFormat,
}

/// The kind of a file.
#[derive(Clone, Copy)]
pub(crate) enum Kind {
    /// A supported format.
    Read(&'static dyn FileFormat),
    /// A packed file of any supported format.
    Packed(Packing),
}

impl Formats {
    /// The content of a file and its kind. A packed file is unpacked once.
    pub(crate) fn content(&self, path: &Path) -> Result<(Kind, File), FormatError> {
        let file = files::open(path).map_err(|e| FormatError::unreadable(path, &e))?;
        let mut first = Vec::new();
        (&file)
            .take(FIRST_BYTES as u64)
            .read_to_end(&mut first)
            .map_err(|e| FormatError::unreadable(path, &e))?;
        match self.kind(path, &first)? {
            Kind::Packed(packing) => {
                let look = |piece: &[u8]| self.kind(path, &piece[..piece.len().min(FIRST_BYTES)]);
                unpack(path, file, packing, look)
            }
            kind => Ok((kind, file)),
        }
    }

    /// The kind of a file with these first bytes, independent of its name.
    fn kind(&self, path: &Path, first: &[u8]) -> Result<Kind, FormatError> {
        if first.is_empty() {
            return Err(FormatError::Empty { path: path.to_owned() });
        }
        let holds =
            |&(at, bytes): &Magic| first.get(at..).is_some_and(|rest| rest.starts_with(bytes));
        if let Some(format) = self.by_magic.iter().find(|f| f.magic().iter().any(holds)) {
            return Ok(Kind::Read(*format));
        }
        if let Some(packing) = Packing::ALL.into_iter().find(|p| holds(&p.magic())) {
            return Ok(Kind::Packed(packing));
        }
        if let Some(kind) = unread_kind(first) {
            return Err(FormatError::other_kind(path, kind));
        }
        if is_text(first) {
            return Ok(Kind::Read(self.text));
        }
        let is_called = |f: &&&dyn FileFormat| {
            let extension = path.extension();
            f.extension().is_some_and(|e| extension.is_some_and(|own| own.eq_ignore_ascii_case(e)))
        };
        Err(match self.by_magic.iter().find(is_called) {
            Some(format) => not_begun(path, *format),
            None => FormatError::other_kind(path, UNKNOWN),
        })
    }
}

/// The error for a file with the extension of a format but other first bytes.
fn not_begun(path: &Path, format: &dyn FileFormat) -> FormatError {
    let begin = format.magic().first().map_or(&[][..], |(_, bytes)| bytes);
    let reason = format!("it does not begin with {}", String::from_utf8_lossy(begin));
    FormatError::broken(path, format.name(), &reason)
}
