use std::collections::HashMap;
use std::hash::{DefaultHasher, Hash, Hasher};

use logs::{Run, is_repeat};

use crate::observation::{Observation, ObservationKind, RunStretch, Spoils};
use crate::pieces::usual_step;
use crate::thresholds::InspectionThresholds;

/// Runs that hold the same rows at another time; exact repeats are left to [`logs::duplicate_of`].
///
/// What two runs share has a row that another row follows. Only runs with the same two rows in sequence somewhere are
/// compared, so that the cost grows with the samples and not with the pairs of runs.
pub(crate) fn overlaps(runs: &[Run], t: &InspectionThresholds) -> Vec<Observation> {
    let marks: Vec<Vec<u64>> = runs.iter().map(marks).collect();
    let changes = Changes::of(&marks);
    let mut observations = Vec::new();
    for b in 1..runs.len() {
        for a in changes.earlier_runs(&marks[b], b) {
            if !is_repeat(&runs[a], &runs[b]) {
                observations.extend(overlap(runs, &marks, [a, b], t));
            }
        }
    }
    observations
}

/// Where a row is followed by another: a mark of the two and the run, sorted.
struct Changes(Vec<(u64, usize)>);

impl Changes {
    fn of(marks: &[Vec<u64>]) -> Self {
        let of_run = |(run, marks): (usize, &Vec<u64>)| {
            changes(marks).map(|change| (change, run)).collect::<Vec<_>>()
        };
        let mut all: Vec<(u64, usize)> = marks.iter().enumerate().flat_map(of_run).collect();
        all.sort_unstable();
        all.dedup();
        Self(all)
    }

    /// The runs before `run` that share a change with its rows, ascending.
    fn earlier_runs(&self, marks: &[u64], run: usize) -> Vec<usize> {
        let mut shares = vec![false; run];
        for change in changes(marks) {
            let from = self.0.partition_point(|entry| *entry < (change, 0));
            let others = self.0[from..].iter().take_while(|entry| **entry < (change, run));
            others.for_each(|(_, earlier)| shares[*earlier] = true);
        }
        (0..run).filter(|earlier| shares[*earlier]).collect()
    }
}

/// A mark of every two rows in sequence that differ.
fn changes(marks: &[u64]) -> impl Iterator<Item = u64> {
    let of_two = |two: &[u64]| {
        let mut hasher = DefaultHasher::new();
        two.hash(&mut hasher);
        hasher.finish()
    };
    marks.windows(2).filter(|two| two[0] != two[1]).map(of_two)
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
    let kind = ObservationKind::Overlap { shift_s, length_s };
    let joints = (0..runs[a].joints.len()).collect();
    Some(Observation {
        stretches: vec![
            RunStretch::of_rows(&runs[a], a, &rows),
            RunStretch::of_rows(&runs[b], b, &longest),
        ],
        ..Observation::of_runs(kind, joints, vec![a, b], Spoils::Nothing)
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

    /// A run whose rows are the numbers `rows`.
    fn run_of(rows: &[u64]) -> Run {
        let mut run = swing(0.3);
        run.time = (0..rows.len()).map(|k| k as f64 / RATE_HZ).collect();
        run.joints[0].position = rows.iter().map(|row| *row as f64).collect();
        run.joints[0].effort = vec![0.0; rows.len()];
        run
    }

    #[test]
    fn runs_that_share_a_change_are_those_that_are_compared() {
        let rows: [&[u64]; 5] =
            [&[1, 2, 3], &[2, 1, 1], &[9, 9, 9], &[7, 2, 3, 9], &[9, 9, 1, 2, 8, 7, 2]];
        let marks: Vec<Vec<u64>> = rows.iter().map(|rows| marks(&run_of(rows))).collect();
        let earlier = |run: usize| Changes::of(&marks).earlier_runs(&marks[run], run);
        assert_eq!([1, 2, 3, 4].map(earlier), [vec![], vec![], vec![0], vec![0, 3]]);
    }

    #[test]
    fn a_run_that_was_recorded_twice_is_left_to_another_test() {
        assert_eq!(overlaps(&[swing(0.3), swing(0.3)], &InspectionThresholds::default()), []);
    }
}
