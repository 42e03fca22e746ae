use robot::Robot;

use crate::judge::Judge;
use crate::motion_samples::Thinned;
use crate::observation::{Observation, ObservationKind, ReadingEvidence, Spoils};
use crate::thresholds::InspectionThresholds;

/// A shift of the efforts against the motion that explains as much as a reading does.
///
/// ```text
/// effort(t) = tau(t - shift)
/// ```
pub(crate) fn effort_shift(
    robot: &Robot,
    thinned: &Thinned,
    t: &InspectionThresholds,
    gain: f64,
    runs: usize,
) -> Option<Observation> {
    let (step_s, shortest) = thinned.spacing()?;
    let reach = ((t.longest_shift_s / step_s) as usize).min(shortest / t.piece_of_shifts);
    let mut judge = Judge::new(robot, t, thinned.samples(reach, 0));
    let as_is = judge.as_is();
    let mut best: Option<(f64, isize, Vec<f64>)> = None;
    for later in (1..=reach as isize).flat_map(|k| [k, -k]) {
        judge.samples.effort = thinned.samples(reach, later).effort;
        let shares = judge.as_is().shares;
        let found = judge.gain(&as_is.shares, &shares);
        if best.as_ref().is_none_or(|b| found > b.0) {
            best = Some((found, later, shares));
        }
    }
    let (found, later, shares) = best.filter(|b| b.0 > t.gain[0].max(gain - t.margin))?;
    let of = |j: &usize| as_is.shares[*j] / (shares[*j] + judge.floors[*j]);
    let joint = (0..shares.len()).max_by(|a, b| of(a).total_cmp(&of(b)))?;
    let kind = ObservationKind::EffortShifted { shift_s: later as f64 * step_s };
    let (joints, runs) = ((0..shares.len()).collect(), (0..runs).collect());
    Some(Observation {
        evidence: Some(ReadingEvidence {
            joint,
            before: as_is.shares[joint],
            after: shares[joint],
            gain: found,
        }),
        ..Observation::of_runs(kind, joints, runs, Spoils::Nothing)
    })
}
