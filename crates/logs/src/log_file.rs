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
    kind::{FIRST_BYTES, Kind, Stranger, UNKNOWN},
    parquet_file::ParquetFile,
    table::{Needed, Table},
};

/// A log that is opened, by its kind.
pub(crate) enum LogFile {
    Csv(CsvFile),
    Parquet(ParquetFile),
}

impl LogFile {
    /// Opens a file; its kind is seen from its first bytes.
    pub(crate) fn open(path: &Path) -> Result<Self, LogError> {
        let path_buf = || path.to_owned();
        let data = fs::metadata(path).map_err(|e| match e.kind() {
            io::ErrorKind::NotFound => LogError::Missing { path: path_buf() },
            _ => unreadable(path, &e),
        })?;
        if data.is_dir() {
            return Err(LogError::NotAFile { path: path_buf(), found: "a directory" });
        }
        if !data.is_file() {
            return Err(LogError::NotAFile { path: path_buf(), found: "not a regular file" });
        }
        let file = File::open(path).map_err(|e| unreadable(path, &e))?;
        match kind(path, &file)? {
            Kind::Csv => Ok(Self::Csv(CsvFile::open(path, file)?)),
            Kind::Parquet => Ok(Self::Parquet(ParquetFile::open(path, file))),
        }
    }

    /// Names of the columns, each one once.
    pub(crate) fn names(&self, path: &Path) -> Result<Vec<String>, LogError> {
        let names = match self {
            Self::Csv(csv) => csv.names().to_vec(),
            Self::Parquet(parquet) => parquet.names()?,
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
        matches!(self, Self::Csv(csv) if csv.is_unnamed())
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
        }
    }
}

fn kind(path: &Path, file: &File) -> Result<Kind, LogError> {
    let path_buf = || path.to_owned();
    let mut first = Vec::new();
    file.take(FIRST_BYTES).read_to_end(&mut first).map_err(|e| unreadable(path, &e))?;
    if first.is_empty() {
        return Err(LogError::Empty { path: path_buf() });
    }
    let called_parquet = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("parquet"));
    Kind::of(&first).map_err(|stranger| {
        if stranger == UNKNOWN && called_parquet {
            let reason = "it does not begin with PAR1".to_owned();
            return LogError::BrokenParquet { path: path_buf(), reason };
        }
        let Stranger { found, advice } = stranger;
        LogError::OtherKind { path: path_buf(), found, advice }
    })
}

/// SHA-256 of a file, in hexadecimal.
pub(crate) fn sha256(path: &Path) -> Result<String, LogError> {
    let mut file = File::open(path).map_err(|e| unreadable(path, &e))?;
    let mut hasher = Sha256::new();
    let mut buffer = vec![0; 1 << 16];
    loop {
        match file.read(&mut buffer).map_err(|e| unreadable(path, &e))? {
            0 => break,
            count => hasher.update(&buffer[..count]),
        }
    }
    Ok(hasher.finalize().iter().map(|byte| format!("{byte:02x}")).collect())
}

fn unreadable(path: &Path, error: &io::Error) -> LogError {
    LogError::Unreadable { path: path.to_owned(), reason: error.to_string() }
}
