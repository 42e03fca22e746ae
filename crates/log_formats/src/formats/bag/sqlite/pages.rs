//! Pages of a SQLite database, read only. Offsets and sizes are from "Database File Format", sqlite.org/fileformat2.

use std::{
    fs::File,
    io::{Read, Seek, SeekFrom},
};

/// Size of the header at the beginning of the first page (bytes).
pub(crate) const HEADER: usize = 100;

/// The pages of a database. Each page is read at most once: more reads than pages mean damage.
pub(crate) struct Pages<'a> {
    file: &'a File,
    /// Size of a page (bytes).
    size: usize,
    /// Used bytes of a page, without the reserved ones at its end.
    usable: usize,
    /// Number of pages that may still be read, at first that of the file.
    left: u64,
    /// Number of bytes that further rows may have, at first that of the file.
    left_bytes: u64,
}

impl<'a> Pages<'a> {
    /// Opens a file that begins as a database.
    ///
    /// # Errors
    ///
    /// What is wrong with the header.
    pub(crate) fn new(mut file: &'a File) -> Result<Self, String> {
        let length = file.metadata().map_err(|e| e.to_string())?.len();
        let mut header = [0; HEADER];
        file.rewind().map_err(|e| e.to_string())?;
        file.read_exact(&mut header).map_err(|e| e.to_string())?;
        let size = match u16::from_be_bytes([header[16], header[17]]) {
            1 => 65536,
            size => usize::from(size),
        };
        if !size.is_power_of_two() || size < 512 {
            return Err(format!(
                "its pages have {size} bytes, a power of 2 from 512 on was expected"
            ));
        }
        let usable = size - usize::from(header[20]);
        if usable < 480 {
            return Err(format!("{usable} bytes of a page are used, 480 or more were expected"));
        }
        if !matches!(header[56..60], [0, 0, 0, 0 | 1]) {
            return Err("its text is in UTF-16, UTF-8 was expected".to_owned());
        }
        Ok(Self { file, size, usable, left: length.div_ceil(size as u64), left_bytes: length })
    }

    /// Used bytes of a page, without the reserved ones at its end.
    pub(crate) fn usable(&self) -> usize {
        self.usable
    }

    /// A page, counted from 1, without the unused bytes at its end.
    ///
    /// # Errors
    ///
    /// What is wrong: the file ends before the page, or more pages were read than the file has.
    pub(crate) fn read(&mut self, number: u32) -> Result<Vec<u8>, String> {
        let before = number.checked_sub(1).ok_or("there is no page 0")?;
        self.left = self.left.checked_sub(1).ok_or("a page is in two places")?;
        let mut file = self.file;
        let seek = SeekFrom::Start(u64::from(before) * self.size as u64);
        file.seek(seek).map_err(|e| e.to_string())?;
        let mut page = vec![0; self.usable];
        file.read_exact(&mut page).map_err(|e| format!("page {number}: {e}"))?;
        Ok(page)
    }

    /// Counts the bytes of a row.
    ///
    /// # Errors
    ///
    /// What is wrong, where the rows have more bytes than the file.
    pub(crate) fn take(&mut self, bytes: usize) -> Result<(), String> {
        let left = self.left_bytes.checked_sub(bytes as u64);
        self.left_bytes = left.ok_or("its rows have more bytes than the file")?;
        Ok(())
    }
}

/// An integer of one to nine bytes, seven bits each, the highest first. Returned with the remaining bytes.
pub(crate) fn varint(bytes: &[u8]) -> Option<(i64, &[u8])> {
    let mut value = 0_u64;
    for (index, &byte) in bytes.iter().take(9).enumerate() {
        if index == 8 {
            value = (value << 8) | u64::from(byte);
        } else {
            value = (value << 7) | u64::from(byte & 0x7f);
        }
        if byte < 0x80 || index == 8 {
            return Some((value as i64, &bytes[index + 1..]));
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_whole_number_has_one_to_nine_bytes() {
        assert_eq!(varint(&[0x07, 9]), Some((7, &[9][..])));
        assert_eq!(varint(&[0x81, 0x00]), Some((128, &[][..])));
        assert_eq!(varint(&[0xff; 9]), Some((-1, &[][..])));
        assert_eq!(varint(&[0xff; 8]), None);
        assert_eq!(varint(&[]), None);
    }
}
