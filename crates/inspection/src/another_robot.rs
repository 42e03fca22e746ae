use crate::fit::Drive;
use crate::judge::Judge;
use crate::observation::{Observation, ObservationKind, ReadingEvidence, Spoils};
use crate::payload::shares_with_a_tool;

/// Logs of another arm: their efforts contradict the nominal torque at three joints or more, also with an unknown tool, and
/// at most a third as many joints agree with it.
///
/// A joint contradicts its nominal torque where the fit with it is much worse than that of a drive alone.
pub(crate) fn another_robot(judge: &Judge, runs: usize) -> Option<Observation> {
    let t = judge.thresholds;
    let shares = |gain: [f64; 2]| -> Vec<f64> {
        let fits = judge.fits(&judge.samples, &judge.whole, Drive { gain });
        fits.iter().map(|fit| fit.share).collect()
    };
    let (with, without) = (shares(t.exact_gain), shares([0.0, 0.0]));
    let n = with.len();
    let against = |shares: &[f64]| -> Vec<usize> {
        let least = |j: usize| {
            t.contradicted.max(t.above_floor * judge.floors[j].max(judge.model_floor(j)))
        };
        (0..n)
            .filter(|&j| shares[j] > least(j) && shares[j] > t.contradicted_by * without[j])
            .collect()
    };
    let agrees = |shares: &[f64]| {
        (0..n).filter(|&j| shares[j] + judge.floors[j] < t.agrees * without[j]).count()
    };
    let is_foreign = |shares: &[f64]| {
        let against = against(shares).len();
        against >= t.fewest_contradicted && t.against_agreeing * agrees(shares) <= against
    };
    if !is_foreign(&with)
        || !shares_with_a_tool(judge, judge.exact_drive()).is_none_or(|tool| is_foreign(&tool))
    {
        return None;
    }
    let joint = against(&with).into_iter().max_by(|a, b| with[*a].total_cmp(&with[*b]))?;
    let (joints, runs) = ((0..n).collect(), (0..runs).collect());
    Some(Observation {
        evidence: Some(ReadingEvidence {
            joint,
            before: with[joint],
            after: without[joint],
            gain: judge.gain(&with, &without),
        }),
        ..Observation::of_runs(ObservationKind::AnotherRobot, joints, runs, Spoils::Everything)
    })
}
