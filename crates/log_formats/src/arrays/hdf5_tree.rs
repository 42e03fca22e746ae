//! The arrays of numbers in the groups of an HDF5 file.

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
    arrays::array::{Array, TOO_LARGE},
    common::{allowance::Allowance, bounds::MOST_ENTRIES},
};

/// Most levels of groups that are read.
const DEEPEST: usize = 8;
/// What is said of a file with more groups and arrays than are read.
const TOO_MANY: &str = "it has more than 10000 groups and arrays";
/// Size of the cache of unpacked chunks (bytes).
const CACHE: usize = 1 << 22;
/// Numbers of HDF5 filters: deflate, and two filters that are refused.
const DEFLATE: u16 = 1;
const REFUSED: [u16; 2] = [5, 6];

/// The layout of arrays in HDF5 files of one program.
pub(crate) trait Layout: Sync {
    /// Bytes before the superblock. Addresses in the file are counted from the superblock.
    fn header_bytes(&self) -> u64;

    /// Whether the arrays of a group are read, with names `group.array`.
    fn is_structure(&self, group: &Group) -> bool;

    /// Rows and columns of the array in a dataset; `None` where it has no numbers or is not a table.
    fn shape(&self, dataset: &Dataset) -> Option<[u64; 2]>;

    /// The numbers of a dataset of this shape, sorted column by column.
    fn sort_by_column(&self, numbers: Vec<f64>, shape: [u64; 2]) -> Vec<f64>;
}

/// The part of a file after its header.
struct BehindHeader {
    file: Mutex<File>,
    header_bytes: u64,
    length: u64,
}

impl Storage for BehindHeader {
    fn len(&self) -> u64 {
        self.length
    }

    fn read_range(&self, offset: u64, len: usize) -> Result<StorageBuffer, Error> {
        let is_inside = offset.checked_add(len as u64).is_some_and(|end| end <= self.length);
        let mut bytes = vec![0; if is_inside { len } else { 0 }];
        let mut file = self.file.lock().map_err(|_| Error::OffsetOutOfBounds(offset))?;
        let read = file
            .seek(SeekFrom::Start(self.header_bytes + offset))
            .and_then(|_| file.read_exact(&mut bytes));
        match read {
            Ok(()) if is_inside => Ok(StorageBuffer::from_vec(bytes)),
            _ => Err(Error::OffsetOutOfBounds(offset)),
        }
    }
}

/// The arrays of numbers. An array in a group is named `group.array`.
///
/// # Errors
///
/// What is wrong with the file, or that it needs more than `allowance`.
pub(crate) fn read_arrays(
    file: File,
    layout: &dyn Layout,
    allowance: &mut Allowance,
) -> io::Result<Vec<Array>> {
    let header_bytes = layout.header_bytes();
    let length = file.metadata()?.len().saturating_sub(header_bytes);
    let storage = Arc::new(BehindHeader { file: Mutex::new(file), header_bytes, length });
    let options = OpenOptions {
        chunk_cache_bytes: CACHE,
        filter_registry: Some(filters(Allowance::of(length))),
        ..OpenOptions::default()
    };
    let file = Hdf5File::from_storage_with_options(storage, options).map_err(io::Error::other)?;
    let mut reading = Reading { layout, allowance, met: 0, arrays: Vec::new() };
    reading.group(&file.root_group().map_err(io::Error::other)?, "", DEEPEST)?;
    Ok(reading.arrays)
}

/// The filters of chunks. The output of deflate is counted against the allowance: the crate's own filter has no limit.
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
    for number in REFUSED {
        let refuse = move |_: &_, _: &[u8], _| Err(Error::UnsupportedFilter(number.to_string()));
        filters.register(number, Box::new(refuse));
    }
    filters
}

struct Reading<'a> {
    layout: &'a dyn Layout,
    allowance: &'a mut Allowance,
    /// Number of groups and arrays met so far. A file may link to one of them repeatedly.
    met: usize,
    arrays: Vec<Array>,
}

impl Reading<'_> {
    /// Reads the arrays of a group and of its subgroups.
    fn group(&mut self, group: &Group, prefix: &str, deepest: usize) -> io::Result<()> {
        let (groups, datasets) = group.members().map_err(io::Error::other)?;
        self.met += groups.len() + datasets.len();
        if self.met > MOST_ENTRIES {
            return Err(io::Error::other(TOO_MANY));
        }
        for dataset in &datasets {
            let name = format!("{prefix}{}", dataset.name());
            let array = self.array(dataset, name)?;
            self.arrays.extend(array);
        }
        for group in groups.iter().filter(|group| deepest > 0 && self.layout.is_structure(group)) {
            self.group(group, &format!("{prefix}{}.", group.name()), deepest - 1)?;
        }
        Ok(())
    }

    /// The array in a dataset; `None` where it has no numbers or is not a table.
    fn array(&mut self, dataset: &Dataset, name: String) -> io::Result<Option<Array>> {
        let Some(shape) = self.layout.shape(dataset) else { return Ok(None) };
        let [rows, columns] = shape;
        // The numbers as they lie there and as they are read.
        let bytes = rows.saturating_mul(columns).saturating_mul(16);
        self.allowance.take(bytes).map_err(|_| io::Error::other(TOO_LARGE))?;
        let numbers = numbers(dataset).map_err(io::Error::other)?;
        let numbers = numbers.map(|numbers| self.layout.sort_by_column(numbers, shape));
        Ok(numbers.map(|numbers| Array { name, rows, columns, numbers }))
    }
}

/// The numbers of a dataset, in its order; `None` for a dataset of another type.
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
