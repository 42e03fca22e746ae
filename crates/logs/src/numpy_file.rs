use std::{
    fs::File,
    io::{self, BufReader, Read, Seek},
    path::{Path, PathBuf},
};

use zip::ZipArchive;

use crate::{
    LogError,
    allowance::Allowance,
    guarded::guarded,
    kind::{NO_TABLE, of_archive},
    npy_header::NpyHeader,
    numpy_array::NumpyArray,
    table::{Needed, Table},
};

/// What a damaged file is called.
const KIND: &str = "NumPy";
/// Taken for the name of a column (bytes).
const PER_NAME: u64 = 256;
/// Taken for a byte of a header when it is parsed.
const PER_HEADER_BYTE: u64 = 32;

/// A log as arrays of NumPy: one (.npy), or some by name in a zip archive (.npz).
pub(crate) struct NumpyFile {
    path: PathBuf,
    file: File,
    arrays: Vec<(Place, NumpyArray)>,
    is_unnamed: bool,
}

/// Where an array lies.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Place {
    TheFile,
    Entry(usize),
}

impl NumpyFile {
    /// Looks at the header of a single array.
    pub(crate) fn open_npy(path: &Path, file: File) -> Result<Self, LogError> {
        let header = Source::new(path, &file, Place::TheFile)
            .and_then(|mut source| source.visit(Place::TheFile, |data, _| NpyHeader::read(data)))?;
        let Some(array) = NumpyArray::new(None, &header, None) else {
            return Err(LogError::other_kind(path, NO_TABLE));
        };
        let (path, arrays) = (path.to_owned(), vec![(Place::TheFile, array)]);
        Ok(Self { path, file, arrays, is_unnamed: !header.is_record })
    }

    /// Looks at the headers of the arrays of an archive. Their samples are as many as those of
    /// the column `time`.
    pub(crate) fn open_npz(path: &Path, file: File, time: &str) -> Result<Self, LogError> {
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
            allowance.take(names).map_err(|e| LogError::too_large(path, e))?;
            kept.push((place, array));
        }
        Ok(Self { path: path.to_owned(), file, arrays: kept, is_unnamed: false })
    }

    /// Names of the columns, in the order of the file.
    pub(crate) fn names(&self) -> Vec<String> {
        self.arrays.iter().flat_map(|(_, array)| array.columns.clone()).collect()
    }

    /// Whether the columns have no names of their own.
    pub(crate) fn is_unnamed(&self) -> bool {
        self.is_unnamed
    }

    /// Columns by name: those that are needed, and of the rest those that are as long as time.
    pub(crate) fn load(&self, needed: &Needed) -> Result<Table, LogError> {
        let path = &self.path;
        let with_time = self.arrays.iter().find(|(_, array)| array.has(needed.time));
        let Some(&(first, NumpyArray { samples, .. })) = with_time else {
            return Ok(Table::default());
        };
        let mut source = Source::new(path, &self.file, first)?;
        let mut allowance = allowance(path, &self.file)?;
        let mut table = Table::default();
        for (place, array) in &self.arrays {
            if array.samples != samples {
                if let Some(column) = array.columns.iter().find(|name| needed.contains(name)) {
                    let (path, column) = (path.clone(), column.clone());
                    let (found, expected) = (array.samples, samples);
                    let time = needed.time.to_owned();
                    return Err(LogError::ColumnLength { path, column, found, time, expected });
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
                    Ok(()) => array.read(data).map(Ok),
                    Err(exceeded) => Ok(Err(exceeded)),
                }
            })?;
            let columns = columns.map_err(|e| LogError::too_large(path, e))?;
            table.columns.extend(array.columns.iter().cloned().zip(columns));
        }
        Ok(table)
    }
}

/// The arrays of an archive that have a header, by their place and name.
fn headers(path: &Path, file: &File) -> Result<Vec<(Place, String, NpyHeader)>, LogError> {
    let mut source = Source::new(path, file, Place::Entry(0))?;
    let names = source.entry_names();
    let mut allowance = allowance(path, file)?;
    let mut headers = Vec::new();
    for (index, name) in names.iter().enumerate() {
        let Some(name) = name.strip_suffix(".npy") else { continue };
        let place = Place::Entry(index);
        let header = source.visit(place, |data, _| NpyHeader::read(data))?;
        let bytes = PER_HEADER_BYTE * header.length;
        allowance.take(bytes).map_err(|e| LogError::too_large(path, e))?;
        headers.push((place, name.to_owned(), header));
    }
    if headers.is_empty() {
        return Err(LogError::other_kind(path, of_archive(&names)));
    }
    Ok(headers)
}

fn allowance(path: &Path, file: &File) -> Result<Allowance, LogError> {
    let data = file.metadata().map_err(|e| LogError::unreadable(path, &e))?;
    Ok(Allowance::of(data.len()))
}

/// A file from which arrays are read.
struct Source<'a> {
    path: &'a Path,
    file: &'a File,
    archive: Option<ZipArchive<BufReader<&'a File>>>,
}

impl<'a> Source<'a> {
    /// One in which an array has such a place.
    fn new(path: &'a Path, file: &'a File, place: Place) -> Result<Self, LogError> {
        let archive = match place {
            Place::TheFile => None,
            Place::Entry(_) => Some(guarded(path, KIND, || {
                ZipArchive::new(BufReader::new(file)).map_err(|e| LogError::broken(path, KIND, &e))
            })?),
        };
        Ok(Self { path, file, archive })
    }

    /// Names of the entries of the archive, in its order.
    fn entry_names(&self) -> Vec<String> {
        let Some(archive) = &self.archive else { return Vec::new() };
        let name = |index| match archive.name_for_index(index) {
            Some(Ok(name)) => name.replace(char::is_control, "?"),
            _ => String::new(),
        };
        (0..archive.len()).map(name).collect()
    }

    /// Lets `read` read an array from its first byte on, and tells it the bytes that there are.
    fn visit<T>(
        &mut self,
        place: Place,
        read: impl FnOnce(&mut dyn Read, u64) -> io::Result<T>,
    ) -> Result<T, LogError> {
        let (path, mut file) = (self.path, self.file);
        let told = |e: io::Error| LogError::broken(path, KIND, &e);
        guarded(path, KIND, || match (place, &mut self.archive) {
            (Place::Entry(index), Some(archive)) => {
                let entry = archive.by_index(index);
                let mut entry = entry.map_err(|e| LogError::broken(path, KIND, &e))?;
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
