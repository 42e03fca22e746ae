use crate::fit::Drive;
use crate::judge::{EXACT, Judge};
use crate::payload::shares_with_a_tool;
use crate::{Evidence, Observation, ObservationKind, Spoils};

/// Share left from which on a nominal torque is contradicted, and the factor by which a drive alone leaves less.
const FOREIGN: f64 = 0.5;
const WORSE: f64 = 1.3;

/// Part of what a drive alone leaves that is left at a joint which agrees with its nominal torque.
const AGREES: f64 = 0.6;

/// Fewest joints that contradict it.
const FEWEST: usize = 3;

/// Logs whose efforts contradict the nominal torque at three joints or more, for each of which at most a third of
/// one agrees with it, an unknown tool or not: those of another arm.
///
/// A joint contradicts its nominal torque where that leaves more than a drive alone, by much.
pub(crate) fn another_robot(judge: &Judge, runs: usize) -> Option<Observation> {
    let shares = |gain: [f64; 2]| -> Vec<f64> {
        let fits = judge.fits(&judge.samples, &judge.whole, Drive { gain });
        fits.iter().map(|fit| fit.share).collect()
    };
    let (with, without) = (shares(EXACT.gain), shares([0.0, 0.0]));
    let n = with.len();
    let against = |shares: &[f64]| -> Vec<usize> {
        let least = |j: usize| FOREIGN.max(4.0 * judge.floors[j]).max(4.0 * judge.model_floor(j));
        (0..n).filter(|&j| shares[j] > least(j) && shares[j] > WORSE * without[j]).collect()
    };
    let agrees = |shares: &[f64]| {
        (0..n).filter(|&j| shares[j] + judge.floors[j] < AGREES * without[j]).count()
    };
    let is_foreign = |shares: &[f64]| {
        let against = against(shares).len();
        against >= FEWEST && 3 * agrees(shares) <= against
    };
    if !is_foreign(&with) || !shares_with_a_tool(judge, EXACT).is_none_or(|tool| is_foreign(&tool))
    {
        return None;
    }
    let joint = against(&with).into_iter().max_by(|a, b| with[*a].total_cmp(&with[*b]))?;
    Some(Observation {
        kind: ObservationKind::AnotherRobot,
        or: Vec::new(),
        joints: (0..n).collect(),
        runs: (0..runs).collect(),
        stretches: Vec::new(),
        spoils: Spoils::Everything,
        evidence: Some(Evidence {
            joint,
            before: with[joint],
            after: without[joint],
            gain: judge.gain(&with, &without),
        }),
    })
}
