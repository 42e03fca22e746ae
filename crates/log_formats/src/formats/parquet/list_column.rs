//! Columns of lists: each row has one list, with one number per joint.

use std::sync::Arc;

use arrow_array::{Array, ArrayRef, Float64Array, cast::AsArray};

use crate::formats::parquet::array_numbers::append;

/// Longest list whose numbers become columns. Longer ones are images and the like.
const WIDEST: usize = 256;

/// Name of the column with the `k`-th number of each list.
pub(crate) fn part_name(column: &str, k: usize) -> String {
    format!("{column}[{k}]")
}

/// Length of the first list in a column; `None` where the column has no lists, or too long ones.
pub(crate) fn width(array: &dyn Array) -> Option<usize> {
    let width = widths(array)?.next()?;
    (width <= WIDEST).then_some(width)
}

/// Lengths of all lists.
fn widths(array: &dyn Array) -> Option<impl Iterator<Item = usize>> {
    let offsets = array.as_list_opt::<i32>()?.value_offsets();
    Some(offsets.windows(2).map(|pair| usize::try_from(pair[1] - pair[0]).unwrap_or(0)))
}

/// The columns in an array: the array itself, or for lists one column for the `k`-th numbers of all lists.
///
/// # Errors
///
/// The lengths found, where they differ between lists.
pub(crate) fn parts(name: &str, array: &ArrayRef) -> Result<Vec<(String, ArrayRef)>, String> {
    let Some(lists) = array.as_list_opt::<i32>() else {
        return Ok(vec![(name.to_owned(), array.clone())]);
    };
    let first = widths(lists).and_then(|mut w| w.next()).unwrap_or(0);
    if let Some(other) = widths(lists).and_then(|mut widths| widths.find(|w| *w != first)) {
        return Err(format!("lists of {first} and of {other} numbers"));
    }
    if first > WIDEST {
        return Ok(Vec::new());
    }
    let start = lists.value_offsets().first().map_or(0, |&at| usize::try_from(at).unwrap_or(0));
    let entries = lists.values().slice(start, first * lists.len());
    let mut numbers = Vec::new();
    append(&entries, &mut numbers);
    let part = |k: usize| -> ArrayRef {
        let every = (k..numbers.len()).step_by(first.max(1));
        let of = |at: usize| entries.is_valid(at).then(|| numbers[at]);
        Arc::new(every.map(of).collect::<Float64Array>())
    };
    Ok((0..first).map(|k| (part_name(name, k), part(k))).collect())
}
