use std::collections::BTreeMap;
use std::ops::Range;

use logs::{Channel, Channels, Run};

/// Rate to which logs are thinned (Hz).
const RATE_HZ: f64 = 250.0;

/// A quarter of a log.
pub(super) struct Part;

impl Part {
    /// Number of them in a log.
    pub(super) const QUARTERS: usize = 4;

    /// Rows of the quarters `first .. last` of a log.
    pub(super) fn rows(run: &Run, quarters: Range<usize>) -> Range<usize> {
        let at = |quarter: usize| run.time.len() * quarter / Self::QUARTERS;
        at(quarters.start)..at(quarters.end)
    }
}

/// Mean rate of a run (Hz); 0 for one without length.
pub(super) fn rate_hz(run: &Run) -> f64 {
    let length = length_s(run);
    if length > 0.0 { (run.time.len() - 1) as f64 / length } else { 0.0 }
}

/// Time from the first to the last row (s).
pub(super) fn length_s(run: &Run) -> f64 {
    run.time.last().zip(run.time.first()).map_or(0.0, |(last, first)| last - first)
}

/// Rows of the first `longest_s` seconds.
pub(super) fn until(run: &Run, longest_s: f64) -> Range<usize> {
    let first = run.time.first().copied().unwrap_or(0.0);
    0..run.time.partition_point(|t| t - first <= longest_s)
}

/// Keeps every n-th row, with the rate nearest to 250 Hz. Without a filter, frequencies above half the new rate
/// alias, as in a log that was written at that rate.
pub(super) fn thin(run: &Run) -> Run {
    let every = ((rate_hz(run) / RATE_HZ).round() as usize).max(1);
    if every == 1 {
        return run.clone();
    }
    rows(run, &run.name, (0..run.time.len()).step_by(every).collect())
}

/// A range of rows of a run under another name, or the run itself for all rows.
pub(super) fn part(run: &Run, name: &str, stretch: Range<usize>) -> Run {
    if stretch == (0..run.time.len()) {
        return run.clone();
    }
    rows(run, name, stretch.collect())
}

/// Some rows of a run, without the hash of its file.
fn rows(run: &Run, name: &str, rows: Vec<usize>) -> Run {
    let pick = |x: &[f64]| rows.iter().filter_map(|&row| x.get(row).copied()).collect::<Vec<_>>();
    let joint = |from: &Channels| {
        let mut channels = Channels { name: from.name.clone(), ..Channels::default() };
        for channel in Channel::ALL {
            if let Some(samples) = from.get(channel) {
                channels.set(channel, pick(samples));
            }
        }
        channels
    };
    let extra: BTreeMap<_, _> =
        run.extra.iter().map(|(name, values)| (name.clone(), pick(values))).collect();
    Run {
        name: name.to_owned(),
        source: run.source.clone(),
        sha256: String::new(),
        is_torn: run.is_torn,
        mended: run.mended.clone(),
        time: pick(&run.time),
        joints: run.joints.iter().map(joint).collect(),
        extra,
    }
}
