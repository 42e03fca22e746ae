//! Rows of a SQLite table: a tree of pages with one cell per row.

use crate::formats::bag::sqlite::pages::{HEADER, Pages, varint};

/// Kinds of pages.
const INNER: u8 = 5;
const LEAF: u8 = 13;
/// Size of the page header before the cell pointers (bytes).
const BEFORE_INNER: usize = 12;
const BEFORE_LEAF: usize = 8;
/// Deepest tree. Each inner page has at least two branches, and there are at most 2³² pages.
const DEEPEST: usize = 33;

/// A row as it is stored in its page.
pub(crate) struct Row<'p> {
    /// The number of the row.
    pub id: i64,
    /// Bytes of the row in the page itself.
    local: &'p [u8],
    /// Size of the whole row (bytes).
    length: usize,
    /// The first overflow page, where the row has any.
    behind: Option<u32>,
}

impl Row<'_> {
    /// The beginning of the record, in which a column may already be found.
    pub(crate) fn beginning(&self) -> &[u8] {
        self.local
    }

    /// The whole record of the row.
    ///
    /// # Errors
    ///
    /// What is wrong with the overflow pages.
    pub(crate) fn record(&self, pages: &mut Pages) -> Result<Vec<u8>, String> {
        pages.take(self.length)?;
        let mut record = self.local.to_vec();
        let mut next = self.behind;
        while record.len() < self.length {
            let number = next.filter(|number| *number > 0).ok_or("a row is cut off")?;
            let page = pages.read(number)?;
            let (behind, content) = page.split_first_chunk::<4>().ok_or("a page is cut off")?;
            record.extend(content.iter().take(self.length - record.len()));
            next = Some(u32::from_be_bytes(*behind));
        }
        Ok(record)
    }
}

/// Passes every row of the table to `take`, in order. The tree of the table begins at page `root`.
///
/// # Errors
///
/// What is wrong with the pages, and the errors of `take`.
pub(crate) fn rows<E: From<String>>(
    pages: &mut Pages,
    root: u32,
    mut take: impl FnMut(&mut Pages, &Row) -> Result<(), E>,
) -> Result<(), E> {
    let mut open: Vec<(u32, Vec<u32>)> = vec![(0, vec![root])];
    while let Some((_, numbers)) = open.last_mut() {
        let Some(number) = numbers.pop() else {
            open.pop();
            continue;
        };
        let page = pages.read(number)?;
        let start = if number == 1 { HEADER } else { 0 };
        match page[start] {
            LEAF => {
                for cell in cells(&page, start, BEFORE_LEAF)? {
                    let row = row(&page, cell, pages.usable())?;
                    take(pages, &row)?;
                }
            }
            INNER if open.len() <= DEEPEST => {
                let right = number_at(&page, start + 8);
                let left = cells(&page, start, BEFORE_INNER)?;
                let mut below: Vec<u32> = left.map(|cell| number_at(&page, cell)).collect();
                below.push(right);
                below.reverse();
                open.push((number, below));
            }
            kind => return Err(format!("page {number} is of the kind {kind}").into()),
        }
    }
    Ok(())
}

/// The offsets of the cells of a page.
fn cells(
    page: &[u8],
    start: usize,
    before: usize,
) -> Result<impl Iterator<Item = usize> + use<'_>, String> {
    let pair = |at: usize| usize::from(u16::from_be_bytes([page[at], page[at + 1]]));
    let (count, first) = (pair(start + 3), start + before);
    let places = page.get(first..first + 2 * count).ok_or("a page has more cells than room")?;
    let place = |pair: &[u8]| usize::from(u16::from_be_bytes([pair[0], pair[1]]));
    Ok(places.chunks_exact(2).map(place))
}

/// The page number in the four bytes at an offset; 0 where the page ends before.
fn number_at(page: &[u8], at: usize) -> u32 {
    let bytes = page.get(at..).and_then(|rest| rest.first_chunk::<4>());
    bytes.map_or(0, |bytes| u32::from_be_bytes(*bytes))
}

/// The row in a cell of a leaf.
///
/// ```text
/// most = usable - 35,   least = (usable - 12) 32 / 255 - 23
/// local = length,                       length <= most
/// local = least + (length - least) mod (usable - 4), or least where that is more than most
/// ```
fn row(page: &[u8], cell: usize, usable: usize) -> Result<Row<'_>, String> {
    let cut = || "a row is cut off".to_owned();
    let (length, rest) = page.get(cell..).and_then(varint).ok_or_else(cut)?;
    let (id, rest) = varint(rest).ok_or_else(cut)?;
    let length = usize::try_from(length).map_err(|_| cut())?;
    let (most, least) = (usable - 35, (usable - 12) * 32 / 255 - 23);
    let local = match length {
        _ if length <= most => length,
        _ => match least + (length - least) % (usable - 4) {
            local if local <= most => local,
            _ => least,
        },
    };
    let (local, rest) = rest.split_at_checked(local).ok_or_else(cut)?;
    let behind = (local.len() < length).then(|| number_at(rest, 0));
    Ok(Row { id, local, length, behind })
}
