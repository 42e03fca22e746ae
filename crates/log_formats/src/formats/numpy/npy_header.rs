use std::io::{self, Read};

use crate::{common::numeral::Item, formats::numpy::literal::Literal};

/// The header of a NumPy array.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct NpyHeader {
    pub shape: Vec<u64>,
    pub order: IndexOrder,
    /// The fields of an item; `None` where the items have a type that is not supported.
    pub item: Option<Vec<Field>>,
    /// Whether the fields have names.
    pub is_record: bool,
    /// Size of the header's text (bytes).
    pub length: u64,
}

/// The index that varies fastest.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum IndexOrder {
    /// The last index.
    C,
    /// The first index.
    Fortran,
}

/// A field of an item: `count` values of one type.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct Field {
    /// Name of the field; empty where the item is not a record.
    pub name: String,
    /// Number of values; `None` where the field is not an array.
    pub count: Option<u64>,
    pub item: Item,
}

/// First bytes of an npy file.
pub(crate) const MAGIC: &[u8] = b"\x93NUMPY";
/// Longest header that is read (bytes). NumPy itself refuses more than 10 000.
const LONGEST: u64 = 1 << 16;

impl NpyHeader {
    /// Reads the header. The numbers follow it in `source`.
    pub(crate) fn read(mut source: impl Read) -> io::Result<Self> {
        let mut start = [0; 8];
        source.read_exact(&mut start)?;
        let version = start.strip_prefix(MAGIC).ok_or_else(|| wrong("it does not begin as one"))?;
        let length = match version {
            [1, _] => {
                let mut length = [0; 2];
                source.read_exact(&mut length)?;
                u64::from(u16::from_le_bytes(length))
            }
            [2 | 3, _] => {
                let mut length = [0; 4];
                source.read_exact(&mut length)?;
                u64::from(u32::from_le_bytes(length))
            }
            _ => return Err(wrong("its version is unknown")),
        };
        if length > LONGEST {
            return Err(wrong("its header is too long"));
        }
        let mut text = Vec::new();
        source.take(length).read_to_end(&mut text)?;
        // Latin-1 before version 3.
        let text = String::from_utf8(text)
            .unwrap_or_else(|e| e.as_bytes().iter().copied().map(char::from).collect());
        let header = Self::parse(&text, length);
        header.ok_or_else(|| wrong("its header cannot be read"))
    }

    fn parse(text: &str, length: u64) -> Option<Self> {
        let header = Literal::parse(text)?;
        let order = match header.get("fortran_order")? {
            Literal::Truth(true) => IndexOrder::Fortran,
            Literal::Truth(false) => IndexOrder::C,
            _ => return None,
        };
        let shape = shape(header.get("shape")?)?;
        let (item, is_record) = match header.get("descr")? {
            Literal::Text(code) => {
                let field = |item| vec![Field { name: String::new(), count: None, item }];
                (Item::of(code).map(field), false)
            }
            Literal::Sequence(fields) => (fields.iter().map(field).collect(), true),
            _ => return None,
        };
        Some(Self { shape, order, item, is_record, length })
    }
}

/// `('q', '<f8')`, `('q', '<f8', (6,))` or `(('title', 'q'), '<f8')`.
fn field(literal: &Literal) -> Option<Field> {
    let Literal::Sequence(parts) = literal else { return None };
    let (name, code, shape_of) = match parts.as_slice() {
        [name, Literal::Text(code)] => (name, code, None),
        [name, Literal::Text(code), counts] => (name, code, Some(shape(counts)?)),
        _ => return None,
    };
    let name = match name {
        Literal::Text(name) => name,
        Literal::Sequence(names) => match names.as_slice() {
            [_, Literal::Text(name)] => name,
            _ => return None,
        },
        _ => return None,
    };
    let count = match shape_of {
        Some(counts) => Some(product(&counts)?),
        None => None,
    };
    // A message stays one line, whatever the file holds.
    let name = name.replace(char::is_control, "?");
    Some(Field { name, count, item: Item::of(code)? })
}

fn shape(literal: &Literal) -> Option<Vec<u64>> {
    let Literal::Sequence(lengths) = literal else { return None };
    let length = |length: &Literal| match length {
        Literal::Count(count) => Some(*count),
        _ => None,
    };
    lengths.iter().map(length).collect()
}

/// The product of lengths; `None` on overflow.
fn product(lengths: &[u64]) -> Option<u64> {
    lengths.iter().try_fold(1_u64, |product, &length| product.checked_mul(length))
}

fn wrong(reason: &str) -> io::Error {
    io::Error::new(io::ErrorKind::InvalidData, reason)
}
