use std::io::{self, BufReader, Read};

use crate::{
    common::{bounds::MOST_COLUMNS, numeral::Numeral},
    formats::numpy::npy_header::{IndexOrder, NpyHeader},
};

/// The columns of a NumPy array, and the places of their numbers.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct NumpyArray {
    /// Names of the columns.
    pub columns: Vec<String>,
    /// Number of samples in each column.
    pub samples: u64,
    /// The content of each place in a row, in the order of the columns.
    places: Vec<Place>,
    /// Size of a row (bytes).
    row: usize,
    layout: Layout,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Place {
    at: usize,
    numeral: Numeral,
}

#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Layout {
    RowByRow,
    ColumnByColumn,
}

/// Longest row of records (bytes).
const LONGEST_ROW: u64 = 1 << 20;

impl NumpyArray {
    /// The columns of an array. A named array gives them its name: `tau`, `q[0]`, `log.time`. The columns of
    /// an unnamed array are `column_1` and so on, or the names in its records.
    ///
    /// The first index counts the samples. The second index does so where only its length is
    /// `samples`. `None` where the array is not a table of numbers.
    pub(crate) fn new(
        name: Option<&str>,
        header: &NpyHeader,
        samples: Option<u64>,
    ) -> Option<Self> {
        if header.is_record {
            return Self::of_records(name, header);
        }
        let numeral = header.item.as_ref()?.first()?.item.numeral?;
        let (samples, width, layout) = match *header.shape.as_slice() {
            [samples] => (samples, None, Layout::RowByRow),
            [first, second] => {
                let is_turned = Some(first) != samples && Some(second) == samples;
                let layout = match (header.order, is_turned) {
                    (IndexOrder::C, false) | (IndexOrder::Fortran, true) => Layout::RowByRow,
                    _ => Layout::ColumnByColumn,
                };
                let (samples, width) = if is_turned { (second, first) } else { (first, second) };
                (samples, Some(width), layout)
            }
            _ => return None,
        };
        let count = width.unwrap_or(1);
        // One with more is a picture or a list of features.
        if !(1..=MOST_COLUMNS as u64).contains(&count) {
            return None;
        }
        let column = |k: u64| match (name, width) {
            (None, _) => format!("column_{}", k + 1),
            (Some(name), None) => name.to_owned(),
            (Some(name), Some(_)) => format!("{name}[{k}]"),
        };
        let place = |k: u64| Place { at: k as usize * numeral.bytes(), numeral };
        Some(Self {
            columns: (0..count).map(column).collect(),
            samples,
            places: (0..count).map(place).collect(),
            row: count as usize * numeral.bytes(),
            layout,
        })
    }

    fn of_records(name: Option<&str>, header: &NpyHeader) -> Option<Self> {
        let [samples] = *header.shape.as_slice() else { return None };
        let prefix = name.map(|name| format!("{name}.")).unwrap_or_default();
        let (mut columns, mut places, mut row) = (Vec::new(), Vec::new(), 0_u64);
        for field in header.item.as_ref()? {
            let count = field.count.unwrap_or(1);
            let end = row.checked_add(count.checked_mul(field.item.bytes)?)?;
            if end > LONGEST_ROW {
                return None;
            }
            if let Some(numeral) = field.item.numeral.filter(|_| count <= MOST_COLUMNS as u64) {
                let own = format!("{prefix}{}", field.name);
                columns.extend((0..count).map(|k| match field.count {
                    None => own.clone(),
                    Some(_) => format!("{own}[{k}]"),
                }));
                let at = |k: u64| (row + k * field.item.bytes) as usize;
                places.extend((0..count).map(|k| Place { at: at(k), numeral }));
            }
            row = end;
        }
        let is_table = (1..=MOST_COLUMNS).contains(&columns.len());
        let (row, layout) = (row as usize, Layout::RowByRow);
        is_table.then_some(Self { columns, samples, places, row, layout })
    }

    /// Whether the array has a column of this name.
    pub(crate) fn has(&self, column: &str) -> bool {
        self.columns.iter().any(|name| name == column)
    }

    /// Size of the numbers in a file (bytes); `None` on overflow.
    pub(crate) fn packed_bytes(&self) -> Option<u64> {
        self.samples.checked_mul(self.row as u64)
    }

    /// Size of the numbers in memory (bytes).
    pub(crate) fn unpacked_bytes(&self) -> u64 {
        self.samples.saturating_mul(8).saturating_mul(self.places.len() as u64)
    }

    /// The numbers of every column. `source` begins after the header.
    ///
    /// # Errors
    ///
    /// Errors of the source, and a source that has too few or too many bytes.
    pub(crate) fn read(&self, source: impl Read) -> io::Result<Vec<Vec<f64>>> {
        // Room is made as numbers come, not as many as the header says.
        let mut columns = vec![Vec::new(); self.places.len()];
        let mut source = BufReader::with_capacity(1 << 16, source);
        let mut bytes = vec![0; self.row];
        match self.layout {
            Layout::RowByRow => {
                for _ in 0..self.samples {
                    source.read_exact(&mut bytes)?;
                    for (column, place) in columns.iter_mut().zip(&self.places) {
                        column.push(place.numeral.read(&bytes[place.at..]));
                    }
                }
            }
            Layout::ColumnByColumn => {
                for (column, place) in columns.iter_mut().zip(&self.places) {
                    let bytes = &mut bytes[..place.numeral.bytes()];
                    for _ in 0..self.samples {
                        source.read_exact(bytes)?;
                        column.push(place.numeral.read(bytes));
                    }
                }
            }
        }
        // The end of an entry of a zip archive is where its checksum is looked at.
        match source.bytes().next().transpose()? {
            None => Ok(columns),
            Some(_) => {
                Err(io::Error::new(io::ErrorKind::InvalidData, "it is longer than its header says"))
            }
        }
    }
}
