use chrono::{DateTime, NaiveDateTime, Utc};

/// Dates of a column as seconds from its first one, exact to the nanosecond.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) struct Dates {
    /// The first date (ns since 1970).
    first_ns: Option<i64>,
}

impl Dates {
    /// Seconds from the first date, for a date in nanoseconds since 1970.
    pub(crate) fn seconds(&mut self, date_ns: i64) -> f64 {
        let first_ns = *self.first_ns.get_or_insert(date_ns);
        // Wider than the difference of two dates.
        (i128::from(date_ns) - i128::from(first_ns)) as f64 / 1e9
    }

    /// Whether the column has a date already.
    pub(crate) fn has_begun(self) -> bool {
        self.first_ns.is_some()
    }
}

/// The name of a column of dates that its table gives no name: the index of a table of pandas.
pub(crate) const TIME: &str = "time";

/// Length of a date with its time to the second.
const TO_THE_SECOND: usize = "2026-11-28 12:00:00".len();
/// Longest date: to the nanosecond, with an offset from UTC.
const LONGEST: usize = "2026-11-28 12:00:00.123456789 +00:00".len();

/// A date of ISO 8601 with its time, such as `2026-11-28 12:00:00.002` or `2026-11-28T12:00:00.002+01:00`, in nanoseconds
/// since 1970. A date without an offset counts as UTC. `None` for any other text.
pub(crate) fn date_ns(text: &str) -> Option<i64> {
    let looks_so = (TO_THE_SECOND..=LONGEST).contains(&text.len())
        && text.as_bytes().get(4) == Some(&b'-')
        && text.as_bytes().get(13) == Some(&b':');
    if !looks_so {
        return None;
    }
    let plain = ["%Y-%m-%d %H:%M:%S%.f", "%Y-%m-%dT%H:%M:%S%.f", "%Y-%m-%dT%H:%M:%S%.fZ"];
    let with_offset = ["%Y-%m-%d %H:%M:%S%.f%:z", "%Y-%m-%dT%H:%M:%S%.f%:z"];
    let utc = plain.iter().find_map(|f| NaiveDateTime::parse_from_str(text, f).ok());
    let date: DateTime<Utc> = match utc {
        Some(date) => date.and_utc(),
        None => with_offset.iter().find_map(|f| DateTime::parse_from_str(text, f).ok())?.to_utc(),
    };
    date.timestamp_nanos_opt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_are_counted_from_the_first_one_to_the_nanosecond() {
        // date -d '2026-11-28 12:00:00Z' +%s prints 1795867200.
        let noon = 1_795_867_200_000_000_000;
        for (text, after_ns) in [
            ("2026-11-28 12:00:00", 0),
            ("2026-11-28T12:00:00Z", 0),
            ("2026-11-28 12:00:00.002000", 2_000_000),
            ("2026-11-28T12:00:00.000000001", 1),
            ("2026-11-28 13:00:00.5+01:00", 500_000_000),
            ("2026-11-28T07:00:00-05:00", 0),
        ] {
            assert_eq!(date_ns(text), Some(noon + after_ns), "{text}");
        }
        for text in
            ["", "1.5", "2026-11-28", "2026-13-28 12:00:00", "2026-11-28 12:00:00 noon", "12:00:00"]
        {
            assert_eq!(date_ns(text), None, "{text}");
        }
        let mut dates = Dates::default();
        let bits = |ns| dates.seconds(ns).to_bits();
        assert_eq!(
            [noon, noon + 1, noon - 2_000_000_000].map(bits),
            [0.0, 1e-9, -2.0].map(f64::to_bits)
        );
        let farthest = (i128::from(i64::MIN) - i128::from(noon)) as f64 / 1e9;
        assert_eq!(dates.seconds(i64::MIN).to_bits(), farthest.to_bits());
    }
}
