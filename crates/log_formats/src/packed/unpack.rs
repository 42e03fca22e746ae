use std::{
    fs::File,
    io::{self, BufReader, Read, Seek, Write},
    path::Path,
};

use flate2::read::MultiGzDecoder;

use crate::{
    common::{allowance::Allowance, error::FormatError, guard::guard},
    file_format::Magic,
};

/// Compression of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Packing {
    Gzip,
    Zstd,
}

impl Packing {
    pub(crate) const ALL: [Self; 2] = [Self::Gzip, Self::Zstd];

    /// The first bytes of a file with this compression.
    pub(crate) fn magic(self) -> Magic {
        match self {
            Self::Gzip => (0, b"\x1f\x8b"),
            Self::Zstd => (0, b"\x28\xb5\x2f\xfd"),
        }
    }

    /// Name of the compression in errors.
    fn name(self) -> &'static str {
        match self {
            Self::Gzip => "gzip",
            Self::Zstd => "zstd",
        }
    }
}

/// Unpacks a file into an unnamed temporary file. `look` receives the first bytes of the content and may refuse
/// the file before the rest is unpacked.
pub(crate) fn unpack<T>(
    path: &Path,
    mut file: File,
    packing: Packing,
    look: impl FnOnce(&[u8]) -> Result<T, FormatError>,
) -> Result<(T, File), FormatError> {
    let unreadable = |e: io::Error| FormatError::unreadable(path, &e);
    let broken = |e: io::Error| FormatError::broken(path, packing.name(), &e);
    let mut allowance = Allowance::of(file.metadata().map_err(unreadable)?.len());
    file.rewind().map_err(unreadable)?;
    let file = BufReader::new(file);
    guard(path, packing.name(), || {
        let mut content: Box<dyn Read> = match packing {
            Packing::Gzip => Box::new(MultiGzDecoder::new(file)),
            Packing::Zstd => Box::new(zstd::Decoder::with_buffer(file).map_err(broken)?),
        };
        let mut unpacked = tempfile::tempfile().map_err(unreadable)?;
        let mut piece = vec![0; 1 << 16];
        let first = fill(&mut content, &mut piece).map_err(broken)?;
        let seen = look(&piece[..first])?;
        let mut length = first;
        while length > 0 {
            allowance.take(length as u64).map_err(|e| FormatError::too_large(path, e))?;
            unpacked.write_all(&piece[..length]).map_err(unreadable)?;
            length = fill(&mut content, &mut piece).map_err(broken)?;
        }
        Ok((seen, unpacked))
    })
}

/// Reads until `piece` is full or the source ends, and returns the number of bytes read.
fn fill(mut source: &mut dyn Read, piece: &mut [u8]) -> io::Result<usize> {
    let mut length = 0;
    while length < piece.len() {
        match files::read_some(&mut source, &mut piece[length..])? {
            0 => break,
            count => length += count,
        }
    }
    Ok(length)
}
