use std::fmt;

use crate::MappedColumn;

/// The seconds of a log that are read, counted from its first row: both ends belong to it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Excerpt {
    /// Its beginning (s).
    pub from_s: f64,
    /// Its end (s); infinite for all that follows.
    pub to_s: f64,
}

impl fmt::Display for Excerpt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "from {} s ", self.from_s)?;
        if self.to_s.is_finite() { write!(f, "to {} s", self.to_s) } else { write!(f, "on") }
    }
}

/// Tells rows of an excerpt from all others, in the order of a file.
#[derive(Debug, Clone)]
pub(crate) struct Excerpted<'a> {
    excerpt: Excerpt,
    /// How time is written.
    mapped: Option<&'a MappedColumn>,
    /// Time of the first row that has one (s).
    first_s: Option<f64>,
}

impl<'a> Excerpted<'a> {
    pub(crate) fn new(excerpt: Excerpt, mapped: Option<&'a MappedColumn>) -> Self {
        Self { excerpt, mapped, first_s: None }
    }

    /// Whether the next row of the file is read, whose time the file has as `written`. One without a time is
    /// read: it is an error.
    pub(crate) fn reads(&mut self, written: f64) -> bool {
        let time_s = self.mapped.map_or(written, |mapped| mapped.convert(written));
        if !time_s.is_finite() {
            return true;
        }
        let since_s = time_s - *self.first_s.get_or_insert(time_s);
        (self.excerpt.from_s..=self.excerpt.to_s).contains(&since_s)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_excerpt_without_an_end_is_said_to_have_none() {
        assert_eq!(Excerpt { from_s: 1.5, to_s: 2.0 }.to_string(), "from 1.5 s to 2 s");
        assert_eq!(Excerpt { from_s: 1.5, to_s: f64::INFINITY }.to_string(), "from 1.5 s on");
    }

    #[test]
    fn rows_are_counted_from_the_first_and_one_without_time_is_read() {
        let mut excerpted = Excerpted::new(Excerpt { from_s: 1.0, to_s: 2.0 }, None);
        let read = [f64::NAN, 100.0, 100.9, 101.0, 102.0, 102.1, 101.5].map(|t| excerpted.reads(t));
        assert_eq!(read, [true, false, false, true, true, false, true]);
    }
}
