use crate::runs::run::Run;

/// Pause after which a drive counts as cold again (s). A drive cools down in about the hour that it takes to warm up.
const COOLED_S: f64 = 3600.0;

/// Start of the session of each run, on the clock of its file (s). A run belongs to the session of the run before it
/// where it begins after the end of that run, and within an hour of it.
pub(crate) fn session_starts(runs: &[Run]) -> Vec<f64> {
    let mut before: Option<(f64, f64)> = None;
    let start = |run: &Run| {
        let first = run.time.first().copied().unwrap_or(0.0);
        let last = run.time.last().copied().unwrap_or(first);
        let goes_on = |end: f64| first >= end && first - end < COOLED_S;
        let session = before.filter(|(_, end)| goes_on(*end)).map_or(first, |(start, _)| start);
        before = Some((session, last));
        session
    };
    runs.iter().map(start).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    fn run(first: f64, last: f64) -> Run {
        Run {
            name: "run".to_owned(),
            source: "run.csv".into(),
            sha256: String::new(),
            is_torn: false,
            mended: Vec::new(),
            time: vec![first, last],
            joints: Vec::new(),
            extra: Default::default(),
        }
    }

    #[test]
    fn a_run_goes_on_with_a_session_on_the_same_clock_within_an_hour() {
        let clock = [run(5.0, 65.0), run(65.0, 100.0), run(900.0, 960.0), run(9000.0, 9060.0)];
        assert_eq!(session_starts(&clock), [5.0, 5.0, 5.0, 9000.0]);
        assert_eq!(session_starts(&[run(0.0, 20.0), run(0.0, 20.0)]), [0.0, 0.0]);
    }
}
