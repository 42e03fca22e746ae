use std::{
    collections::BTreeSet,
    fs::{self, File},
    io::{self, Read},
    path::Path,
};

use sha2::{Digest, Sha256};

use crate::{
    LogError,
    csv_file::CsvFile,
    kind::{FIRST_BYTES, Kind, TWICE, UNKNOWN},
    numpy_file::NumpyFile,
    parquet_file::{self, ParquetFile},
    table::{Needed, Table},
    unpacked::unpacked,
};

/// A log that is opened, by its kind.
pub(crate) enum LogFile {
    Csv(CsvFile),
    Parquet(ParquetFile),
    Numpy(NumpyFile),
}

impl LogFile {
    /// Opens a file; its kind is seen from its first bytes. `time` is the name of the column that
    /// tells how long the others are.
    pub(crate) fn open(path: &Path, time: &str) -> Result<Self, LogError> {
        let path_buf = || path.to_owned();
        let data = fs::metadata(path).map_err(|e| match e.kind() {
            io::ErrorKind::NotFound => LogError::Missing { path: path_buf() },
            _ => LogError::unreadable(path, &e),
        })?;
        if data.is_dir() {
            return Err(LogError::NotAFile { path: path_buf(), found: "a directory" });
        }
        if !data.is_file() {
            return Err(LogError::NotAFile { path: path_buf(), found: "not a regular file" });
        }
        let file = File::open(path).map_err(|e| LogError::unreadable(path, &e))?;
        let (kind, file) = content(path, file)?;
        match kind {
            Kind::Csv => Ok(Self::Csv(CsvFile::open(path, file)?)),
            Kind::Parquet => Ok(Self::Parquet(ParquetFile::open(path, file))),
            Kind::Npy => Ok(Self::Numpy(NumpyFile::open_npy(path, file)?)),
            Kind::Zip => Ok(Self::Numpy(NumpyFile::open_npz(path, file, time)?)),
            Kind::Packed(_) => Err(LogError::other_kind(path, TWICE)),
        }
    }

    /// Names of the columns, each one once.
    pub(crate) fn names(&self, path: &Path) -> Result<Vec<String>, LogError> {
        let names = match self {
            Self::Csv(csv) => csv.names().to_vec(),
            Self::Parquet(parquet) => parquet.names()?,
            Self::Numpy(numpy) => numpy.names(),
        };
        let mut seen = BTreeSet::new();
        match names.iter().find(|n| !n.is_empty() && !seen.insert(n.as_str())) {
            Some(name) => {
                Err(LogError::DuplicateColumn { path: path.to_owned(), column: name.clone() })
            }
            None => Ok(names),
        }
    }

    /// Whether the names of the columns are not the file's own.
    pub(crate) fn is_unnamed(&self) -> bool {
        match self {
            Self::Csv(csv) => csv.is_unnamed(),
            Self::Numpy(numpy) => numpy.is_unnamed(),
            Self::Parquet(_) => false,
        }
    }

    /// Whether the file ends in the middle of a row.
    pub(crate) fn is_torn(&self) -> bool {
        matches!(self, Self::Csv(csv) if csv.is_torn())
    }

    /// The numbers of the file, those in `needed` complete.
    pub(crate) fn load(&self, needed: &Needed) -> Result<Table, LogError> {
        match self {
            Self::Csv(csv) => csv.load(needed),
            Self::Parquet(parquet) => parquet.load(needed),
            Self::Numpy(numpy) => numpy.load(needed),
        }
    }
}

/// What is in a file: itself, or what was packed.
fn content(path: &Path, file: File) -> Result<(Kind, File), LogError> {
    let mut first = Vec::new();
    (&file)
        .take(FIRST_BYTES)
        .read_to_end(&mut first)
        .map_err(|e| LogError::unreadable(path, &e))?;
    match kind(path, &first)? {
        Kind::Packed(packing) => unpacked(path, file, packing, |first| kind(path, first)),
        kind => Ok((kind, file)),
    }
}

/// The kind of a file that begins with these bytes.
fn kind(path: &Path, first: &[u8]) -> Result<Kind, LogError> {
    if first.is_empty() {
        return Err(LogError::Empty { path: path.to_owned() });
    }
    let called_parquet = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("parquet"));
    Kind::of(first).map_err(|stranger| {
        if stranger == UNKNOWN && called_parquet {
            return LogError::broken(path, parquet_file::KIND, &"it does not begin with PAR1");
        }
        LogError::other_kind(path, stranger)
    })
}

/// SHA-256 of a file, in hexadecimal.
pub(crate) fn sha256(path: &Path) -> Result<String, LogError> {
    let mut file = File::open(path).map_err(|e| LogError::unreadable(path, &e))?;
    let mut hasher = Sha256::new();
    let mut buffer = vec![0; 1 << 16];
    loop {
        match file.read(&mut buffer).map_err(|e| LogError::unreadable(path, &e))? {
            0 => break,
            count => hasher.update(&buffer[..count]),
        }
    }
    Ok(hasher.finalize().iter().map(|byte| format!("{byte:02x}")).collect())
}
