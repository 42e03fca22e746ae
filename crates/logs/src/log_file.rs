use std::{
    collections::{BTreeMap, BTreeSet},
    fs::{self, File},
    io::{self, Read},
    path::{Path, PathBuf},
};

use sha2::{Digest, Sha256};

use crate::{
    LogError, ReadOptions,
    bag::{self, Bag},
    content::content,
    csv_file::CsvFile,
    damage::Damage,
    kind::{Kind, NOT_A_BAG, TWICE},
    lerobot::{self, LeRobot},
    matlab_file::MatlabFile,
    numpy_file::NumpyFile,
    parquet_file::ParquetFile,
    table::{Needed, Table},
};

/// A log that is opened, by its kind.
pub(crate) enum LogFile {
    Csv(CsvFile),
    Parquet(ParquetFile),
    Numpy(NumpyFile),
    Matlab(MatlabFile),
    Bag(Bag),
    LeRobot(LeRobot),
    /// Columns that were never a file.
    Columns(BTreeMap<String, Vec<f64>>),
}

impl LogFile {
    /// Opens a file, or the folder of a bag or a dataset; a kind is seen from the first bytes.
    pub(crate) fn open(
        path: &Path,
        options: &ReadOptions,
        damage: &mut Damage,
    ) -> Result<Self, LogError> {
        let data = fs::metadata(path).map_err(|e| match e.kind() {
            io::ErrorKind::NotFound => LogError::Missing { path: path.to_owned() },
            _ => LogError::unreadable(path, &e),
        })?;
        if data.is_dir() {
            return Self::open_folder(path, options, damage);
        }
        if !data.is_file() {
            let found = "not a regular file";
            return Err(LogError::NotAFile { path: path.to_owned(), found });
        }
        let (kind, file) = content(path)?;
        Ok(match kind {
            Kind::Csv => Self::Csv(CsvFile::open(path, file)?),
            Kind::Parquet => Self::Parquet(ParquetFile::open(path, file)),
            Kind::Npy => Self::Numpy(NumpyFile::open_npy(path, file)?),
            Kind::Zip => Self::Numpy(NumpyFile::open_npz(path, file, options.time())?),
            Kind::Matlab(version) => {
                Self::Matlab(MatlabFile::open(path, (version, file), options.time())?)
            }
            Kind::Bag(storage) => {
                let files = [(path.to_owned(), storage, file)];
                Self::Bag(Bag::open(path, &files, options.topic, damage)?)
            }
            Kind::Packed(_) => return Err(LogError::other_kind(path, TWICE)),
        })
    }

    fn open_folder(
        path: &Path,
        options: &ReadOptions,
        damage: &mut Damage,
    ) -> Result<Self, LogError> {
        if lerobot::is_dataset(path) {
            return Ok(Self::LeRobot(LeRobot::open(path, options.episode, options.dataset)?));
        }
        let mut files = Vec::new();
        for path in bag::files_of(path)? {
            match content(&path)? {
                (Kind::Bag(storage), file) => files.push((path, storage, file)),
                _ => return Err(LogError::other_kind(&path, NOT_A_BAG)),
            }
        }
        Ok(Self::Bag(Bag::open(path, &files, options.topic, damage)?))
    }

    /// Names of the columns, each one once.
    pub(crate) fn names(&self, path: &Path) -> Result<Vec<String>, LogError> {
        let names = match self {
            Self::Csv(csv) => csv.names().to_vec(),
            Self::Parquet(parquet) => parquet.names()?,
            Self::Numpy(numpy) => numpy.names(),
            Self::Matlab(matlab) => matlab.names(),
            Self::Bag(bag) => bag.names().to_vec(),
            Self::LeRobot(dataset) => dataset.names().to_vec(),
            Self::Columns(columns) => columns.keys().cloned().collect(),
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
            Self::Parquet(_)
            | Self::Matlab(_)
            | Self::Bag(_)
            | Self::LeRobot(_)
            | Self::Columns(_) => false,
        }
    }

    /// Whether the file ends in the middle of a row.
    pub(crate) fn is_torn(&self) -> bool {
        matches!(self, Self::Csv(csv) if csv.is_torn())
    }

    /// The numbers of the file, those in `needed` complete.
    pub(crate) fn load(&self, needed: &Needed, damage: &mut Damage) -> Result<Table, LogError> {
        match self {
            Self::Csv(csv) => csv.load(needed, damage),
            Self::Parquet(parquet) => parquet.load(needed),
            Self::Numpy(numpy) => Ok(numpy.load(needed)?.excerpt(needed)),
            Self::Matlab(matlab) => Ok(matlab.load(needed)?.excerpt(needed)),
            Self::Bag(bag) => bag.load(needed),
            Self::LeRobot(dataset) => dataset.load(needed),
            Self::Columns(columns) => {
                Ok(Table { columns: columns.clone(), ..Table::default() }.excerpt(needed))
            }
        }
    }

    /// SHA-256 of the file at `path`, or of the files of a bag or an episode one after the other, in
    /// hexadecimal; of columns that were never a file, that of their names and numbers.
    pub(crate) fn sha256(&self, path: &Path) -> Result<String, LogError> {
        let columns = match self {
            Self::Columns(columns) => columns,
            Self::LeRobot(dataset) => return dataset.sha256(),
            _ if path.is_dir() => return sha256_of(bag::files_of(path)?.into_iter()),
            _ => return sha256_of(std::iter::once(path.to_owned())),
        };
        let mut hasher = Sha256::new();
        for (name, samples) in columns {
            hasher.update(format!("{name} {}\n", samples.len()));
            samples.iter().for_each(|x| hasher.update(x.to_le_bytes()));
        }
        Ok(hexadecimal(hasher))
    }
}

/// SHA-256 of files one after the other, in hexadecimal.
pub(crate) fn sha256_of(files: impl Iterator<Item = PathBuf>) -> Result<String, LogError> {
    let mut hasher = Sha256::new();
    let mut buffer = vec![0; 1 << 16];
    for path in files {
        let mut file = File::open(&path).map_err(|e| LogError::unreadable(&path, &e))?;
        loop {
            match file.read(&mut buffer).map_err(|e| LogError::unreadable(&path, &e))? {
                0 => break,
                count => hasher.update(&buffer[..count]),
            }
        }
    }
    Ok(hexadecimal(hasher))
}

fn hexadecimal(hasher: Sha256) -> String {
    hasher.finalize().iter().map(|byte| format!("{byte:02x}")).collect()
}
