//! MAT-files of MATLAB 7.3: HDF5 behind a header of MATLAB.

use std::{
    fs::File,
    io::{self, Read, Seek, SeekFrom},
    sync::{Arc, Mutex},
};

use flate2::read::ZlibDecoder;
use hdf5_reader::{
    Dataset, Datatype, FilterRegistry, H5Type, Hdf5File, OpenOptions, Storage, StorageBuffer,
    error::Error, group::Group,
};

use crate::{
    allowance::Allowance,
    matlab_element::{Array, TOO_LARGE},
};

/// Bytes of the header of MATLAB: addresses in the file are counted from behind it.
const HEADER: u64 = 512;
/// Structures in structures that are looked into.
const DEEPEST: usize = 8;
/// Most arrays, and most structures, that are looked at: a file may name one of them again and again.
const MOST: usize = 10_000;
/// Kept of chunks that were unpacked (bytes).
const CACHE: usize = 1 << 22;
/// Filters of HDF5 by their number: deflate, which MATLAB packs with, and two that it never uses.
const DEFLATE: u16 = 1;
const UNUSED: [u16; 2] = [5, 6];

/// What of the file lies behind its header.
struct Behind {
    file: Mutex<File>,
    length: u64,
}

impl Storage for Behind {
    fn len(&self) -> u64 {
        self.length
    }

    fn read_range(&self, offset: u64, len: usize) -> Result<StorageBuffer, Error> {
        let is_inside = offset.checked_add(len as u64).is_some_and(|end| end <= self.length);
        let mut bytes = vec![0; if is_inside { len } else { 0 }];
        let mut file = self.file.lock().map_err(|_| Error::OffsetOutOfBounds(offset))?;
        let read =
            file.seek(SeekFrom::Start(HEADER + offset)).and_then(|_| file.read_exact(&mut bytes));
        match read {
            Ok(()) if is_inside => Ok(StorageBuffer::from_vec(bytes)),
            _ => Err(Error::OffsetOutOfBounds(offset)),
        }
    }
}

/// The arrays of numbers, fields of structures by `structure.field`.
///
/// An array of m x n lies there as a dataset of n x m, whose order is that of MATLAB: column by column.
///
/// # Errors
///
/// What is wrong with the file, or that it takes more than `allowance`.
pub(crate) fn arrays(file: File, allowance: &mut Allowance) -> io::Result<Vec<Array>> {
    let length = file.metadata()?.len().saturating_sub(HEADER);
    let storage = Arc::new(Behind { file: Mutex::new(file), length });
    let options = OpenOptions {
        chunk_cache_bytes: CACHE,
        filter_registry: Some(filters(Allowance::of(length))),
        ..OpenOptions::default()
    };
    let file = Hdf5File::from_storage_with_options(storage, options).map_err(io::Error::other)?;
    let mut reading = Reading { allowance, structures: 0, arrays: Vec::new() };
    reading.group(&file.root_group().map_err(io::Error::other)?, "", DEEPEST)?;
    Ok(reading.arrays)
}

/// The filters of chunks. What deflate unpacks is taken from the allowance: that of the crate has no end.
fn filters(allowance: Allowance) -> FilterRegistry {
    let left = Mutex::new(allowance);
    let mut filters = FilterRegistry::new();
    let deflate = move |packed: &[u8]| -> Result<Vec<u8>, Error> {
        let told = |error: &dyn ToString| Error::DecompressionError(error.to_string());
        let mut left = left.lock().map_err(|e| told(&e))?;
        let (mut source, mut unpacked) = (ZlibDecoder::new(packed), Vec::new());
        let mut piece = [0; 1 << 12];
        loop {
            let length = source.read(&mut piece).map_err(|e| told(&e))?;
            if length == 0 {
                return Ok(unpacked);
            }
            left.take(length as u64).map_err(|_| told(&TOO_LARGE))?;
            unpacked.extend_from_slice(&piece[..length]);
        }
    };
    filters.register(DEFLATE, Box::new(move |_, packed, _| deflate(packed)));
    for number in UNUSED {
        let refuse = move |_: &_, _: &[u8], _| Err(Error::UnsupportedFilter(number.to_string()));
        filters.register(number, Box::new(refuse));
    }
    filters
}

struct Reading<'a> {
    allowance: &'a mut Allowance,
    /// Structures so far.
    structures: usize,
    arrays: Vec<Array>,
}

impl Reading<'_> {
    /// The arrays of a group, and of structures in it.
    fn group(&mut self, group: &Group, prefix: &str, deepest: usize) -> io::Result<()> {
        let (groups, datasets) = group.members().map_err(io::Error::other)?;
        for dataset in &datasets {
            if self.arrays.len() < MOST {
                let name = format!("{prefix}{}", dataset.name());
                let array = self.array(dataset, name)?;
                self.arrays.extend(array);
            }
        }
        for group in groups.iter().filter(|_| deepest > 0) {
            // `#refs#` holds what cells refer to, `#subsystem#` objects; a sparse array is a group as well.
            let is_sparse = group.attribute("MATLAB_sparse").is_ok();
            self.structures += 1;
            if self.structures < MOST && !group.name().starts_with('#') && !is_sparse {
                self.group(group, &format!("{prefix}{}.", group.name()), deepest - 1)?;
            }
        }
        Ok(())
    }

    /// The array of a dataset; none of what holds no numbers or is no table.
    fn array(&mut self, dataset: &Dataset, name: String) -> io::Result<Option<Array>> {
        let class = dataset.attribute("MATLAB_class").and_then(|class| class.read_string());
        let is_other = matches!(class.as_deref(), Ok("char" | "cell" | "function_handle"))
            || dataset.attribute("MATLAB_empty").is_ok();
        let &[columns, rows] = dataset.shape() else { return Ok(None) };
        if is_other {
            return Ok(None);
        }
        // The numbers as they lie there and as they are read.
        let bytes = rows.saturating_mul(columns).saturating_mul(16);
        self.allowance.take(bytes).map_err(|_| io::Error::other(TOO_LARGE))?;
        let numbers = numbers(dataset).map_err(io::Error::other)?;
        Ok(numbers.map(|numbers| Array { name, rows, columns, numbers }))
    }
}

/// The numbers of a dataset, in its order; none of a type that is none of MATLAB's.
fn numbers(dataset: &Dataset) -> Result<Option<Vec<f64>>, Error> {
    fn of<T: H5Type + Copy>(
        dataset: &Dataset,
        convert: impl Fn(T) -> f64,
    ) -> Result<Option<Vec<f64>>, Error> {
        Ok(Some(dataset.read_array::<T>()?.iter().map(|&x| convert(x)).collect()))
    }
    match *dataset.dtype() {
        Datatype::FloatingPoint { size: 8, .. } => of::<f64>(dataset, |x| x),
        Datatype::FloatingPoint { size: 4, .. } => of::<f32>(dataset, f64::from),
        Datatype::FixedPoint { size: 1, signed: true, .. } => of::<i8>(dataset, f64::from),
        Datatype::FixedPoint { size: 1, signed: false, .. } => of::<u8>(dataset, f64::from),
        Datatype::FixedPoint { size: 2, signed: true, .. } => of::<i16>(dataset, f64::from),
        Datatype::FixedPoint { size: 2, signed: false, .. } => of::<u16>(dataset, f64::from),
        Datatype::FixedPoint { size: 4, signed: true, .. } => of::<i32>(dataset, f64::from),
        Datatype::FixedPoint { size: 4, signed: false, .. } => of::<u32>(dataset, f64::from),
        Datatype::FixedPoint { size: 8, signed: true, .. } => of::<i64>(dataset, |x| x as f64),
        Datatype::FixedPoint { size: 8, signed: false, .. } => of::<u64>(dataset, |x| x as f64),
        _ => Ok(None),
    }
}
