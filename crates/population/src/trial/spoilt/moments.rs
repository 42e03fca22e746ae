use std::f64::consts::TAU;

use logs::Run;

use crate::trial::spoilt::channels::signals;
use crate::trial::spoilt::rows::random_rows;

/// Time for which a logger holds its signals where no size is given (s).
const HELD_S: f64 = 1.5;

/// Height of a spike in position (rad or m).
const SPIKE: f64 = 0.05;

/// Lets the encoder of a joint stand still from a row to another.
pub(crate) fn stick(run: &mut Run, joint: usize, [from, until]: [usize; 2]) {
    let joint = &mut run.joints[joint];
    let still = joint.position[from];
    joint.position[from..until].fill(still);
    if let Some(velocity) = &mut joint.velocity {
        velocity[from..until].fill(0.0);
    }
}

/// Lets all signals stand still from a row on, for so many rows or 1.5 s.
pub(crate) fn hold(run: &mut Run, from: usize, rows: Option<usize>) {
    let end = run.time[from] + HELD_S;
    let usual = run.time.partition_point(|t| *t < end);
    let until = rows.map_or(usual, |rows| (from + rows).min(run.time.len()));
    for signal in run.joints.iter_mut().flat_map(signals) {
        let still = signal[from];
        signal[from..until].fill(still);
    }
}

/// Puts five spikes into the position of a joint behind a row.
pub(crate) fn put_five_spikes(run: &mut Run, joint: usize, from: usize) {
    let every = (run.time.len() - from) / 6;
    for k in 1..=5 {
        run.joints[joint].position[from + k * every] += SPIKE;
    }
}

/// Puts spikes into a share of the positions of a joint, at random.
pub(crate) fn put_spikes(run: &mut Run, joint: usize, share: f64, seed: u64) {
    for row in random_rows(run.time.len(), share, (seed, 0)) {
        run.joints[joint].position[row] += SPIKE;
    }
}

/// Adds a turn to the positions of a joint from a row on.
pub(crate) fn turn(run: &mut Run, joint: usize, from: usize) {
    run.joints[joint].position[from..].iter_mut().for_each(|q| *q += TAU);
}
