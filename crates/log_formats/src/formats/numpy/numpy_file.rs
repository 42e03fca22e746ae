use std::{
    fs::File,
    io::{self, BufReader, Read, Seek},
    path::{Path, PathBuf},
};

use zip::ZipArchive;

use crate::{
    common::{
        allowance::Allowance,
        bounds::check_size,
        damage::Damage,
        error::FormatError,
        guard::guard,
        sha256::sha256_of_files,
        table::{Needed, Table},
        unread_kinds::{NO_TABLE, of_archive},
    },
    file_format::{FileFormat, Magic, Opened, Request},
    formats::numpy::{
        npy_header::{MAGIC, NpyHeader},
        numpy_array::NumpyArray,
    },
};

/// Name of the format in errors.
const NAME: &str = "NumPy";
/// Bytes counted for the name of a column.
const PER_NAME: u64 = 256;
/// Bytes counted for each byte of a header that is parsed.
const PER_HEADER_BYTE: u64 = 32;

/// A single NumPy array.
pub(crate) struct Npy;

impl FileFormat for Npy {
    fn name(&self) -> &'static str {
        NAME
    }

    fn magic(&self) -> &'static [Magic] {
        &[(0, MAGIC)]
    }

    fn open(
        &self,
        path: &Path,
        file: File,
        _: &Request,
        _: &mut Damage,
    ) -> Result<Box<dyn Opened>, FormatError> {
        Ok(Box::new(NumpyFile::open_npy(path, file)?))
    }
}

/// A zip archive with NumPy arrays.
pub(crate) struct Npz;

impl FileFormat for Npz {
    fn name(&self) -> &'static str {
        NAME
    }

    fn magic(&self) -> &'static [Magic] {
        &[(0, b"PK\x03\x04")]
    }

    fn open(
        &self,
        path: &Path,
        file: File,
        request: &Request,
        _: &mut Damage,
    ) -> Result<Box<dyn Opened>, FormatError> {
        Ok(Box::new(NumpyFile::open_npz(path, file, request.time)?))
    }
}

/// A log as NumPy arrays: a single one (.npy), or several named ones in a zip archive (.npz).
pub(crate) struct NumpyFile {
    path: PathBuf,
    file: File,
    arrays: Vec<(Place, NumpyArray)>,
    is_unnamed: bool,
}

/// Place of an array.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Place {
    TheFile,
    Entry(usize),
}

impl NumpyFile {
    /// Reads the header of a single array.
    pub(crate) fn open_npy(path: &Path, file: File) -> Result<Self, FormatError> {
        let header = Source::new(path, &file, Place::TheFile)
            .and_then(|mut source| source.visit(Place::TheFile, |data, _| NpyHeader::read(data)))?;
        let Some(array) = NumpyArray::new(None, &header, None) else {
            return Err(FormatError::other_kind(path, NO_TABLE));
        };
        let (path, arrays) = (path.to_owned(), vec![(Place::TheFile, array)]);
        Ok(Self { path, file, arrays, is_unnamed: !header.is_record })
    }

    /// Reads the headers of the arrays in an archive. The column `time` gives the number of their
    /// samples.
    pub(crate) fn open_npz(path: &Path, file: File, time: &str) -> Result<Self, FormatError> {
        let headers = headers(path, &file)?;
        let arrays = |samples| {
            let of = move |(place, name, header): &(Place, String, NpyHeader)| {
                Some((*place, NumpyArray::new(Some(name), header, samples)?))
            };
            headers.iter().filter_map(of)
        };
        let samples = arrays(None).find(|(_, array)| array.has(time)).map(|(_, a)| a.samples);
        let mut allowance = allowance(path, &file)?;
        let mut kept = Vec::new();
        for (place, array) in arrays(samples) {
            let names = PER_NAME * array.columns.len() as u64;
            allowance.take(names).map_err(|e| FormatError::too_large(path, e))?;
            kept.push((place, array));
        }
        Ok(Self { path: path.to_owned(), file, arrays: kept, is_unnamed: false })
    }
}

impl Opened for NumpyFile {
    fn names(&self) -> Result<Vec<String>, FormatError> {
        Ok(self.arrays.iter().flat_map(|(_, array)| array.columns.clone()).collect())
    }

    /// Columns by name: those that are needed, and any other column that is as long as time.
    fn load(&self, needed: &Needed, _: &mut Damage) -> Result<Table, FormatError> {
        let path = &self.path;
        let with_time = self.arrays.iter().find(|(_, array)| array.has(needed.time));
        let Some(&(first, NumpyArray { samples, .. })) = with_time else {
            return Ok(Table::default());
        };
        let as_long = self.arrays.iter().filter(|(_, array)| array.samples == samples);
        let width = as_long.map(|(_, array)| array.columns.len()).sum();
        let is_read = check_size(path, samples, width).is_ok();
        let mut source = Source::new(path, &self.file, first)?;
        let mut allowance = allowance(path, &self.file)?;
        let mut table = Table::default();
        for (place, array) in &self.arrays {
            if array.samples != samples {
                if let Some(column) = array.columns.iter().find(|name| needed.contains(name)) {
                    let (path, column) = (path.clone(), column.clone());
                    let (found, expected) = (array.samples, samples);
                    let time = needed.time.to_owned();
                    return Err(FormatError::ColumnLength { path, column, found, time, expected });
                }
                continue;
            }
            let is_allowed = allowance.take(array.unpacked_bytes());
            let columns = source.visit(*place, |mut data, bytes| {
                NpyHeader::read(&mut data)?;
                if array.packed_bytes().is_none_or(|expected| expected > bytes) {
                    return Err(io::ErrorKind::UnexpectedEof.into());
                }
                match is_allowed {
                    _ if !is_read => Ok(Ok(Vec::new())),
                    Ok(()) => array.read(data).map(Ok),
                    Err(exceeded) => Ok(Err(exceeded)),
                }
            })?;
            // Told of a file that holds what its header says.
            check_size(path, samples, width)?;
            let columns = columns.map_err(|e| FormatError::too_large(path, e))?;
            table.columns.extend(array.columns.iter().cloned().zip(columns));
        }
        Ok(table.excerpt(needed))
    }

    fn sha256(&self) -> Result<String, FormatError> {
        sha256_of_files([self.path.as_path()])
    }

    fn is_unnamed(&self) -> bool {
        self.is_unnamed
    }
}

/// The arrays of an archive, each with its place, name and header.
fn headers(path: &Path, file: &File) -> Result<Vec<(Place, String, NpyHeader)>, FormatError> {
    let mut source = Source::new(path, file, Place::Entry(0))?;
    let names = source.entry_names();
    let mut allowance = allowance(path, file)?;
    let mut headers = Vec::new();
    for (index, name) in names.iter().enumerate() {
        let Some(name) = name.strip_suffix(".npy") else { continue };
        let place = Place::Entry(index);
        let header = source.visit(place, |data, _| NpyHeader::read(data))?;
        let bytes = PER_HEADER_BYTE * header.length;
        allowance.take(bytes).map_err(|e| FormatError::too_large(path, e))?;
        headers.push((place, name.to_owned(), header));
    }
    if headers.is_empty() {
        return Err(FormatError::other_kind(path, of_archive(&names)));
    }
    Ok(headers)
}

fn allowance(path: &Path, file: &File) -> Result<Allowance, FormatError> {
    let data = file.metadata().map_err(|e| FormatError::unreadable(path, &e))?;
    Ok(Allowance::of(data.len()))
}

/// A file with arrays.
struct Source<'a> {
    path: &'a Path,
    file: &'a File,
    archive: Option<ZipArchive<BufReader<&'a File>>>,
}

impl<'a> Source<'a> {
    /// A source for arrays at places of this kind.
    fn new(path: &'a Path, file: &'a File, place: Place) -> Result<Self, FormatError> {
        let archive = match place {
            Place::TheFile => None,
            Place::Entry(_) => Some(guard(path, NAME, || {
                ZipArchive::new(BufReader::new(file))
                    .map_err(|e| FormatError::broken(path, NAME, &e))
            })?),
        };
        Ok(Self { path, file, archive })
    }

    /// Names of the entries, in the order of the archive.
    fn entry_names(&self) -> Vec<String> {
        let Some(archive) = &self.archive else { return Vec::new() };
        let name = |index| match archive.name_for_index(index) {
            Some(Ok(name)) => name.replace(char::is_control, "?"),
            _ => String::new(),
        };
        (0..archive.len()).map(name).collect()
    }

    /// Passes the bytes of an array, from its first one, and their number to `read`.
    fn visit<T>(
        &mut self,
        place: Place,
        read: impl FnOnce(&mut dyn Read, u64) -> io::Result<T>,
    ) -> Result<T, FormatError> {
        let (path, mut file) = (self.path, self.file);
        let told = |e: io::Error| FormatError::broken(path, NAME, &e);
        guard(path, NAME, || match (place, &mut self.archive) {
            (Place::Entry(index), Some(archive)) => {
                let entry = archive.by_index(index);
                let mut entry = entry.map_err(|e| FormatError::broken(path, NAME, &e))?;
                let bytes = entry.size();
                read(&mut entry, bytes).map_err(told)
            }
            _ => {
                let bytes = file.metadata().map_err(told)?.len();
                file.rewind().map_err(told)?;
                read(&mut file, bytes).map_err(told)
            }
        })
    }
}
