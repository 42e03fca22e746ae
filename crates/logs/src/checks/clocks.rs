use crate::{
    error::LogError,
    runs::run::{Run, median},
};

/// Rates of logs of one motion differ by less: 3 Hz from 1 kHz.
const MOST_APART: f64 = 300.0;
/// Logs of robots have about so many seconds between their rows; of two that differ, the one that is further from it is named.
const USUAL_STEP_S: f64 = 0.01;
/// Units that are taken for seconds, with the number of them in a second.
const UNITS: [(&str, f64); 3] = [("ms", 1e3), ("us", 1e6), ("ns", 1e9)];
/// A ratio of two steps stands for a unit up to this factor: the rates differ as well.
const OTHER_RATE: f64 = 10.0;

/// Refuses runs of which one does not count in seconds.
///
/// # Errors
///
/// [`LogError::OtherClock`], of the run whose clock is wrong, whichever stands first.
pub fn compare_clocks(runs: &[Run]) -> Result<(), LogError> {
    let step = |run: &Run| median(&run.time.windows(2).map(|t| t[1] - t[0]).collect::<Vec<_>>());
    let steps = runs.iter().map(|run| (step(run), run)).filter(|(step, _)| *step > 0.0);
    let mut steps: Vec<(f64, &Run)> = steps.collect();
    steps.sort_by(|a, b| a.0.total_cmp(&b.0));
    let [short, .., long] = &steps[..] else { return Ok(()) };
    let ratio = long.0 / short.0;
    if ratio < MOST_APART {
        return Ok(());
    }
    let away = |step_s: f64| (step_s / USUAL_STEP_S).ln().abs();
    let (odd, other) = if away(long.0) >= away(short.0) { (long, short) } else { (short, long) };
    let is_near = |count: f64| (ratio / count).ln().abs() <= OTHER_RATE.ln();
    let unit = UNITS.into_iter().find(|(_, count)| odd.0 > other.0 && is_near(*count));
    Err(LogError::OtherClock {
        run: odd.1.name.clone(),
        step_s: odd.0,
        other: other.1.name.clone(),
        other_step_s: other.0,
        unit: unit.map(|(unit, _)| unit),
    })
}

#[cfg(test)]
mod tests {
    use std::collections::BTreeMap;
    use std::path::PathBuf;

    use super::*;

    fn run(name: &str, step_s: f64) -> Run {
        Run {
            name: name.to_owned(),
            source: PathBuf::new(),
            sha256: String::new(),
            is_torn: false,
            mended: Vec::new(),
            time: (0..9).map(|k| f64::from(k) * step_s).collect(),
            joints: Vec::new(),
            extra: BTreeMap::new(),
        }
    }

    fn refused(steps_s: &[f64]) -> Option<(String, String, Option<&'static str>)> {
        let runs: Vec<Run> =
            steps_s.iter().enumerate().map(|(k, step)| run(&k.to_string(), *step)).collect();
        match compare_clocks(&runs) {
            Err(LogError::OtherClock { run, other, unit, .. }) => Some((run, other, unit)),
            other => other.map(|()| None).unwrap(),
        }
    }

    #[test]
    fn the_run_that_counts_otherwise_is_named_wherever_it_stands() {
        let named = |run: &str, other: &str, unit| Some((run.to_owned(), other.to_owned(), unit));
        assert_eq!(refused(&[5e6, 0.005]), named("0", "1", Some("ns")));
        assert_eq!(refused(&[0.005, 5e6]), named("1", "0", Some("ns")));
        assert_eq!(refused(&[0.002, 0.001, 4000.0]), named("2", "1", Some("us")));
        assert_eq!(refused(&[0.005, 5.0]), named("1", "0", Some("ms")));
        // Counted in hours.
        assert_eq!(refused(&[0.01, 0.01 / 3600.0]), named("1", "0", None));
    }

    #[test]
    fn runs_of_other_rates_and_runs_that_all_count_alike_are_left_alone() {
        for steps in [&[0.001, 0.2][..], &[5e6, 5e6], &[0.01], &[]] {
            assert_eq!(refused(steps), None, "{steps:?}");
        }
    }
}
