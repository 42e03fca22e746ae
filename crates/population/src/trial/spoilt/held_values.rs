use logs::Run;

use crate::trial::spoilt::channels::columns;
use crate::trial::spoilt::rows::random_rows;

/// Least time between two messages of a merged log (s): 100 Hz.
const BETWEEN_S: f64 = 0.01;

/// Repeats the messages of a run in rows of a rate (Hz): every row has the values of the last message at or before
/// its time, and messages are the rows of the run that are 10 ms apart or more.
pub(crate) fn repeat(run: &mut Run, rate_hz: f64) {
    let mut messages: Vec<usize> = Vec::new();
    for (row, time) in run.time.iter().enumerate() {
        // Half a row's rounding on a clock of 1000 Hz.
        if messages.last().is_none_or(|last| time - run.time[*last] >= BETWEEN_S - 5e-4) {
            messages.push(row);
        }
    }
    let (Some(&first), Some(&last)) = (messages.first(), messages.last()) else { return };
    let start = run.time[first];
    let rows = ((run.time[last] - start) * rate_hz).floor() as usize + 1;
    let even: Vec<f64> = (0..rows).map(|row| start + row as f64 / rate_hz).collect();
    let source = |time: &f64| {
        let behind = messages.partition_point(|row| run.time[*row] <= time + 1e-9);
        messages[behind.saturating_sub(1)]
    };
    let sources: Vec<usize> = even.iter().map(source).collect();
    for column in run.joints.iter_mut().flat_map(columns) {
        *column = sources.iter().filter_map(|row| column.get(*row)).copied().collect();
    }
    run.time = even;
}

/// Lets a share of rows repeat the row before, at random.
pub(crate) fn repeat_some(run: &mut Run, share: f64, seed: (u64, u64)) {
    let stale: Vec<usize> =
        random_rows(run.time.len(), share, seed).into_iter().filter(|row| *row > 0).collect();
    for column in run.joints.iter_mut().flat_map(columns).filter(|column| !column.is_empty()) {
        stale.iter().for_each(|&row| column[row] = column[row - 1]);
    }
}
