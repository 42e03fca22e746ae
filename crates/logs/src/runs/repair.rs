use std::fmt;

/// A change made to a run while it was read: samples that were corrected, left out or computed.
///
/// Rows are those of the file, counted from 1.
#[derive(Debug, Clone, PartialEq)]
pub enum Repair {
    /// Rows with an impossible sample were left out.
    LeftOut {
        /// The column.
        column: String,
        /// The first row that was left out.
        row: usize,
        /// The value there, in the unit of the signal.
        found: f64,
        /// Why it is impossible, as the end of `but ...`.
        expectation: String,
        /// Number of rows that were left out.
        count: usize,
    },
    /// Time stamps of arrival were replaced by an even clock.
    EvenClock {
        /// Step of the even clock (s).
        step_s: f64,
        /// Largest distance of a time stamp from the even clock (s).
        largest_s: f64,
    },
    /// Rows repeated all values of earlier rows while the arm moved, and were left out or interpolated.
    Repeats {
        /// Number of rows that were left out, and of all rows.
        repeats: [usize; 2],
        /// Rate of the rows (Hz).
        log_hz: f64,
        /// Rate of the values (Hz); `None` where it is not even.
        rate_hz: Option<f64>,
        /// Whether these rows were left out; otherwise their values are interpolated.
        is_left_out: bool,
    },
    /// Some signals were held for several rows each, and all signals are taken at their rate.
    Held {
        /// What was held, in the plural.
        held: &'static str,
        /// Rate of the rows (Hz).
        log_hz: f64,
        /// Rate of the values (Hz).
        rate_hz: f64,
    },
    /// Efforts were not measured: they were computed from the position loop in `robot.toml`.
    FromPositionLoop,
    /// Long logs were thinned out to stretches, spread evenly over them.
    Stretches {
        /// Lengths of the gaps between the stretches of this run (s).
        gaps_s: Vec<f64>,
        /// Length of the kept stretches of all logs, and length of all logs (s).
        all: [f64; 2],
    },
    /// Full turns by which a position jumped were removed.
    Turns {
        /// The column.
        column: String,
        /// The first row after the first jump.
        row: usize,
        /// Number of jumps.
        count: usize,
    },
}

impl Repair {
    /// The share of all logs that is used, in words; `None` for other changes.
    pub fn share_in_words(&self) -> Option<String> {
        let Self::Stretches { all, .. } = self else { return None };
        let [taken_min, whole_min] = all.map(|seconds| seconds / 60.0);
        Some(format!("of {whole_min:.1} min of logs {taken_min:.1} min take part"))
    }

    /// Number of gaps that the change leaves in the run.
    pub(crate) fn gaps(&self) -> usize {
        match self {
            Self::Stretches { gaps_s, .. } => gaps_s.len(),
            _ => 0,
        }
    }

    /// Whether the values of the log come at an even rate that is lower than that of its rows.
    pub(crate) fn is_of_rate(&self) -> bool {
        matches!(self, Self::Held { .. } | Self::Repeats { rate_hz: Some(_), .. })
    }

    /// Whether both are the same change of all logs. Such a change is reported once.
    pub(crate) fn says_of_all(&self, other: &Self) -> bool {
        match (self, other) {
            (Self::FromPositionLoop, Self::FromPositionLoop) => true,
            (Self::Stretches { all, .. }, Self::Stretches { all: others, .. }) => {
                all.map(f64::to_bits) == others.map(f64::to_bits)
            }
            _ => false,
        }
    }
}

impl fmt::Display for Repair {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::LeftOut { column, row, found, expectation, count } => {
                write!(f, "column {column}, row {row}: found {found}, but {expectation}; ")?;
                match count {
                    1 => write!(f, "the row is left out"),
                    _ => write!(f, "it and {} more such rows are left out", count - 1),
                }
            }
            Self::EvenClock { step_s, largest_s } => write!(
                f,
                "its stamps are up to {:.3} ms off an even clock of {:.4} ms, which is taken instead of them",
                1e3 * largest_s,
                1e3 * step_s
            ),
            Self::Repeats { log_hz, rate_hz: Some(rate_hz), .. } => write!(
                f,
                "values come at {} Hz and are held in rows of {} Hz; they are taken at their own rate",
                digits(*rate_hz),
                digits(*log_hz)
            ),
            Self::Repeats { repeats: [repeats, rows], is_left_out, .. } => write!(
                f,
                "{repeats} of {rows} rows repeat the values of earlier rows while the arm moves; {}",
                match is_left_out {
                    true => "these rows are left out",
                    false => "their values are interpolated between the rows beside them",
                }
            ),
            Self::Held { held, log_hz, rate_hz } => write!(
                f,
                "{held} come at {} Hz and are held in rows of {} Hz; all signals are taken at the rate of the {held}",
                digits(*rate_hz),
                digits(*log_hz)
            ),
            Self::FromPositionLoop => f.write_str(
                "no effort was measured: it is taken as kp (goal - q) - kd qd with the gains of effort_source in \
                 robot.toml. Every size in N m is one in units of these gains: the scale of all efforts cannot be \
                 known from such a log, and a torque constant is the error of a gain as well as that of a motor",
            ),
            Self::Stretches { .. } => write!(
                f,
                "{}, in stretches of a minute or less that are spread evenly over them, so that memory and time do \
                 not grow with their length. Intervals are those of what takes part; --all-samples takes the rest too",
                self.share_in_words().unwrap_or_default()
            ),
            Self::Turns { column, row, count } => {
                let more =
                    if *count > 1 { format!(" and {} more", count - 1) } else { String::new() };
                write!(
                    f,
                    "column {column}, row {row}{more}: the position jumps by full turns, which are taken out"
                )
            }
        }
    }
}

/// A rate to three digits.
fn digits(hz: f64) -> String {
    let decimals = (2.0 - hz.log10().floor()).clamp(0.0, 6.0) as usize;
    let words = format!("{hz:.decimals$}");
    if words.contains('.') {
        words.trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        words
    }
}
