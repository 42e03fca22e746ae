use std::fmt;

/// The seconds of a log that are read, counted from its first row. Both ends are included.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Excerpt {
    /// Start of the excerpt (s).
    pub from_s: f64,
    /// End of the excerpt (s); infinite for the whole rest of the log.
    pub to_s: f64,
}

impl fmt::Display for Excerpt {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(f, "from {} s ", self.from_s)?;
        if self.to_s.is_finite() { write!(f, "to {} s", self.to_s) } else { write!(f, "on") }
    }
}

/// Conversion of the column of time to seconds:
///
/// ```text
/// time (s) = factor * value + offset_s
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimeScale {
    /// Seconds in one unit of the column.
    pub factor: f64,
    /// Time of the value 0 (s).
    pub offset_s: f64,
}

/// Selects the rows of an excerpt, in the order of the file.
#[derive(Debug, Clone)]
pub struct ExcerptFilter {
    excerpt: Excerpt,
    /// Conversion of time to seconds; `None` where time is in seconds.
    scale: Option<TimeScale>,
    /// Time of the first row with a time (s).
    first_s: Option<f64>,
}

impl ExcerptFilter {
    /// A filter for a file whose time is in seconds, or is converted by `scale`.
    pub fn new(excerpt: Excerpt, scale: Option<TimeScale>) -> Self {
        Self { excerpt, scale, first_s: None }
    }

    /// Whether the next row of the file belongs to the excerpt; `value` is its time as in the file. A row
    /// without a time belongs to the excerpt, so that reading reports it as an error.
    pub(crate) fn takes(&mut self, value: f64) -> bool {
        let time_s = self.scale.map_or(value, |scale| scale.factor * value + scale.offset_s);
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
        let mut filter = ExcerptFilter::new(Excerpt { from_s: 1.0, to_s: 2.0 }, None);
        let read = [f64::NAN, 100.0, 100.9, 101.0, 102.0, 102.1, 101.5].map(|t| filter.takes(t));
        assert_eq!(read, [true, false, false, true, true, false, true]);
    }
}
