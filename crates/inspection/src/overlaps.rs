use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash, Hasher};

use logs::{Run, is_repeat};

use crate::observation::{Observation, ObservationKind, RunStretch, Spoils};
use crate::pieces::usual_step;
use crate::thresholds::InspectionThresholds;

/// Runs that hold the same rows at another time; exact repeats are left to [`logs::duplicate_of`].
pub(crate) fn overlaps(runs: &[Run], t: &InspectionThresholds) -> Vec<Observation> {
    let marks: Vec<Vec<u64>> = runs.iter().map(marks).collect();
    let mut observations = Vec::new();
    for b in 1..runs.len() {
        for a in 0..b {
            if !is_repeat(&runs[a], &runs[b]) {
                observations.extend(overlap(runs, &marks, [a, b], t));
            }
        }
    }
    observations
}

fn overlap(
    runs: &[Run],
    marks: &[Vec<u64>],
    [a, b]: [usize; 2],
    t: &InspectionThresholds,
) -> Option<Observation> {
    let mut first: HashMap<u64, usize> = HashMap::new();
    for (k, mark) in marks[a].iter().enumerate() {
        first.entry(*mark).or_insert(k);
    }
    let mut longest = 0..0;
    let mut start: Option<(usize, usize)> = None;
    for (k, mark) in marks[b].iter().enumerate() {
        let begins = || first.get(mark).map(|&in_a| (in_a, k));
        start = match start {
            Some((in_a, in_b)) if marks[a].get(in_a + k - in_b) == Some(mark) => Some((in_a, in_b)),
            _ => begins(),
        };
        if let Some((_, in_b)) = start
            && k + 1 - in_b > longest.len()
        {
            longest = in_b..k + 1;
        }
    }
    let usual = usual_step(&runs[b].time);
    let own = marks[b].get(longest.clone())?;
    let unlike = own.windows(2).filter(|m| m[0] != m[1]).count();
    let length_s = usual * longest.len() as f64;
    if length_s < t.shared_s
        || longest.len() < t.shared_rows
        || (unlike as f64) < t.moving_rows * own.len() as f64
    {
        return None;
    }
    let in_a = *first.get(own.first()?)?;
    let shift_s = runs[b].time[longest.start] - runs[a].time[in_a];
    let rows = in_a..in_a + longest.len();
    Some(Observation {
        kind: ObservationKind::Overlap { shift_s, length_s },
        or: Vec::new(),
        units: Vec::new(),
        joints: (0..runs[a].joints.len()).collect(),
        runs: vec![a, b],
        stretches: vec![
            RunStretch::of_rows(&runs[a], a, &rows),
            RunStretch::of_rows(&runs[b], b, &longest),
        ],
        spoils: Spoils::Nothing,
        evidence: None,
    })
}

/// A mark of every row, the same for the same positions and efforts.
fn marks(run: &Run) -> Vec<u64> {
    let mark = |k: usize| {
        let mut hasher = DefaultHasher::new();
        for joint in &run.joints {
            joint.position[k].to_bits().hash(&mut hasher);
            joint.effort[k].to_bits().hash(&mut hasher);
        }
        hasher.finish()
    };
    (0..run.time.len()).map(mark).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{RATE_HZ, swing};

    #[test]
    fn two_runs_cut_from_one_overlap_and_two_of_their_own_do_not() {
        let t = InspectionThresholds::default();
        assert_eq!(overlaps(&[swing(0.3), swing(0.8)], &t), []);
        let (first, mut last) = (swing(0.3), swing(0.3));
        last.time.truncate(4000);
        last.joints[0].position.drain(..1000);
        last.joints[0].effort.drain(..1000);
        let observations = overlaps(&[first, last], &t);
        let ObservationKind::Overlap { shift_s, length_s } = observations[0].kind else {
            panic!("{observations:?}")
        };
        assert!(
            (shift_s + 1000.0 / RATE_HZ).abs() < 1e-9 && (length_s - 4000.0 / RATE_HZ).abs() < 1e-6
        );
    }

    #[test]
    fn a_run_that_was_recorded_twice_is_left_to_another_test() {
        assert_eq!(overlaps(&[swing(0.3), swing(0.3)], &InspectionThresholds::default()), []);
    }
}
