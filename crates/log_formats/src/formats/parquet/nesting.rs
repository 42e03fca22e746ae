//! How deep the schema of a Parquet file nests, told without following it: the decoder follows it on the stack.
//!
//! ```text
//! ... | footer | length of the footer (4 bytes) | PAR1
//! footer: Thrift in its compact form, field 2 the list of schema elements, depth first;
//!         field 5 of each is the number of its children
//! ```

use std::{
    fs::File,
    io::{self, Read, Seek, SeekFrom},
};

/// Most groups within one another: a log has columns, and lists of numbers.
const MOST: usize = 32;
/// Length of what stands behind the footer (bytes).
const BEHIND: u64 = 8;
/// Largest footer that is read (bytes).
const LARGEST: u64 = 1 << 26;
/// Field of the schema in the footer, and of the number of children in its elements.
const SCHEMA: i64 = 2;
const CHILDREN: i64 = 5;

/// Why a footer is not followed.
const NOT_FOLLOWED: &str = "its footer cannot be followed";

/// Types of fields in Thrift's compact form that are looked into.
const INTEGER: u8 = 5;
const LIST: u8 = 9;
const STRUCTURE: u8 = 12;

/// Refuses a Parquet file whose schema nests deeper than any table, before its decoder follows it.
///
/// # Errors
///
/// A sentence about the footer. A file without one is left to the decoder.
pub fn check_parquet_nesting(file: &File) -> Result<(), String> {
    let Some(footer) = footer(file).map_err(|e| e.to_string())? else { return Ok(()) };
    let mut reader = Compact { bytes: &footer };
    let schemas = |id, kind, reader: &mut Compact| match (id, kind) {
        (SCHEMA, LIST) => schema(reader).map(Some),
        _ => reader.skip(kind, 0).map(|()| None),
    };
    match reader.fields(schemas) {
        None => Err(NOT_FOLLOWED.to_owned()),
        Some(found) if found.iter().any(|deepest| *deepest > MOST) => {
            Err(format!("its columns are nested more than {MOST} deep"))
        }
        Some(_) => Ok(()),
    }
}

/// The footer, where there is one that is whole.
fn footer(mut file: &File) -> io::Result<Option<Vec<u8>>> {
    let length = file.seek(SeekFrom::End(0))?;
    let Some(start_of_end) = length.checked_sub(BEHIND) else { return Ok(None) };
    let mut end = [0; BEHIND as usize];
    file.seek(SeekFrom::Start(start_of_end))?;
    file.read_exact(&mut end)?;
    let [a, b, c, d, ..] = end;
    let bytes = u64::from(u32::from_le_bytes([a, b, c, d]));
    let Some(start) = start_of_end.checked_sub(bytes).filter(|_| bytes <= LARGEST) else {
        return Ok(None);
    };
    let mut footer = vec![0; bytes as usize];
    file.seek(SeekFrom::Start(start))?;
    file.read_exact(&mut footer)?;
    file.rewind()?;
    Ok(Some(footer))
}

/// The greatest number of groups within one another in a list of elements, at most one more than are read.
fn schema(reader: &mut Compact) -> Option<usize> {
    let (count, kind) = reader.list()?;
    // Children that are still to come, of each group that is open.
    let (mut open, mut deepest) = (Vec::new(), 0);
    for _ in 0..count {
        let children = match kind {
            STRUCTURE => reader.children()?,
            _ => return None,
        };
        while open.last() == Some(&0) {
            open.pop();
        }
        if let Some(left) = open.last_mut() {
            *left -= 1;
        }
        if children > 0 && deepest <= MOST {
            open.push(children);
            deepest = deepest.max(open.len());
        }
    }
    Some(deepest)
}

/// Bytes of Thrift's compact form. What is none of it is `None`.
struct Compact<'a> {
    bytes: &'a [u8],
}

impl Compact<'_> {
    /// What `each` gives for the fields of a structure, by their numbers and types.
    fn fields<T>(
        &mut self,
        each: impl Fn(i64, u8, &mut Self) -> Option<Option<T>>,
    ) -> Option<Vec<T>> {
        let (mut id, mut found) = (0_i64, Vec::new());
        loop {
            let head = self.byte()?;
            if head == 0 {
                return Some(found);
            }
            id = match i64::from(head >> 4) {
                0 => self.integer()?,
                more => id.checked_add(more)?,
            };
            found.extend(each(id, head & 15, self)?);
        }
    }

    /// The number of children of a schema element; 0 without one.
    fn children(&mut self) -> Option<u64> {
        let children = self.fields(|id, kind, reader| match (id, kind) {
            (CHILDREN, INTEGER) => reader.integer().map(Some),
            _ => reader.skip(kind, 0).map(|()| None),
        })?;
        let most = children.into_iter().max().unwrap_or(0);
        Some(u64::try_from(most).unwrap_or(0))
    }

    /// The length of a list and the type of its entries.
    fn list(&mut self) -> Option<(u64, u8)> {
        let head = self.byte()?;
        let count = match head >> 4 {
            15 => self.varint()?,
            count => u64::from(count),
        };
        // An entry has at least one byte.
        (count <= self.bytes.len() as u64).then_some((count, head & 15))
    }

    fn skip(&mut self, kind: u8, depth: usize) -> Option<()> {
        if depth > MOST {
            return None;
        }
        match kind {
            1 | 2 => Some(()),
            3 => self.take(1),
            4..=6 => self.varint().map(drop),
            7 => self.take(8),
            8 => {
                let length = self.varint()?;
                self.take(length)
            }
            9 | 10 => {
                let (count, kind) = self.list()?;
                (0..count).try_for_each(|_| self.skip_entry(kind, depth))
            }
            11 => self.skip_map(depth),
            STRUCTURE => self
                .fields(|_, kind, reader| reader.skip(kind, depth + 1).map(|()| None::<()>))
                .map(drop),
            _ => None,
        }
    }

    fn skip_map(&mut self, depth: usize) -> Option<()> {
        let count = self.varint().filter(|count| *count <= self.bytes.len() as u64)?;
        if count == 0 {
            return Some(());
        }
        let kinds = self.byte()?;
        (0..count).try_for_each(|_| {
            self.skip_entry(kinds >> 4, depth)?;
            self.skip_entry(kinds & 15, depth)
        })
    }

    /// An entry of a list or a map, where a truth value has a byte of its own.
    fn skip_entry(&mut self, kind: u8, depth: usize) -> Option<()> {
        match kind {
            1 | 2 => self.take(1),
            _ => self.skip(kind, depth + 1),
        }
    }

    fn byte(&mut self) -> Option<u8> {
        let (first, rest) = self.bytes.split_first()?;
        self.bytes = rest;
        Some(*first)
    }

    fn take(&mut self, count: u64) -> Option<()> {
        self.bytes = self.bytes.get(usize::try_from(count).ok()?..)?;
        Some(())
    }

    /// An unsigned number, seven bits a byte, the lowest first.
    fn varint(&mut self) -> Option<u64> {
        let mut number = 0_u64;
        for shift in (0..64).step_by(7) {
            let byte = self.byte()?;
            number |= u64::from(byte & 127) << shift;
            if byte & 128 == 0 {
                return Some(number);
            }
        }
        None
    }

    /// A signed number, whose sign is its lowest bit.
    fn integer(&mut self) -> Option<i64> {
        let number = self.varint()?;
        let half = i64::try_from(number >> 1).ok()?;
        Some(if number & 1 == 0 { half } else { !half })
    }
}

#[cfg(test)]
mod tests {
    use std::io::Write;

    use super::*;

    /// A file with nothing but a footer, whose schema is a chain of groups with one column.
    fn chain(groups: usize) -> File {
        let group = b"\x48\x01g\x15\x02\x00";
        let mut footer = b"\x15\x02\x19\xfc".to_vec();
        let mut count = groups + 1;
        while count > 127 {
            footer.push((count & 127) as u8 | 128);
            count >>= 7;
        }
        footer.push(count as u8);
        (0..groups).for_each(|_| footer.extend(group));
        footer.extend(b"\x15\x0a\x38\x01x\x00\x16\x00\x19\x0c\x00");
        let length = u32::try_from(footer.len()).unwrap().to_le_bytes();
        let mut file = tempfile::tempfile().unwrap();
        [&b"PAR1"[..], &footer, &length, b"PAR1"]
            .iter()
            .for_each(|part| file.write_all(part).unwrap());
        file
    }

    #[test]
    fn groups_within_groups_are_read_to_a_depth_and_refused_beyond() {
        assert_eq!(check_parquet_nesting(&chain(MOST)), Ok(()));
        for groups in [MOST + 1, 200_000] {
            let told = check_parquet_nesting(&chain(groups)).unwrap_err();
            assert_eq!(told, "its columns are nested more than 32 deep");
        }
    }

    #[test]
    fn structures_that_are_skipped_nest_to_a_depth_too() {
        let mut bytes = vec![0x1c; 100_000];
        bytes.extend(vec![0; 100_001]);
        assert_eq!(Compact { bytes: &bytes }.skip(STRUCTURE, 0), None);
        assert_eq!(Compact { bytes: b"\x1c\x1c\0\0\0" }.skip(STRUCTURE, 0), Some(()));
    }
}
