//! Elements of a MAT-file of version 5. An element is a tag of type and length, then data padded to 8 bytes.

use std::io::{self, ErrorKind, Read};

use flate2::read::ZlibDecoder;

use crate::{
    arrays::array::{Array, TOO_LARGE},
    common::{
        allowance::Allowance,
        numeral::{Item, Numeral},
    },
};

/// Types of elements.
const CHARACTERS: u32 = 1;
const MATRIX: u32 = 14;
const COMPRESSED: u32 = 15;

/// Classes of arrays.
const STRUCT: u32 = 2;
const NUMBERS: std::ops::RangeInclusive<u32> = 6..=15;

/// Most levels of nested structures that are read.
const DEEPEST: usize = 4;
/// Longest list of names or dimensions (bytes).
const LONGEST: u32 = 1 << 20;
/// Bytes counted for each byte of a list of names.
const PER_NAME_BYTE: u64 = 32;
/// Byte order of a file.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Order {
    Little,
    Big,
}

impl Order {
    fn u32(self, bytes: [u8; 4]) -> u32 {
        match self {
            Self::Little => u32::from_le_bytes(bytes),
            Self::Big => u32::from_be_bytes(bytes),
        }
    }

    /// Layout of the numbers in an element of a type.
    fn numeral(self, kind: u32) -> Option<Numeral> {
        let code = match kind {
            1 => "i1",
            2 => "u1",
            3 => "i2",
            4 => "u2",
            5 => "i4",
            6 => "u4",
            7 => "f4",
            9 => "f8",
            12 => "i8",
            13 => "u8",
            _ => return None,
        };
        let order = if self == Self::Little { '<' } else { '>' };
        Item::of(&format!("{order}{code}"))?.numeral
    }
}

fn broken(reason: impl Into<String>) -> io::Error {
    io::Error::new(ErrorKind::InvalidData, reason.into())
}

/// Tag of an element. A short element has its data in the second half of the tag.
struct Tag {
    kind: u32,
    bytes: u32,
    short: Option<[u8; 4]>,
}

impl Tag {
    fn read(source: &mut dyn Read, order: Order) -> io::Result<Self> {
        let (mut first, mut second) = ([0; 4], [0; 4]);
        source.read_exact(&mut first)?;
        source.read_exact(&mut second)?;
        let word = order.u32(first);
        Ok(match word >> 16 {
            0 => Self { kind: word, bytes: order.u32(second), short: None },
            bytes if bytes <= 4 => Self { kind: word & 0xffff, bytes, short: Some(second) },
            bytes => return Err(broken(format!("a short element has {bytes} bytes, 4 at most"))),
        })
    }

    /// Number of padding bytes after the data of an element, where it is not a matrix.
    fn padding(&self) -> usize {
        if self.short.is_some() { 0 } else { (8 - self.bytes as usize % 8) % 8 }
    }
}

/// Reads the elements of one file.
pub(crate) struct Elements<'a> {
    pub order: Order,
    pub allowance: &'a mut Allowance,
}

impl Elements<'_> {
    /// The arrays of the next element in `source`, and its length including the tag (bytes);
    /// `None` at the end.
    pub fn next(&mut self, source: &mut dyn Read) -> io::Result<Option<(Vec<Array>, u64)>> {
        let tag = match Tag::read(source, self.order) {
            Ok(tag) => tag,
            Err(error) if error.kind() == ErrorKind::UnexpectedEof => return Ok(None),
            Err(error) => return Err(error),
        };
        let length = 8 + u64::from(tag.bytes);
        let mut own = source.take(tag.bytes.into());
        let mut arrays = vec![];
        match tag.kind {
            MATRIX => self.matrix(&mut own, "", 0, &mut arrays)?,
            COMPRESSED => {
                let mut unpacked = ZlibDecoder::new(own);
                let inner = Tag::read(&mut unpacked, self.order)?;
                if inner.kind == MATRIX {
                    let mut own = unpacked.take(inner.bytes.into());
                    self.matrix(&mut own, "", 0, &mut arrays)?;
                }
            }
            _ => {}
        }
        Ok(Some((arrays, length)))
    }

    /// The arrays of numbers in a matrix: the matrix itself, or the fields of a structure.
    fn matrix(
        &mut self,
        source: &mut dyn Read,
        prefix: &str,
        depth: usize,
        arrays: &mut Vec<Array>,
    ) -> io::Result<()> {
        let flags = self.bytes(source)?;
        let class = flags.first_chunk().map(|word| self.order.u32(*word) & 0xff);
        let sizes = self.bytes(source)?;
        let sizes: Vec<u64> = sizes
            .chunks_exact(4)
            .filter_map(|word| word.first_chunk())
            .map(|word| u64::from(self.order.u32(*word)))
            .collect();
        let name = self.bytes(source)?;
        let name = String::from_utf8_lossy(&name).replace(char::is_control, "?");
        let name = format!("{prefix}{name}");
        let [rows, columns] = *sizes.as_slice() else { return Ok(()) };
        match class {
            Some(class) if NUMBERS.contains(&class) => {
                let numbers = self.numbers(source, rows.saturating_mul(columns))?;
                arrays.push(Array { name, rows, columns, numbers });
                Ok(())
            }
            Some(STRUCT) if (rows, columns) == (1, 1) && depth < DEEPEST => {
                self.fields(source, &name, depth, arrays)
            }
            _ => Ok(()),
        }
    }

    fn fields(
        &mut self,
        source: &mut dyn Read,
        name: &str,
        depth: usize,
        arrays: &mut Vec<Array>,
    ) -> io::Result<()> {
        let width = self.bytes(source)?;
        let width = width.first_chunk().map_or(0, |word| self.order.u32(*word) as usize);
        let names = self.bytes(source)?;
        if width == 0 {
            return Ok(());
        }
        for field in names.chunks(width) {
            let field: Vec<u8> = field.iter().copied().take_while(|&byte| byte != 0).collect();
            let field = String::from_utf8_lossy(&field).replace(char::is_control, "?");
            let tag = Tag::read(source, self.order)?;
            if tag.kind != MATRIX {
                return Err(broken(format!("the field {field} of {name} is no array")));
            }
            let mut own = Read::take(&mut *source, tag.bytes.into());
            // A field has no name of its own.
            self.matrix(&mut own, &format!("{name}.{field}"), depth + 1, arrays)?;
            io::copy(&mut own, &mut io::sink())?;
        }
        Ok(())
    }

    /// The data of a short list.
    fn bytes(&mut self, source: &mut dyn Read) -> io::Result<Vec<u8>> {
        let tag = Tag::read(source, self.order)?;
        if let Some(short) = tag.short {
            return Ok(short[..tag.bytes as usize].to_vec());
        }
        if tag.bytes > LONGEST || tag.kind > 6 || tag.kind < CHARACTERS {
            let Tag { kind, bytes, .. } = tag;
            return Err(broken(format!("a list of type {kind} has {bytes} bytes")));
        }
        let cost = PER_NAME_BYTE * u64::from(tag.bytes);
        self.allowance.take(cost).map_err(|_| broken("its names take more than is allowed"))?;
        let mut bytes = vec![0; tag.bytes as usize];
        source.read_exact(&mut bytes)?;
        source.read_exact(&mut [0; 8][..tag.padding()])?;
        Ok(bytes)
    }

    /// The numbers of an array; their count is the product of its dimensions.
    fn numbers(&mut self, source: &mut dyn Read, count: u64) -> io::Result<Vec<f64>> {
        let tag = Tag::read(source, self.order)?;
        let numeral = self.order.numeral(tag.kind);
        let numeral = numeral.ok_or_else(|| broken(format!("numbers of type {}", tag.kind)))?;
        if count.checked_mul(numeral.bytes() as u64) != Some(u64::from(tag.bytes)) {
            return Err(broken(format!("{count} numbers in {} bytes", tag.bytes)));
        }
        let taken = self.allowance.take(8 * count);
        taken.map_err(|_| broken(TOO_LARGE))?;
        if let Some(short) = tag.short {
            let own = short[..tag.bytes as usize].chunks_exact(numeral.bytes());
            return Ok(own.map(|bytes| numeral.read(bytes)).collect());
        }
        // Room is made as numbers come, not as many as the tag says.
        let mut numbers = vec![];
        let mut block = [0; 1 << 13];
        let mut left = tag.bytes as usize;
        while left > 0 {
            let now = left.min(block.len());
            source.read_exact(&mut block[..now])?;
            numbers.extend(block[..now].chunks_exact(numeral.bytes()).map(|b| numeral.read(b)));
            left -= now;
        }
        source.read_exact(&mut [0; 8][..tag.padding()]).or_else(|error| {
            // The last element of a matrix may go without what fills it up.
            if error.kind() == ErrorKind::UnexpectedEof { Ok(()) } else { Err(error) }
        })?;
        Ok(numbers)
    }
}
