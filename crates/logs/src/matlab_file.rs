use std::{
    fs::File,
    io::{BufReader, Read, Seek, SeekFrom},
    path::{Path, PathBuf},
};

use crate::{
    LogError,
    allowance::Allowance,
    guarded::guarded,
    matlab_element::{Array, Elements, Order},
    matlab_hdf5,
    table::{Needed, Table},
};

/// What a damaged file is called.
const KIND: &str = "MATLAB";
/// Bytes of the header; its last two tell the order of bytes.
const HEADER: usize = 128;
/// Most columns of an array; one that has more is a picture or a list of features.
const MOST_COLUMNS: u64 = 10_000;
/// Taken for the name of a column (bytes).
const PER_NAME: u64 = 256;

/// How a file is laid out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum MatlabVersion {
    /// Elements one after the other (save -v7 and earlier).
    Five,
    /// HDF5 (save -v7.3).
    SevenPointThree,
}

/// A log as arrays of MATLAB.
pub(crate) struct MatlabFile {
    path: PathBuf,
    columns: Vec<(String, Vec<f64>)>,
}

impl MatlabFile {
    /// Reads the arrays of numbers: vectors are columns by their name, `q` of samples x n is `q[0]`,
    /// `q[1]` and so on, also where it lies as n x samples and only that is as long as the column
    /// `time`; fields of a structure are `log.q`.
    pub(crate) fn open(
        path: &Path,
        (version, file): (MatlabVersion, File),
        time: &str,
    ) -> Result<Self, LogError> {
        let length = file.metadata().map_err(|e| LogError::unreadable(path, &e))?.len();
        let mut allowance = Allowance::of(length);
        let told = |e: std::io::Error| LogError::broken(path, KIND, &e);
        let arrays = guarded(path, KIND, || match version {
            MatlabVersion::Five => arrays(file, &mut allowance).map_err(told),
            MatlabVersion::SevenPointThree => {
                matlab_hdf5::arrays(file, &mut allowance).map_err(told)
            }
        })?;
        let is_vector = |array: &&Array| array.rows == 1 || array.columns == 1;
        let of_time = arrays.iter().filter(is_vector).find(|array| array.name == time);
        let samples = of_time.map(|array| array.numbers.len() as u64);
        let mut columns = vec![];
        for array in &arrays {
            let own = columns_of(array, samples);
            let names = PER_NAME * own.len() as u64;
            allowance.take(names).map_err(|e| LogError::too_large(path, e))?;
            columns.extend(own);
        }
        Ok(Self { path: path.to_owned(), columns })
    }

    /// Names of the columns, in the order of the file.
    pub(crate) fn names(&self) -> Vec<String> {
        self.columns.iter().map(|(name, _)| name.clone()).collect()
    }

    /// Columns by name: those that are needed, and of the rest those that are as long as time.
    pub(crate) fn load(&self, needed: &Needed) -> Result<Table, LogError> {
        let with_time = self.columns.iter().find(|(name, _)| name == needed.time);
        let samples = with_time.map_or(0, |(_, numbers)| numbers.len());
        let mut table = Table::default();
        for (name, numbers) in &self.columns {
            if numbers.len() == samples {
                table.columns.insert(name.clone(), numbers.clone());
            } else if needed.contains(name) {
                return Err(LogError::ColumnLength {
                    path: self.path.clone(),
                    column: name.clone(),
                    found: numbers.len() as u64,
                    time: needed.time.to_owned(),
                    expected: samples as u64,
                });
            }
        }
        Ok(table)
    }
}

fn arrays(file: File, allowance: &mut Allowance) -> std::io::Result<Vec<Array>> {
    let mut file = BufReader::with_capacity(1 << 16, file);
    let mut header = [0; HEADER];
    file.rewind()?;
    file.read_exact(&mut header)?;
    let order = if header.ends_with(b"IM") { Order::Little } else { Order::Big };
    let (mut arrays, mut at) = (vec![], HEADER as u64);
    let mut elements = Elements { order, allowance };
    while let Some((mut own, length)) = elements.next(&mut file)? {
        arrays.append(&mut own);
        at += length;
        file.seek(SeekFrom::Start(at))?;
    }
    Ok(arrays)
}

/// The columns of an array; none of one that is no table.
fn columns_of(array: &Array, samples: Option<u64>) -> Vec<(String, Vec<f64>)> {
    let Array { name, rows, columns, numbers } = array;
    if *rows == 1 || *columns == 1 {
        return vec![(name.clone(), numbers.clone())];
    }
    let is_turned = Some(*rows) != samples && Some(*columns) == samples;
    let width = if is_turned { *rows } else { *columns };
    if !(1..=MOST_COLUMNS).contains(&width) {
        return vec![];
    }
    let (width, rows) = (width as usize, *rows as usize);
    let column = |k: usize| -> Vec<f64> {
        if is_turned {
            numbers.iter().skip(k).step_by(rows).copied().collect()
        } else {
            numbers.iter().skip(k * rows).take(rows).copied().collect()
        }
    };
    (0..width).map(|k| (format!("{name}[{k}]"), column(k))).collect()
}
