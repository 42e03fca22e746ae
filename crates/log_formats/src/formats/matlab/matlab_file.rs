use std::{
    fs::File,
    io::{self, BufReader, Read, Seek, SeekFrom},
    path::Path,
};

use hdf5_reader::{Dataset, group::Group};

use crate::{
    arrays::{
        array::Array,
        array_file::ArrayFile,
        hdf5_tree::{Layout, read_arrays},
    },
    common::{allowance::Allowance, damage::Damage, error::FormatError},
    file_format::{FileFormat, Magic, Opened, Request},
    formats::matlab::element::{Elements, Order},
};

/// Name of the format in errors.
const NAME: &str = "MATLAB";
/// Size of the header of version 5 (bytes). Its last two bytes give the byte order.
const HEADER: usize = 128;

/// MAT-files with elements in sequence (save -v7 and earlier). Fields of a structure are named `log.q`.
pub(crate) struct Matlab5;

/// MAT-files in HDF5 after a MATLAB header (save -v7.3). Fields of a structure are named `log.q`.
pub(crate) struct Matlab73;

impl FileFormat for Matlab5 {
    fn name(&self) -> &'static str {
        NAME
    }

    fn magic(&self) -> &'static [Magic] {
        &[(0, b"MATLAB 5.0 MAT-file")]
    }

    fn open(
        &self,
        path: &Path,
        file: File,
        request: &Request,
        _: &mut Damage,
    ) -> Result<Box<dyn Opened>, FormatError> {
        Ok(Box::new(ArrayFile::read(path, file, NAME, request.time, read_elements)?))
    }
}

impl FileFormat for Matlab73 {
    fn name(&self) -> &'static str {
        NAME
    }

    fn magic(&self) -> &'static [Magic] {
        &[(0, b"MATLAB 7.3 MAT-file")]
    }

    fn open(
        &self,
        path: &Path,
        file: File,
        request: &Request,
        _: &mut Damage,
    ) -> Result<Box<dyn Opened>, FormatError> {
        let decode = |file, allowance: &mut _| read_arrays(file, &Matlab73, allowance);
        Ok(Box::new(ArrayFile::read(path, file, NAME, request.time, decode)?))
    }
}

impl Layout for Matlab73 {
    fn header_bytes(&self) -> u64 {
        512
    }

    /// The groups `#refs#` (contents of cells) and `#subsystem#` (objects) are no structures. Nor are sparse arrays.
    fn is_structure(&self, group: &Group) -> bool {
        !group.name().starts_with('#') && group.attribute("MATLAB_sparse").is_err()
    }

    /// A MATLAB array of m x n is stored column by column, as a dataset of n x m.
    fn shape(&self, dataset: &Dataset) -> Option<[u64; 2]> {
        let class = dataset.attribute("MATLAB_class").and_then(|class| class.read_string());
        let is_other = matches!(class.as_deref(), Ok("char" | "cell" | "function_handle"))
            || dataset.attribute("MATLAB_empty").is_ok();
        match *dataset.shape() {
            [columns, rows] if !is_other => Some([rows, columns]),
            _ => None,
        }
    }

    fn sort_by_column(&self, numbers: Vec<f64>, _: [u64; 2]) -> Vec<f64> {
        numbers
    }
}

/// The arrays of a MAT-file of version 5.
fn read_elements(file: File, allowance: &mut Allowance) -> io::Result<Vec<Array>> {
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
