use std::collections::{BTreeMap, BTreeSet};

use crate::common::bounds::{MOST, TableSize};
use crate::common::excerpt::ExcerptFilter;

/// The columns of a log that become signals.
pub struct Needed<'a> {
    /// The column of time.
    pub time: &'a str,
    /// The columns of the signals.
    pub signals: BTreeSet<&'a str>,
    /// The rows that are read; `None` for all.
    pub excerpt: Option<ExcerptFilter>,
}

impl Needed<'_> {
    pub(crate) fn contains(&self, column: &str) -> bool {
        self.time == column || self.signals.contains(column)
    }
}

/// The numbers of a log.
#[derive(Debug, Default)]
pub struct Table {
    /// Columns by name, all of one length.
    pub columns: BTreeMap<String, Vec<f64>>,
    /// The row of the file for each sample; empty where no row was left out.
    pub rows: Vec<usize>,
}

impl Table {
    /// The rows of the excerpt, from a table that was read as a whole.
    pub(crate) fn excerpt(mut self, needed: &Needed) -> Self {
        let (Some(mut filter), Some(time)) =
            (needed.excerpt.clone(), self.columns.get(needed.time))
        else {
            return self;
        };
        let is_outside = |k: &usize| !filter.takes(time[*k]);
        let outside: Vec<usize> = (0..time.len()).filter(is_outside).collect();
        self.leave_out(&outside);
        self
    }

    /// Keeps only the first samples.
    pub fn truncate(&mut self, samples: usize) {
        self.columns.values_mut().for_each(|column| column.truncate(samples));
        self.rows.truncate(samples);
    }

    /// The row of the file for a sample, counted from 1.
    pub fn row(&self, sample: usize) -> usize {
        self.rows.get(sample).copied().unwrap_or(sample + 1)
    }

    /// Removes the given samples, listed in rising order.
    pub fn leave_out(&mut self, samples: &[usize]) {
        let rows = self.columns.values().map(Vec::len).max().unwrap_or(0);
        let is_left = |k: &usize| samples.binary_search(k).is_err();
        self.rows = (0..rows).filter(is_left).map(|k| self.row(k)).collect();
        for column in self.columns.values_mut() {
            let mut k = 0..;
            column.retain(|_| k.next().is_some_and(|k| is_left(&k)));
        }
    }
}

/// The content of one row in one column.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum TableCell {
    Number(f64),
    Empty,
    Text,
}

/// A table that is filled row by row.
///
/// A row without any signal is left out: it belongs to another topic, recorded between the messages of the joints. A
/// column that is not needed is kept only if it has a number in all other rows.
pub(crate) struct Rows {
    excerpt: Option<ExcerptFilter>,
    columns: Vec<Column>,
    rows: Vec<usize>,
    most: TableSize,
}

/// Why a row is refused.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum RowRefusal {
    /// The needed column of this index has no number in it.
    NoNumber(usize),
    /// The table has as many rows as are read.
    TooMany,
}

struct Column {
    name: String,
    use_of_it: Use,
    samples: Option<Vec<f64>>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Use {
    Time,
    Signal,
    Further,
}

impl Rows {
    /// A table with these columns. A column without a name is left out.
    pub(crate) fn new(names: &[String], needed: &Needed) -> Self {
        let column = |name: &String| Column {
            name: name.clone(),
            use_of_it: match name.as_str() {
                name if needed.signals.contains(name) => Use::Signal,
                name if needed.time == name => Use::Time,
                _ => Use::Further,
            },
            samples: (!name.is_empty()).then(Vec::new),
        };
        let columns = names.iter().map(column).collect();
        Self { excerpt: needed.excerpt.clone(), columns, rows: Vec::new(), most: MOST }
    }

    /// Adds a row of the file, counted from 1, with one cell per column.
    ///
    /// # Errors
    ///
    /// The first needed column without a number, or one row too many.
    pub(crate) fn push(&mut self, row: usize, cells: &[TableCell]) -> Result<(), RowRefusal> {
        let of = |use_of_it: Use| {
            let all = self.columns.iter().zip(cells);
            all.filter(move |(column, _)| column.use_of_it == use_of_it).map(|(_, cell)| *cell)
        };
        let time = of(Use::Time).next();
        let is_another_topics = of(Use::Signal).all(|cell| cell == TableCell::Empty);
        if is_another_topics && of(Use::Signal).next().is_some() {
            return Ok(());
        }
        if let (Some(filter), Some(TableCell::Number(time))) = (&mut self.excerpt, time)
            && !filter.takes(time)
        {
            return Ok(());
        }
        let wrong = |(column, cell): &(&Column, &TableCell)| {
            column.use_of_it != Use::Further && !matches!(cell, TableCell::Number(_))
        };
        if let Some(index) = self.columns.iter().zip(cells).position(|pair| wrong(&pair)) {
            return Err(RowRefusal::NoNumber(index));
        }
        if !self.most.holds(self.rows.len() as u64 + 1, self.columns.len()) {
            return Err(RowRefusal::TooMany);
        }
        self.rows.push(row);
        for (column, cell) in self.columns.iter_mut().zip(cells) {
            match (&mut column.samples, cell) {
                (Some(samples), TableCell::Number(value)) => samples.push(*value),
                (samples, _) => *samples = None,
            }
        }
        Ok(())
    }

    /// The table of the rows so far.
    pub(crate) fn finish(self) -> Table {
        let whole = |column: Column| Some((column.name, column.samples?));
        let left_out = self.rows.last().is_some_and(|&last| last > self.rows.len());
        Table {
            columns: self.columns.into_iter().filter_map(whole).collect(),
            rows: if left_out { self.rows } else { Vec::new() },
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn rows_of_another_topic_are_left_out_and_the_others_keep_their_numbers() {
        let names = ["time", "q", "command", "note", ""].map(str::to_owned);
        let needed = Needed { time: "time", signals: BTreeSet::from(["q"]), excerpt: None };
        let mut rows = Rows::new(&names, &needed);
        let (n, empty) = (TableCell::Number, TableCell::Empty);
        rows.push(1, &[n(0.0), n(1.0), n(5.0), TableCell::Text, n(1.0)]).unwrap();
        rows.push(2, &[n(0.1), empty, n(6.0), empty, empty]).unwrap();
        rows.push(3, &[n(0.2), n(2.0), n(7.0), n(1.0), n(1.0)]).unwrap();
        assert_eq!(
            rows.push(4, &[empty, n(3.0), n(8.0), n(1.0), n(1.0)]),
            Err(RowRefusal::NoNumber(0))
        );
        assert_eq!(
            rows.push(5, &[n(0.4), TableCell::Text, n(8.0), n(1.0), n(1.0)]),
            Err(RowRefusal::NoNumber(1))
        );
        let table = rows.finish();
        assert_eq!(table.columns["command"], [5.0, 7.0]);
        assert_eq!(table.columns.keys().collect::<Vec<_>>(), ["command", "q", "time"]);
        assert_eq!((table.row(0), table.row(1)), (1, 3));
    }

    #[test]
    fn one_row_too_many_is_refused_and_one_that_is_left_out_is_none() {
        let names = ["time", "q"].map(str::to_owned);
        let needed = Needed { time: "time", signals: BTreeSet::from(["q"]), excerpt: None };
        let mut rows = Rows::new(&names, &needed);
        let row = [TableCell::Number(0.0); 2];
        for (most, refused_at) in
            [(TableSize { rows: 2, cells: 100 }, 3), (TableSize { rows: 100, cells: 7 }, 4)]
        {
            rows = Rows { most, ..Rows::new(&names, &needed) };
            for number in 1..refused_at {
                rows.push(number, &row).unwrap();
                rows.push(number, &[TableCell::Number(0.0), TableCell::Empty]).unwrap();
            }
            assert_eq!(rows.push(refused_at, &row), Err(RowRefusal::TooMany));
        }
        assert_eq!(rows.finish().columns["q"].len(), 3);
    }
}
