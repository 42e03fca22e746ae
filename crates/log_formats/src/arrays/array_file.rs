use std::{
    fs::File,
    io,
    path::{Path, PathBuf},
};

use crate::{
    arrays::array::Array,
    common::{
        allowance::Allowance,
        bounds::{check_columns, check_size},
        damage::Damage,
        error::FormatError,
        guard::guard_deep,
        sha256::sha256_of_files,
        table::{Needed, Table},
    },
    file_format::Opened,
};

/// Bytes counted for the name of a column.
const PER_NAME: u64 = 256;

/// A log of named arrays that is read as a whole.
pub(crate) struct ArrayFile {
    path: PathBuf,
    columns: Vec<(String, Vec<f64>)>,
}

impl ArrayFile {
    /// Reads the arrays of numbers with `decode`. A vector is a column with the name of the array. An array `q` of
    /// samples x n is the columns `q[0]`, `q[1]` and so on. An array of n x samples is read the same way if only its
    /// second dimension is as long as the column `time`.
    ///
    /// `kind` is the name of the format in errors.
    pub(crate) fn read(
        path: &Path,
        file: File,
        kind: &'static str,
        time: &str,
        decode: impl FnOnce(File, &mut Allowance) -> io::Result<Vec<Array>> + Send,
    ) -> Result<Self, FormatError> {
        let length = file.metadata().map_err(|e| FormatError::unreadable(path, &e))?.len();
        let mut allowance = Allowance::of(length);
        let broken = |e: io::Error| FormatError::broken(path, kind, &e);
        let arrays = guard_deep(path, kind, || decode(file, &mut allowance).map_err(broken))?;
        let of_time = arrays.iter().filter(|a| a.is_vector()).find(|array| array.name == time);
        let samples = of_time.map(|array| array.numbers.len() as u64);
        let mut columns = vec![];
        for array in &arrays {
            let own = array.columns(samples);
            let names = PER_NAME * own.len() as u64;
            allowance.take(names).map_err(|e| FormatError::too_large(path, e))?;
            columns.extend(own);
            check_columns(path, columns.len())?;
            let longest = columns.iter().map(|(_, numbers)| numbers.len()).max().unwrap_or(0);
            check_size(path, longest as u64, columns.len())?;
        }
        Ok(Self { path: path.to_owned(), columns })
    }
}

impl Opened for ArrayFile {
    fn names(&self) -> Result<Vec<String>, FormatError> {
        Ok(self.columns.iter().map(|(name, _)| name.clone()).collect())
    }

    /// Columns by name: those that are needed, and any other column that is as long as time.
    fn load(&self, needed: &Needed, _: &mut Damage) -> Result<Table, FormatError> {
        let with_time = self.columns.iter().find(|(name, _)| name == needed.time);
        let samples = with_time.map_or(0, |(_, numbers)| numbers.len());
        let mut table = Table::default();
        for (name, numbers) in &self.columns {
            if numbers.len() == samples {
                table.columns.insert(name.clone(), numbers.clone());
            } else if needed.contains(name) {
                return Err(FormatError::ColumnLength {
                    path: self.path.clone(),
                    column: name.clone(),
                    found: numbers.len() as u64,
                    time: needed.time.to_owned(),
                    expected: samples as u64,
                });
            }
        }
        Ok(table.excerpt(needed))
    }

    fn sha256(&self) -> Result<String, FormatError> {
        sha256_of_files([self.path.as_path()])
    }
}
