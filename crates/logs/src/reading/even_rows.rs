//! Rows of a log at which messages of an even rate come.

use crate::runs::run::median;

/// Fewest intervals that are asked.
const FEWEST: usize = 20;
/// Share of the intervals between new values that must be alike, where a signal counts as held at a rate.
const REGULAR: f64 = 0.9;
/// Share of an interval by which it may differ from the mean one. A row is allowed in any case, since a message comes
/// between two rows.
const ALIKE: f64 = 0.15;
/// Longest mean interval (rows) in which a row is so much that all rows must lie on one line of even messages.
const SHORT: f64 = 4.0;
/// Rows by which messages at an even rate are late at most: one, and rounding.
const LATE: f64 = 1.1;
/// Fewest rows of a mean interval of messages at an even rate that are repeated.
const FEWEST_ROWS: f64 = 1.1;

/// Rate of rows (Hz), by the median of their steps.
pub(super) fn rate(time: &[f64]) -> f64 {
    let steps: Vec<f64> = time.windows(2).map(|t| t[1] - t[0]).collect();
    1.0 / median(&steps)
}

/// New values at an even rate.
pub(super) struct EvenRows {
    /// Mean number of rows between two of them.
    pub rows: f64,
}

impl EvenRows {
    /// `None` where fewer than nine of ten intervals are alike, or two or three of them in one where a message was lost.
    pub fn of(new: &[usize], longest: usize) -> Option<Self> {
        let intervals = new.windows(2).map(|rows| rows[1] - rows[0]);
        let short: Vec<f64> =
            intervals.filter(|rows| *rows <= longest).map(|rows| rows as f64).collect();
        if short.len() < FEWEST {
            return None;
        }
        let middle = median(&short);
        // With the other whole number beside a mean that is none, without two intervals in one.
        let usual = short.iter().filter(|rows| **rows < 1.5 * middle + 1.0);
        let (sum, count) = usual.fold((0.0, 0.0), |(sum, n), rows| (sum + rows, n + 1.0));
        let even = Self { rows: sum / count };
        let is_alike = |found: &&f64| {
            let off = *found - (*found / even.rows).round().max(1.0) * even.rows;
            off.abs() < 1.0 - 1e-9 || off.abs() <= ALIKE * even.rows
        };
        let alike = short.iter().filter(is_alike).count();
        let is_even = even.rows >= FEWEST_ROWS
            && alike as f64 >= REGULAR * short.len() as f64
            && (even.rows > SHORT
                || even.line(|row| row as f64, new).is_some_and(|line| line.late <= LATE));
        is_even.then_some(even)
    }

    /// Times of rows (s) and their mean interval (s), of values at an even rate: the latest line that is not later than
    /// any row. `None` where rows are later than a row.
    pub fn clock(&self, time: &[f64], rows: &[usize]) -> Option<(Vec<f64>, f64)> {
        let line = self.line(|row| time[row], rows)?;
        (line.late <= LATE / rate(time)).then_some((line.values, line.step))
    }

    /// The latest line through the rows that is not later than any.
    ///
    /// ```text
    /// t_k = a + h n_k,   n_k = whole number of intervals up to row k
    /// h by least squares,   a the largest for which no t_k is later than its row
    /// ```
    fn line(&self, time: impl Fn(usize) -> f64, rows: &[usize]) -> Option<Line> {
        let mut number = Vec::with_capacity(rows.len());
        let mut now = 0.0;
        for (k, row) in rows.iter().enumerate() {
            let before = rows[k.saturating_sub(1)];
            now += if k == 0 { 0.0 } else { ((row - before) as f64 / self.rows).round().max(1.0) };
            number.push(now);
        }
        let n = rows.len() as f64;
        let mean_n = number.iter().sum::<f64>() / n;
        let mean_t = rows.iter().map(|row| time(*row)).sum::<f64>() / n;
        let (mut nn, mut nt) = (0.0, 0.0);
        for (number, row) in number.iter().zip(rows) {
            nn += (number - mean_n).powi(2);
            nt += (number - mean_n) * (time(*row) - mean_t);
        }
        let step = nt / nn;
        let late = || number.iter().zip(rows).map(|(n, row)| time(*row) - step * n);
        let (least, most) = (late().reduce(f64::min)?, late().reduce(f64::max)?);
        let values = number.iter().map(|n| least + step * n).collect();
        (step > 0.0).then_some(Line { values, step, late: most - least })
    }
}

/// An even clock: values, their step, and how late the latest row is.
struct Line {
    values: Vec<f64>,
    step: f64,
    late: f64,
}

/// The rows of new values, and in stretches without news rows at the usual interval, or every row where there is none.
pub(super) fn fill(
    new: &[usize],
    rows: usize,
    longest: usize,
    even: Option<&EvenRows>,
) -> Vec<usize> {
    let mut all = Vec::with_capacity(new.len());
    let ends = new.iter().skip(1).copied().chain([rows]);
    for (&start, end) in new.iter().zip(ends) {
        all.push(start);
        if end - start <= longest && end < rows {
            continue;
        }
        let step = even.map_or(1.0, |even| even.rows);
        let between = (1..).map(|k| start + (f64::from(k) * step).round() as usize);
        all.extend(
            between.take_while(|row| (*row as f64) < end as f64 - 0.5 * step.max(1.0) + 0.25),
        );
    }
    all
}
