//! Motions of one joint after the other, and swings.

use std::f64::consts::PI;

use motion::{MotionSpec, Sweep, Via};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use crate::dice::{between, happens};
use crate::motions::ground::{Ground, glide_s};
use crate::motions::log_plan::LogPlan;
use crate::motions::postures::Path;

/// Moves one joint after the other with the others at rest: one joint per log where there are enough logs, otherwise
/// all joints in each log.
pub(crate) fn one_by_one(
    ground: &Ground<'_>,
    place: LogPlan,
    random: &mut ChaCha8Rng,
) -> MotionSpec {
    let count = ground.count();
    let joints: Vec<usize> = match place.logs >= count {
        true => vec![place.log % count],
        false => (0..count).map(|j| (j + place.log) % count).collect(),
    };
    let posture = ground.smaller(0.5).posture(random);
    let time_s = place.length_s / joints.len() as f64;
    let strokes = happens(random, 0.6);
    let parts = joints.iter().map(|&j| {
        let sweep = if strokes { strokes_of_joint(ground, &posture, j, time_s) } else { None };
        sweep.unwrap_or_else(|| glides_of_joint(ground, &posture, j, time_s, random))
    });
    MotionSpec::Sequence(parts.collect())
}

/// Speeds of a joint's strokes, over the fastest.
const STROKES: [f64; 3] = [1.0, 0.45, 0.15];

/// Moves a joint back and forth at constant speeds within a time (s); `None` where the time is too short.
fn strokes_of_joint(
    ground: &Ground<'_>,
    posture: &[f64],
    j: usize,
    time_s: f64,
) -> Option<MotionSpec> {
    let (most, fastest) = (ground.acceleration[j], ground.speed[j]);
    let strokes = match time_s {
        ..2.0 => return None,
        ..6.0 => 1,
        ..15.0 => 2,
        _ => STROKES.len(),
    };
    let ratios = &STROKES[..strokes];
    let slowest = ratios.last().copied()?;
    let reach = ground.middle[j] + ground.half[j] - posture[j];
    let reach = reach.min(posture[j] - ground.middle[j] + ground.half[j]);
    let needed = |half: f64, speed: f64| {
        let glides = 2.0 * glide_s(half, slowest * speed, most);
        let stroke =
            |ratio: &f64| 2.0 * (2.0 * half / (ratio * speed) + 1.5 * ratio * speed / most);
        glides + ratios.iter().map(stroke).sum::<f64>()
    };
    let mut half = reach;
    for _ in 0..40 {
        let highest = fastest.min(0.95 * (2.0 * half * most / 1.5).sqrt());
        if needed(half, highest) <= time_s {
            let speed = speed_for_time(|speed| needed(half, speed), highest, time_s);
            return Some(MotionSpec::Sweep(Sweep {
                speeds_rad_per_s: ratios.iter().map(|ratio| ratio * speed).collect(),
                joints: Some(vec![ground.names[j].clone()]),
                range_rad: [(ground.names[j].clone(), [posture[j] - half, posture[j] + half])]
                    .into(),
                posture_rad: ground.names.iter().cloned().zip(posture.iter().copied()).collect(),
                acceleration_rad_per_s2: most,
                dwell_s: 0.0,
                position_share: 0.8,
            }));
        }
        half *= 0.85;
    }
    None
}

/// The speed at which strokes take a given time (s), by bisection.
fn speed_for_time(needed: impl Fn(f64) -> f64, highest: f64, time_s: f64) -> f64 {
    let [mut low, mut high] = [1e-3 * highest, highest];
    for _ in 0..50 {
        let middle = 0.5 * (low + high);
        if needed(middle) > time_s { low = middle } else { high = middle }
    }
    high
}

/// Moves a joint between random positions within a time (s).
fn glides_of_joint(
    ground: &Ground<'_>,
    posture: &[f64],
    j: usize,
    time_s: f64,
    random: &mut ChaCha8Rng,
) -> MotionSpec {
    let (most, fastest) = (ground.acceleration[j], ground.speed[j]);
    let mut path = Path::from(posture.to_vec());
    let home = posture[j];
    let mut up = happens(random, 0.5);
    loop {
        let from = path.last()[j];
        let way = ground.half[j] * between(random, [0.3, 0.95]);
        let mut to = ground.middle[j] + if up { way } else { -way };
        // The way in one direction, and from there home, takes at most half of the time.
        while glide_s((to - from).abs(), fastest, most) + glide_s((to - home).abs(), fastest, most)
            > 0.5 * time_s
        {
            to = home + 0.8 * (to - home);
            if (to - home).abs() < 1e-4 {
                break;
            }
        }
        let slow = between(random, [1.0, 1.5]);
        let after = slow * glide_s((to - from).abs(), fastest, most).max(0.1);
        let back = glide_s((to - home).abs(), fastest, most).max(0.1);
        if path.end_s() + after + back > time_s {
            break;
        }
        let mut next = posture.to_vec();
        next[j] = to;
        path.to(next, after);
        up = !up;
    }
    let left = time_s - path.end_s();
    path.to(posture.to_vec(), left);
    path.motion(&ground.names, Via::Stop)
}

/// Swings of growing amplitude at one joint or more, about the middle of its range.
pub(crate) fn swing_up(ground: &Ground<'_>, length_s: f64, random: &mut ChaCha8Rng) -> MotionSpec {
    let first = random.random_range(0..ground.count());
    let swings: Vec<f64> = (0..ground.count())
        .map(|j| match j == first || happens(random, 0.35) {
            true => between(random, [0.5, 0.9]) * if happens(random, 0.5) { 1.0 } else { -1.0 },
            false => 0.0,
        })
        .collect();
    let largest: Vec<f64> = swings.iter().zip(&ground.half).map(|(s, half)| s * half).collect();
    let joints = largest.iter().zip(ground.speed.iter().zip(&ground.acceleration));
    // Half a period of a sine of the largest amplitude.
    let half_s = joints.map(|(a, (v, most))| PI * (a.abs() / v).max((a.abs() / most).sqrt()));
    let half_s = half_s.fold(0.2, f64::max) * between(random, [1.0, 1.5]);
    let count = (length_s / half_s).floor().max(4.0);
    let step_s = length_s / count;
    // Where the log is too short for four swings they stay small.
    let smaller = (step_s / half_s).powi(2).min(1.0);
    let start: Vec<f64> = ground.middle.clone();
    let mut path = Path::from(start.clone());
    let last = count as usize;
    for k in 1..last {
        let sign = if k % 2 == 0 { -1.0 } else { 1.0 };
        let grown = sign * smaller * k as f64 / (last - 1) as f64;
        path.to(start.iter().zip(&largest).map(|(m, a)| m + grown * a).collect(), step_s);
    }
    let left = length_s - path.end_s();
    path.to(start, left);
    path.motion(&ground.names, Via::Pass)
}
