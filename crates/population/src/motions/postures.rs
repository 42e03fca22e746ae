//! Motions from posture to posture.

use motion::{Hold, MotionSpec, Via, Waypoints};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;

use crate::dice::{between, happens};
use crate::motions::ground::Ground;

/// Least share of a log that a motion between two postures may take up.
const LONGEST_SHARE: f64 = 0.25;

/// Waypoints while they are put down: a time and a posture each.
pub(crate) struct Path {
    times: Vec<f64>,
    postures: Vec<Vec<f64>>,
}

impl Path {
    pub(crate) fn from(posture: Vec<f64>) -> Self {
        Self { times: vec![0.0], postures: vec![posture] }
    }

    /// Time of the last waypoint (s).
    pub(crate) fn end_s(&self) -> f64 {
        self.times.last().copied().unwrap_or(0.0)
    }

    /// The last posture.
    pub(crate) fn last(&self) -> Vec<f64> {
        self.postures.last().cloned().unwrap_or_default()
    }

    /// A waypoint some time after the last (s).
    pub(crate) fn to(&mut self, posture: Vec<f64>, after_s: f64) {
        let time = (1e3 * (self.end_s() + after_s.max(2e-3))).round() * 1e-3;
        self.times.push(time);
        self.postures.push(posture);
    }

    /// A rest at the last waypoint (s).
    pub(crate) fn rest(&mut self, for_s: f64) {
        let last = self.last();
        self.to(last, for_s);
    }

    /// Rests until a time (s), where it is not there yet.
    fn rest_until(&mut self, time_s: f64) {
        let left = time_s - self.end_s();
        if left > 0.01 {
            self.rest(left);
        }
    }

    /// The motion through all waypoints.
    pub(crate) fn motion(self, names: &[String], via: Via) -> MotionSpec {
        let of = |(j, name): (usize, &String)| {
            let positions = self.postures.iter().map(|q| (1e5 * q[j]).round() * 1e-5);
            (name.clone(), positions.collect())
        };
        let positions_rad = names.iter().enumerate().map(of).collect();
        MotionSpec::Waypoints(Waypoints { times_s: self.times, positions_rad, via })
    }
}

/// A posture on the way to another that is reached in at most a time (s), and that time.
fn within(ground: &Ground<'_>, from: &[f64], to: &[f64], most_s: f64) -> (Vec<f64>, f64) {
    let needed = ground.glide_s(from, to);
    if needed <= most_s {
        return (to.to_vec(), needed);
    }
    let share = (most_s / needed).powi(2).min(1.0);
    let there: Vec<f64> = from.iter().zip(to).map(|(a, b)| a + share * (b - a)).collect();
    let time = ground.glide_s(from, &there);
    (there, time)
}

/// From posture to posture, with rests between.
pub(crate) fn point_to_point(
    ground: &Ground<'_>,
    length_s: f64,
    random: &mut ChaCha8Rng,
) -> MotionSpec {
    let longest_rest = between(random, [0.2, 2.0]).min(0.1 * length_s);
    let mut path = Path::from(ground.posture(random));
    path.rest(0.1);
    loop {
        let target = ground.posture(random);
        let (to, needed) = within(ground, &path.last(), &target, LONGEST_SHARE * length_s);
        let after = needed * between(random, [1.0, 1.6]);
        if path.end_s() + after > length_s {
            break;
        }
        path.to(to, after);
        path.rest(between(random, [0.1, 1.0]) * longest_rest.max(0.02));
    }
    path.rest_until(length_s);
    path.motion(&ground.names, Via::Stop)
}

/// Two to four places in turn, each with a posture above it from which it is approached slowly.
pub(crate) fn pick_and_place(
    ground: &Ground<'_>,
    length_s: f64,
    random: &mut ChaCha8Rng,
) -> MotionSpec {
    let inner = ground.smaller(0.9);
    let places: Vec<[Vec<f64>; 2]> = (0..random.random_range(2..=4))
        .map(|_| {
            let above = inner.posture(random);
            let down = above.iter().zip(&ground.half);
            let down: Vec<f64> =
                down.map(|(q, half)| q + half * between(random, [-0.15, 0.15])).collect();
            [above, ground.clamp(&down)]
        })
        .collect();
    let (slow, grip_s) = (between(random, [1.5, 4.0]), between(random, [0.1, 0.8]));
    let most = LONGEST_SHARE * length_s;
    let mut path = Path::from(places[0][0].clone());
    path.rest(0.1);
    for [above, down] in places.iter().cycle() {
        let (over, across_s) = within(ground, &path.last(), above, most);
        let (onto, approach_s) = within(ground, &over, down, 0.2 * most);
        let approach_s = (slow * approach_s).min(most);
        let after_s = across_s + 2.0 * approach_s + grip_s;
        if path.end_s() + after_s > length_s {
            break;
        }
        path.to(over.clone(), across_s.max(0.1));
        path.to(onto, approach_s);
        path.rest(grip_s);
        path.to(over, approach_s);
    }
    path.rest_until(length_s);
    path.motion(&ground.names, Via::Stop)
}

/// A path as a hand leads it: slow, uneven, passed without a stop, with pauses.
pub(crate) fn lead_by_hand(
    ground: &Ground<'_>,
    length_s: f64,
    random: &mut ChaCha8Rng,
) -> MotionSpec {
    let slow = between(random, [0.2, 0.5]);
    let mut at = ground.smaller(0.7).posture(random);
    let (mut parts, mut used) = (Vec::new(), 0.0);
    while used + 1.5 < length_s {
        let stretch = between(random, [3.0, 9.0]).min(length_s - used);
        let mut path = Path::from(at.clone());
        while stretch - path.end_s() > 2.5 {
            let step_s = between(random, [0.5, 2.0]);
            let next = wander(ground, &path.last(), slow * step_s, random);
            path.to(next, step_s);
        }
        let left = stretch - path.end_s();
        let next = wander(ground, &path.last(), 0.5 * slow * left, random);
        path.to(next, left);
        used += path.end_s();
        at = path.last();
        parts.push(path.motion(&ground.names, Via::Pass));
        let pause = between(random, [0.3, 1.5]).min(length_s - used);
        if happens(random, 0.6) && pause > 0.05 {
            parts.push(hold(ground, &at, pause));
            used += pause;
        }
    }
    if length_s - used > 0.02 {
        parts.push(hold(ground, &at, length_s - used));
    }
    MotionSpec::Sequence(parts)
}

/// A posture that is reached from another at most speed in a time (s); some joints are left alone.
fn wander(ground: &Ground<'_>, from: &[f64], time_s: f64, random: &mut ChaCha8Rng) -> Vec<f64> {
    let inner = ground.smaller(0.85);
    let mut next = from.to_vec();
    for (j, q) in next.iter_mut().enumerate() {
        if happens(random, 0.75) {
            let way = (ground.speed[j] * time_s).min(0.5 * ground.half[j]);
            *q += way * between(random, [-1.0, 1.0]);
        }
    }
    inner.clamp(&next)
}

fn hold(ground: &Ground<'_>, at: &[f64], duration_s: f64) -> MotionSpec {
    let at = at.iter().map(|q| (1e5 * q).round() * 1e-5);
    MotionSpec::Hold(Hold {
        posture_rad: ground.names.iter().cloned().zip(at).collect(),
        duration_s,
    })
}
