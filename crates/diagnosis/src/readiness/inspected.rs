use inspection::{Mended, Observation, ObservationKind, Spoils, mended};
use logs::Run;
use robot::Robot;

/// Fewest samples of a run that is worth keeping.
const FEWEST_SAMPLES: usize = 100;

/// Logs after a look at the whole of them.
#[derive(Debug)]
pub(crate) struct Inspected {
    /// The runs without the seconds that are spoilt, where there are any.
    without: Option<Vec<Run>>,
    /// Whole runs as they were read, where that is not as they stand.
    pub read: Option<Vec<Run>>,
    /// Why the effort of a joint cannot be used, for every joint of which that is so.
    pub spoilt: Vec<Option<String>>,
    /// What was seen, each in a sentence.
    pub warnings: Vec<String>,
}

/// Looks at whole logs: a turned sign, another unit, a frozen encoder. What has one reading only is read so.
/// No cause is sought where others spoil what it would be sought in.
pub(crate) fn inspected(robot: &Robot, runs: &[Run]) -> Inspected {
    let Mended { runs: read, mended, left: mut seen } = mended(robot, runs);
    let runs = read.as_deref().unwrap_or(runs);
    // A drive at its limit gives the torque of the limit, and what it was asked for beyond is a cause.
    seen.retain(|o| !matches!(o.kind, ObservationKind::AtLimit { .. }));
    let said = |o: &Observation| o.sentence(robot, runs);
    let reason = |j: usize| {
        let spoils = |o: &&Observation| match o.spoils {
            Spoils::Everything => true,
            Spoils::Joints => o.joints.contains(&j),
            Spoils::Stretches | Spoils::Nothing => false,
        };
        seen.iter().find(spoils).map(said)
    };
    let spoilt = (0..robot.joint_count()).map(reason).collect();
    let put_right = |o: &Observation| format!("{} Until then the logs are read so.", said(o));
    let warnings = mended.iter().map(put_right).chain(seen.iter().map(said)).collect();
    Inspected { without: without_spoilt_seconds(runs, &seen), read, spoilt, warnings }
}

impl Inspected {
    /// The runs that causes are sought in, of those that were `given`.
    pub fn runs<'a>(&'a self, given: &'a [Run]) -> &'a [Run] {
        self.without.as_deref().or(self.read.as_deref()).unwrap_or(given)
    }
}

/// The runs without spoilt seconds; a run of which too little is left is left out, unless that is so
/// of all. None where all of all runs is left.
fn without_spoilt_seconds(runs: &[Run], seen: &[Observation]) -> Option<Vec<Run>> {
    let spoilt = |run: usize| -> Vec<[f64; 2]> {
        let observations = seen.iter().filter(|o| o.spoils == Spoils::Stretches);
        let stretches = observations.flat_map(|o| &o.stretches).filter(|s| s.run == run);
        stretches.map(|s| [s.from_s, s.to_s]).collect()
    };
    let is_long = |run: &Run| run.time.len() >= FEWEST_SAMPLES;
    if runs.iter().enumerate().all(|(r, run)| is_long(run) && spoilt(r).is_empty()) {
        return None;
    }
    let kept = runs.iter().enumerate().map(|(r, run)| run.without(&spoilt(r)));
    let kept: Vec<Run> = kept.filter(is_long).collect();
    (!kept.is_empty()).then_some(kept)
}
