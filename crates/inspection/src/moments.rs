use std::ops::Range;

use logs::Run;

use crate::frozen::frozen;
use crate::jumps::jumps;
use crate::observation::{Observation, ObservationKind};
use crate::spikes::{frequent_spikes, spikes};
use crate::thresholds::InspectionThresholds;

/// Errors at some moments of runs, and the runs without them.
pub(crate) struct Moments {
    pub found: Vec<Observation>,
    /// Runs with spikes bridged and jumps taken back.
    pub corrected: Vec<Run>,
    /// Rows of each run that are not looked at.
    pub left_out: Vec<Vec<Range<usize>>>,
}

/// Looks for frozen signals, spikes and jumps.
pub(crate) fn moments(robot: &robot::Robot, runs: &[Run], t: &InspectionThresholds) -> Moments {
    let mut moments = Moments {
        found: Vec::new(),
        corrected: runs.to_vec(),
        left_out: vec![Vec::new(); runs.len()],
    };
    for (r, run) in runs.iter().enumerate() {
        let corrected = &mut moments.corrected[r];
        for (j, link) in robot.links().iter().enumerate() {
            let Some(joint) = corrected.joints.get_mut(j) else { continue };
            if link.joint.kind.is_rotation() {
                moments.found.extend(jumps(run, r, j, &mut joint.position, t));
            }
            let single = spikes(run, r, j, &mut joint.position, t);
            let single = single.or_else(|| frequent_spikes(run, r, j, &joint.position, t));
            moments.found.extend(single);
        }
        let (found, rows) = frozen(robot, &moments.corrected[r], r, t);
        moments.found.extend(found);
        moments.left_out[r] = rows;
    }
    moments.found = merge_runs(moments.found);
    moments
}

/// Merges observations of one kind at the same joint in several runs.
fn merge_runs(all: Vec<Observation>) -> Vec<Observation> {
    let mut merged: Vec<Observation> = Vec::new();
    for next in all {
        let same = |o: &&mut Observation| {
            std::mem::discriminant(&o.kind) == std::mem::discriminant(&next.kind)
                && o.joints == next.joints
        };
        match merged.iter_mut().find(same) {
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
            None => merged.push(next),
        }
    }
    merged
}
