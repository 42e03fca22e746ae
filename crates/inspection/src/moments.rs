use std::ops::Range;

use logs::Run;

use crate::{Observation, ObservationKind, Spoils, Stretch, Thresholds};

/// What is wrong with some moments of runs, and the runs without it.
pub(crate) struct Moments {
    pub told: Vec<Observation>,
    /// Runs with spikes bridged and jumps taken back.
    pub mended: Vec<Run>,
    /// Rows of each run that are not looked at.
    pub left_out: Vec<Vec<Range<usize>>>,
}

/// Looks for frozen signals, spikes and jumps.
pub(crate) fn moments(robot: &robot::Robot, runs: &[Run], t: &Thresholds) -> Moments {
    let mut found =
        Moments { told: Vec::new(), mended: runs.to_vec(), left_out: vec![Vec::new(); runs.len()] };
    for (r, run) in runs.iter().enumerate() {
        let mended = &mut found.mended[r];
        for (j, link) in robot.links().iter().enumerate() {
            let Some(joint) = mended.joints.get_mut(j) else { continue };
            if link.joint.kind.is_rotation() {
                found.told.extend(crate::jumps::jumps(run, r, j, &mut joint.position));
            }
            found.told.extend(crate::spikes::spikes(run, r, j, &mut joint.position, t));
        }
        let (told, rows) = crate::frozen::frozen(robot, &found.mended[r], r, t);
        found.told.extend(told);
        found.left_out[r] = rows;
    }
    found.told = joined(found.told);
    found
}

/// An observation of some seconds of a joint.
pub(crate) fn at(kind: ObservationKind, joint: usize, stretches: Vec<Stretch>) -> Observation {
    let runs = stretches.first().map(|s| s.run).into_iter().collect();
    let spoils = Spoils::Stretches;
    Observation {
        kind,
        or: Vec::new(),
        joints: vec![joint],
        runs,
        stretches,
        spoils,
        evidence: None,
    }
}

/// The stretch of rows of a run.
pub(crate) fn stretch(run: &Run, index: usize, rows: &Range<usize>) -> Stretch {
    let last = run.time.len().saturating_sub(1);
    let at = |k: usize| run.time.get(k.min(last)).copied().unwrap_or(0.0);
    Stretch { run: index, from_s: at(rows.start), to_s: at(rows.end.saturating_sub(1)) }
}

/// What is told of the same joint in several runs is told once.
fn joined(all: Vec<Observation>) -> Vec<Observation> {
    let mut told: Vec<Observation> = Vec::new();
    for next in all {
        let same = |o: &&mut Observation| {
            std::mem::discriminant(&o.kind) == std::mem::discriminant(&next.kind)
                && o.joints == next.joints
        };
        match told.iter_mut().find(same) {
            Some(earlier) => {
                if let (
                    ObservationKind::Spikes { count, height },
                    ObservationKind::Spikes { count: more, height: other },
                ) = (&mut earlier.kind, &next.kind)
                {
                    *count += more;
                    *height = height.max(*other);
                }
                earlier.runs.extend(next.runs);
                earlier.stretches.extend(next.stretches);
            }
            None => told.push(next),
        }
    }
    told
}
