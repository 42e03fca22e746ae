use logs::Run;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::SeedableRng;
use robot::Robot;

use crate::dice::{between, happens, log_uniform_between};
use crate::moving::body_torque;
use crate::trial::spoilt::rows::random_rows;

/// Current of a drive at its largest torque (A), from a servo's to that of an industrial drive.
const LARGEST_CURRENTS: [f64; 2] = [2.0, 40.0];

/// Spikes over the torque limit of their joint.
const SPIKES: [f64; 2] = [1.5, 50.0];

/// Least and largest part of a size by which a joint's efforts are off.
const PARTS: [f64; 2] = [0.5, 1.0];

/// Subtracts a share of the torque of gravity from the efforts of a row.
pub(crate) fn lift(robot: &Robot, run: &mut Run, row: usize, share: f64) {
    let q: Vec<f64> = run.joints.iter().map(|joint| joint.position[row]).collect();
    let rest = vec![0.0; q.len()];
    let mut held = rest.clone();
    body_torque(robot, &q, &rest, &rest, &mut held);
    for (joint, held) in run.joints.iter_mut().zip(held) {
        joint.effort[row] -= share * held;
        if let Some(commanded) = &mut joint.commanded_effort {
            commanded[row] -= share * held;
        }
    }
}

/// Makes a share of a joint's efforts zero, at random.
pub(crate) fn zero(run: &mut Run, joint: usize, share: f64, seed: (u64, u64)) {
    let effort = &mut run.joints[joint].effort;
    random_rows(effort.len(), share, seed).into_iter().for_each(|row| effort[row] = 0.0);
}

/// Puts spikes of 1.5 to 50 times the joint's torque limit into a share of its efforts; one to three of them where
/// no share is given.
pub(crate) fn put_spikes(
    robot: &Robot,
    run: &mut Run,
    joint: usize,
    share: Option<f64>,
    (seed, stream): (u64, u64),
) {
    let count = run.time.len();
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    random.set_stream(stream);
    let rows = match share {
        Some(share) => random_rows(count, share, (seed, stream + (1 << 32))),
        None => (0..random.random_range(1..=3)).map(|_| random.random_range(0..count)).collect(),
    };
    let limit = robot.links()[joint].joint.limits.effort.unwrap_or(1.0);
    for row in rows {
        let height = limit * log_uniform_between(&mut random, SPIKES);
        run.joints[joint].effort[row] = if happens(&mut random, 0.5) { height } else { -height };
    }
}

/// Turns efforts into motor currents: the torque of every drive over a constant of its own (N m/A), which takes it
/// to 2 to 40 A at its limit. Currents are all that such a log has of efforts.
pub(crate) fn into_amperes(robot: &Robot, run: &mut Run, seed: u64) {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    for (joint, link) in run.joints.iter_mut().zip(robot.links()) {
        let limit = link.joint.limits.effort.unwrap_or(1.0);
        let constant = limit / log_uniform_between(&mut random, LARGEST_CURRENTS);
        joint.effort.iter_mut().for_each(|tau| *tau /= constant);
        joint.commanded_effort = None;
    }
}

/// Multiplies the efforts of every joint by a factor of its own, which is up to `size` from one.
pub(crate) fn scale_each(run: &mut Run, size: f64, seed: u64) {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    for joint in &mut run.joints {
        let off = size * between(&mut random, PARTS);
        let factor = if happens(&mut random, 0.5) { 1.0 + off } else { 1.0 - off };
        let commanded = joint.commanded_effort.iter_mut().flatten();
        joint.effort.iter_mut().chain(commanded).for_each(|tau| *tau *= factor);
    }
}
