use std::borrow::Cow;

use crate::runs::run::Run;

/// The runs without those that repeat an earlier run.
pub fn without_repeats(runs: &[Run]) -> Cow<'_, [Run]> {
    let kept: Vec<usize> =
        (0..runs.len()).filter(|&index| duplicate_of(runs, index).is_none()).collect();
    match kept.len() == runs.len() {
        true => Cow::Borrowed(runs),
        false => kept.into_iter().map(|index| runs[index].clone()).collect(),
    }
}

/// Index of the first earlier run that has the same samples as this one ([`is_repeat`]).
pub fn duplicate_of(runs: &[Run], index: usize) -> Option<usize> {
    let run = runs.get(index)?;
    runs.iter().take(index).position(|earlier| is_repeat(earlier, run))
}

/// Whether two runs have exactly the same positions and efforts.
///
/// Such runs are one recording under two names. A model fitted on one and tested on
/// the other is tested on its own training data.
pub fn is_repeat(one: &Run, other: &Run) -> bool {
    let mut joints = one.joints.iter().zip(&other.joints);
    one.joints.len() == other.joints.len()
        && joints.all(|(a, b)| a.position == b.position && a.effort == b.effort)
}
