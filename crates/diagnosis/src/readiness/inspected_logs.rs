use inspection::{CorrectedLogs, Observation, ObservationKind, Spoils, correct_with};
use logs::Run;
use robot::Robot;

use crate::thresholds::Thresholds;

/// The logs after an inspection as a whole.
#[derive(Debug)]
pub(crate) struct InspectedLogs {
    /// The runs without spoilt seconds; `None` where nothing is spoilt.
    without: Option<Vec<Run>>,
    /// The runs as they were read, where they were corrected.
    pub read: Option<Vec<Run>>,
    /// For every joint, the reason why its effort cannot be used, if there is one.
    pub spoilt: Vec<Option<String>>,
    /// All observations, each in a sentence.
    pub warnings: Vec<String>,
}

/// Inspects whole logs for a turned sign, another unit, a frozen encoder. An error with only one possible correction
/// is corrected. Seconds and joints that other errors spoil are left out of the search for causes.
pub(crate) fn inspect_logs(robot: &Robot, runs: &[Run], t: &Thresholds) -> InspectedLogs {
    let CorrectedLogs { runs: read, mended, left: mut seen } =
        correct_with(robot, runs, &t.inspection);
    let runs = read.as_deref().unwrap_or(runs);
    // A drive at its limit gives the torque of the limit; the effort beyond it is a cause.
    seen.retain(|o| !matches!(o.kind, ObservationKind::AtLimit { .. }));
    let sentence = |o: &Observation| o.sentence(robot, runs);
    let reason = |j: usize| {
        let spoils = |o: &&Observation| match o.spoils {
            Spoils::Everything => true,
            Spoils::Joints => o.joints.contains(&j),
            Spoils::Stretches | Spoils::Nothing => false,
        };
        seen.iter().find(spoils).map(sentence)
    };
    let spoilt = (0..robot.joint_count()).map(reason).collect();
    let put_right = |o: &Observation| format!("{} Until then the logs are read so.", sentence(o));
    let warnings = mended.iter().map(put_right).chain(seen.iter().map(sentence)).collect();
    let fewest = t.readiness.fewest_run_samples;
    InspectedLogs { without: without_spoilt_seconds(runs, &seen, fewest), read, spoilt, warnings }
}

impl InspectedLogs {
    /// The runs in which causes are sought; `given` are the runs that were inspected.
    pub fn runs<'a>(&'a self, given: &'a [Run]) -> &'a [Run] {
        self.without.as_deref().or(self.read.as_deref()).unwrap_or(given)
    }
}

/// The runs without spoilt seconds and without runs that are then too short. `None` where nothing is cut out, or where
/// no run is left.
fn without_spoilt_seconds(runs: &[Run], seen: &[Observation], fewest: usize) -> Option<Vec<Run>> {
    let spoilt = |run: usize| -> Vec<[f64; 2]> {
        let observations = seen.iter().filter(|o| o.spoils == Spoils::Stretches);
        let stretches = observations.flat_map(|o| &o.stretches).filter(|s| s.run == run);
        stretches.map(|s| [s.from_s, s.to_s]).collect()
    };
    let is_long = |run: &Run| run.time.len() >= fewest;
    if runs.iter().enumerate().all(|(r, run)| is_long(run) && spoilt(r).is_empty()) {
        return None;
    }
    let kept = runs.iter().enumerate().map(|(r, run)| run.without(&spoilt(r)));
    let kept: Vec<Run> = kept.filter(is_long).collect();
    (!kept.is_empty()).then_some(kept)
}
