use std::ops::Range;

use logs::{Channels, Run};

/// The efforts of a joint in some rows, reported and commanded.
pub(crate) fn efforts(joint: &mut Channels, rows: Range<usize>) -> impl Iterator<Item = &mut f64> {
    let commanded = joint.commanded_effort.as_mut().map(|tau| &mut tau[rows.clone()]);
    joint.effort[rows].iter_mut().chain(commanded.into_iter().flatten())
}

/// Position and velocity of a joint in some rows, and their references.
pub(crate) fn positions_and_derivatives(
    joint: &mut Channels,
    rows: Range<usize>,
) -> impl Iterator<Item = &mut f64> {
    let Channels { position, velocity, desired_position, desired_velocity, .. } = joint;
    let asked = [desired_position, desired_velocity, &mut joint.desired_acceleration];
    let asked = asked.into_iter().flatten();
    let all =
        std::iter::once(position).chain(velocity).chain(asked).chain(&mut joint.link_position);
    all.flat_map(move |signal| &mut signal[rows.clone()])
}

/// What a joint tells, without what it is asked for.
pub(crate) fn signals(joint: &mut Channels) -> impl Iterator<Item = &mut Vec<f64>> {
    let Channels { position, effort, velocity, commanded_effort, link_position, .. } = joint;
    [position, effort].into_iter().chain(velocity).chain(commanded_effort).chain(link_position)
}

/// All columns of a joint.
pub(crate) fn columns(joint: &mut Channels) -> impl Iterator<Item = &mut Vec<f64>> {
    let Channels { position, effort, velocity, acceleration, commanded_effort, .. } = joint;
    let Channels { desired_position, desired_velocity, desired_acceleration, .. } = joint;
    [position, effort]
        .into_iter()
        .chain(velocity)
        .chain(acceleration)
        .chain(commanded_effort)
        .chain(desired_position)
        .chain(desired_velocity)
        .chain(desired_acceleration)
        .chain(&mut joint.link_position)
}

/// Gives two joints each other's efforts in some rows.
pub(crate) fn exchange_efforts(run: &mut Run, one: usize, other: usize, rows: Range<usize>) {
    let of = |joint: &Channels| (joint.effort.clone(), joint.commanded_effort.clone());
    let (a, b) = (of(&run.joints[one]), of(&run.joints[other]));
    for (joint, (effort, commanded)) in [(one, b), (other, a)] {
        let joint = &mut run.joints[joint];
        joint.effort[rows.clone()].copy_from_slice(&effort[rows.clone()]);
        if let (Some(to), Some(from)) = (&mut joint.commanded_effort, commanded) {
            to[rows.clone()].copy_from_slice(&from[rows.clone()]);
        }
    }
}
