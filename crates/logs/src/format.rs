use std::{
    collections::{BTreeMap, BTreeSet},
    fs::{self, File},
    io::{self, Read},
    path::Path,
};

use sha2::{Digest, Sha256};

use crate::{LogError, csv_file, parquet_file};

/// The formats a log may have.
#[derive(Clone, Copy)]
pub(crate) enum Format {
    Csv,
    Parquet,
}

impl Format {
    /// Seen from the first bytes of the file.
    pub(crate) fn of(path: &Path) -> Result<Self, LogError> {
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
        let mut first = Vec::new();
        let file = File::open(path).map_err(|e| unreadable(path, &e))?;
        file.take(4).read_to_end(&mut first).map_err(|e| unreadable(path, &e))?;
        let called_parquet = path.extension().is_some_and(|e| e.eq_ignore_ascii_case("parquet"));
        match first.as_slice() {
            [] => Err(LogError::Empty { path: path_buf() }),
            b"PAR1" => Ok(Self::Parquet),
            _ if called_parquet => Err(LogError::BrokenParquet {
                path: path_buf(),
                reason: "it does not begin with PAR1".to_owned(),
            }),
            _ => Ok(Self::Csv),
        }
    }

    /// Names of the columns, each one once.
    pub(crate) fn names(self, path: &Path) -> Result<Vec<String>, LogError> {
        let names = match self {
            Self::Csv => csv_file::names(path)?,
            Self::Parquet => parquet_file::names(path)?,
        };
        let mut seen = BTreeSet::new();
        match names.iter().find(|n| !seen.insert(n.as_str())) {
            Some(name) => {
                Err(LogError::DuplicateColumn { path: path.to_owned(), column: name.clone() })
            }
            None => Ok(names),
        }
    }

    /// Whether the file ends in the middle of a row.
    pub(crate) fn is_torn(self, path: &Path) -> Result<bool, LogError> {
        match self {
            Self::Csv => Ok(csv_file::torn_from(path)?.is_some()),
            Self::Parquet => Ok(false),
        }
    }

    /// Columns by name, those in `required` complete.
    pub(crate) fn load(
        self,
        path: &Path,
        required: &BTreeSet<&str>,
    ) -> Result<BTreeMap<String, Vec<f64>>, LogError> {
        match self {
            Self::Csv => csv_file::load(path, required),
            Self::Parquet => parquet_file::load(path, required),
        }
    }
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
