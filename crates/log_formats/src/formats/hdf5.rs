//! Arrays in the groups of an HDF5 file.

use std::{
    fs::File,
    io::{self, Read, Seek},
    path::Path,
};

use hdf5_reader::{Dataset, group::Group};

use crate::{
    arrays::{
        array_file::ArrayFile,
        hdf5_tree::{Layout, read_arrays},
    },
    common::{damage::Damage, error::FormatError},
    file_format::{FileFormat, Magic, Opened, Request},
};

/// Name of the format in errors.
const NAME: &str = "HDF5";
const SIGNATURE: &[u8] = b"\x89HDF\r\n\x1a\n";
/// Size of the block that a program may put before the signature (bytes).
const USER_BLOCK: usize = 512;

/// Arrays in the groups of an HDF5 file. An array in a group is named `group.array`.
pub(crate) struct Hdf5;

impl FileFormat for Hdf5 {
    fn name(&self) -> &'static str {
        NAME
    }

    fn magic(&self) -> &'static [Magic] {
        &[(0, SIGNATURE), (USER_BLOCK, SIGNATURE)]
    }

    fn open(
        &self,
        path: &Path,
        file: File,
        request: &Request,
        _: &mut Damage,
    ) -> Result<Box<dyn Opened>, FormatError> {
        let header = header_bytes(&file).map_err(|e| FormatError::unreadable(path, &e))?;
        let layout = RowByRow { header_bytes: header };
        let decode = |file, allowance: &mut _| read_arrays(file, &layout, allowance);
        Ok(Box::new(ArrayFile::read(path, file, NAME, request.time, decode)?))
    }
}

/// Number of bytes before the signature.
fn header_bytes(mut file: &File) -> io::Result<u64> {
    let mut first = [0; SIGNATURE.len()];
    file.rewind()?;
    file.read_exact(&mut first)?;
    Ok(if first == SIGNATURE { 0 } else { USER_BLOCK as u64 })
}

/// The layout of datasets of numbers, stored row by row.
struct RowByRow {
    header_bytes: u64,
}

impl Layout for RowByRow {
    fn header_bytes(&self) -> u64 {
        self.header_bytes
    }

    fn is_structure(&self, _: &Group) -> bool {
        true
    }

    fn shape(&self, dataset: &Dataset) -> Option<[u64; 2]> {
        match *dataset.shape() {
            [rows] => Some([rows, 1]),
            [rows, columns] => Some([rows, columns]),
            _ => None,
        }
    }

    fn sort_by_column(&self, numbers: Vec<f64>, [rows, columns]: [u64; 2]) -> Vec<f64> {
        // An array without numbers may have any number of columns.
        if rows == 1 || columns == 1 || numbers.is_empty() {
            return numbers;
        }
        let width = columns as usize;
        (0..width).flat_map(|k| numbers.iter().skip(k).step_by(width.max(1)).copied()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn numbers_row_by_row_are_sorted_by_column_and_none_take_no_time() {
        let layout = RowByRow { header_bytes: 0 };
        let numbers = vec![1.0, 2.0, 3.0, 4.0, 5.0, 6.0];
        assert_eq!(layout.sort_by_column(numbers, [2, 3]), [1.0, 4.0, 2.0, 5.0, 3.0, 6.0]);
        assert!(layout.sort_by_column(Vec::new(), [0, 1 << 60]).is_empty());
    }
}
