use std::collections::BTreeMap;

use motion::{MotionSpec, Via, Waypoints};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use robot::Robot;

use crate::limits::Usable;

/// Shortest and longest mean time of a move (s).
const MEAN_MOVE_S: [f64; 2] = [0.4, 2.5];

/// Least time of a move (s).
const LEAST_MOVE_S: f64 = 0.25;

/// Share of the moves that are rests.
const RESTS: f64 = 0.2;

/// Smallest and largest part of the range that a motion is drawn in.
const REACH: [f64; 2] = [0.3, 1.0];

/// Least and greatest unevenness of the times of the moves of a motion: standard deviation of
/// their logarithm.
const UNEVENNESS: [f64; 2] = [0.2, 1.2];

/// Change of the logarithm of a time, standard deviation.
const CHANGE_OF_TIME: f64 = 0.7;

/// Change of a position, standard deviation, as a share of half the range.
const CHANGE_OF_PLACE: f64 = 0.4;

/// A motion from rest to rest to rest: moves slow and fast, short and long, and rests.
///
/// Positions are shares of the usable range, times shares of the whole duration.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Steps {
    /// Where the motion begins, by joint, -1 to 1.
    start: Vec<f64>,
    moves: Vec<Move>,
}

#[derive(Debug, Clone, PartialEq)]
struct Move {
    /// Where it leads, by joint, -1 to 1; none for a rest.
    to: Option<Vec<f64>>,
    /// Logarithm of its time, up to a constant.
    log_time: f64,
}

impl Steps {
    /// A random motion for `joints` joints.
    pub fn draw(joints: usize, duration_s: f64, rng: &mut ChaCha8Rng) -> Self {
        // A part of the range about a place in it: steps in amplitude and in offset.
        let reach = draw_between(REACH, rng);
        let about: Vec<f64> = posture(joints, 1.0 - reach, rng);
        let near = |rng: &mut ChaCha8Rng| {
            let mut to = posture(joints, reach, rng);
            to.iter_mut().zip(&about).for_each(|(to, about)| *to += about);
            to
        };
        let spread = draw_between(UNEVENNESS, rng);
        let mean_s = draw_between(MEAN_MOVE_S.map(f64::ln), rng).exp();
        let count = (duration_s / mean_s).ceil().max(2.0) as usize;
        let start = near(rng);
        let draw = |_| {
            let log_time = spread * normal(rng);
            let rests = rng.random_bool(RESTS);
            Move { to: (!rests).then(|| near(rng)), log_time }
        };
        Self { start, moves: (0..count).map(draw).collect() }
    }

    /// The same with one move changed: its time, whether it is a rest, or, as often as both,
    /// where it leads.
    pub fn vary_one_move(&self, rng: &mut ChaCha8Rng) -> Self {
        let mut steps = self.clone();
        let k = rng.random_range(0..steps.moves.len());
        let joints = self.start.len();
        let own = &mut steps.moves[k];
        match rng.random_range(0..4) {
            0 => own.log_time += CHANGE_OF_TIME * normal(rng),
            1 => {
                own.to = match own.to {
                    Some(_) => None,
                    None => Some(posture(joints, 1.0, rng)),
                }
            }
            _ => {
                let to = own.to.get_or_insert_with(|| posture(joints, 1.0, rng));
                for x in to {
                    *x = (*x + CHANGE_OF_PLACE * normal(rng)).clamp(-1.0, 1.0);
                }
            }
        }
        steps
    }

    /// The same with a joint that stays where it begins.
    pub fn with_joint_at_rest(&self, joint: usize) -> Self {
        let mut calm = self.clone();
        for to in calm.moves.iter_mut().filter_map(|m| m.to.as_mut()) {
            to[joint] = self.start[joint];
        }
        calm
    }

    /// The motion within what is usable: a move that would be too fast does not lead as far.
    ///
    /// Times are rounded to milliseconds, positions to 1e-4 rad, so that the file that holds
    /// them can be read.
    pub fn spec(&self, robot: &Robot, usable: &[Usable], duration_s: f64) -> MotionSpec {
        let total: f64 = self.moves.iter().map(|m| m.log_time.exp()).sum();
        let least = LEAST_MOVE_S.min(0.5 * duration_s / self.moves.len() as f64);
        let shared = duration_s - least * self.moves.len() as f64;
        let place = |share: f64, u: &Usable| u.middle + share * u.half;
        let mut here: Vec<f64> =
            self.start.iter().zip(usable).map(|(s, u)| round_to(place(*s, u), 1e4)).collect();
        let (mut times_s, mut positions) = (vec![0.0], vec![here.clone()]);
        let mut elapsed = 0.0;
        let mut before: f64 = 0.0;
        for own in &self.moves {
            elapsed += least + shared * own.log_time.exp() / total;
            let time = round_to(elapsed, 1e3);
            if let Some(to) = &own.to {
                for ((here, share), u) in here.iter_mut().zip(to).zip(usable) {
                    let farthest = u.farthest(time - before);
                    let step = (place(*share, u) - *here).clamp(-farthest, farthest);
                    *here = round_to(*here + step, 1e4);
                }
            }
            times_s.push(time);
            positions.push(here.clone());
            before = time;
        }
        let of = |j: usize| positions.iter().map(|p| p[j]).collect::<Vec<f64>>();
        let positions_rad: BTreeMap<String, Vec<f64>> =
            robot.joint_names().enumerate().map(|(j, name)| (name.to_owned(), of(j))).collect();
        MotionSpec::Waypoints(Waypoints { times_s, positions_rad, via: Via::Stop })
    }
}

fn posture(joints: usize, reach: f64, rng: &mut ChaCha8Rng) -> Vec<f64> {
    (0..joints).map(|_| reach * rng.random_range(-1.0..=1.0)).collect()
}

fn normal(rng: &mut ChaCha8Rng) -> f64 {
    StandardNormal.sample(rng)
}

fn draw_between([low, high]: [f64; 2], rng: &mut ChaCha8Rng) -> f64 {
    rng.random_range(low..=high)
}

fn round_to(x: f64, steps: f64) -> f64 {
    (x * steps).round() / steps
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use rand::SeedableRng;

    use super::*;
    use crate::limits::usable;
    use crate::testing::arm;

    #[test]
    fn every_motion_keeps_to_what_is_usable_and_lasts_as_long_as_asked() {
        let robot = arm();
        let usable = usable(&robot);
        for seed in 0..40 {
            let mut rng = ChaCha8Rng::seed_from_u64(seed);
            let mut steps = Steps::draw(2, 12.0, &mut rng);
            (0..seed).for_each(|_| steps = steps.vary_one_move(&mut rng));
            let motion = steps.spec(&robot, &usable, 12.0).build(&robot, Path::new(".")).unwrap();
            assert!((motion.duration_s() - 12.0).abs() < 1e-9);
            let [first, last] = [0.0, 12.0].map(|t| motion.at(t));
            assert!(
                [first.qd, first.qdd, last.qd, last.qdd].iter().flatten().all(|v| v.abs() < 1e-9)
            );
            for state in (0..6000).map(|k| motion.at(0.002 * f64::from(k))) {
                for (j, u) in usable.iter().enumerate() {
                    // Positions are rounded to 1e-4, in moves of a fifth of a second at least.
                    assert!((state.q[j] - u.middle).abs() <= u.half + 1e-4);
                    assert!(state.qd[j].abs() <= u.speed + 1e-4 * 1.875 / 0.2);
                    assert!(state.qdd[j].abs() <= u.acceleration + 1e-4 * 5.78 / 0.04);
                }
            }
        }
    }

    #[test]
    fn motions_have_rests_and_differ_in_pace() {
        let mut shortest = f64::INFINITY;
        let mut longest: f64 = 0.0;
        let mut rests = 0;
        for seed in 0..40 {
            let steps = Steps::draw(1, 20.0, &mut ChaCha8Rng::seed_from_u64(seed));
            rests += steps.moves.iter().filter(|m| m.to.is_none()).count();
            let robot = crate::testing::turntable();
            let MotionSpec::Waypoints(spec) = steps.spec(&robot, &usable(&robot), 20.0) else {
                return;
            };
            for pair in spec.times_s.windows(2) {
                shortest = shortest.min(pair[1] - pair[0]);
                longest = longest.max(pair[1] - pair[0]);
            }
        }
        assert!(rests > 40, "{rests}");
        assert!((0.2..0.3).contains(&shortest) && longest > 3.0, "{shortest} {longest}");
    }
}
