use crate::Run;

/// Index of the first earlier run with exactly the same positions and efforts.
///
/// Two such runs are one recording under two names: a model fitted on one and tested on
/// the other is tested on what it was fitted to.
pub fn duplicate_of(runs: &[Run], index: usize) -> Option<usize> {
    let run = runs.get(index)?;
    runs.iter().take(index).position(|earlier| {
        earlier.joints.len() == run.joints.len()
            && earlier
                .joints
                .iter()
                .zip(&run.joints)
                .all(|(a, b)| a.position == b.position && a.effort == b.effort)
    })
}
