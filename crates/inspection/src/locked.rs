use std::collections::BTreeMap;
use std::f64::consts::PI;

use robot::Robot;

use crate::fit::Drive;
use crate::judge::{Judge, ReadingFit};
use crate::log_reading::LogReading;
use crate::nominal_torque::NominalTorque;
use crate::observation::OtherLock;

/// Positions of locked joints that fit the efforts better than those of the description.
///
/// A joint that stands still turns the links behind it, so that gravity and inertia of all others depend on where it stands. Tried
/// are rotations: each alone over its range, then pairs of those that matter, then one after the other between the neighbours of the
/// best. A joint that changes little goes back to where it is described. `None` where no joint is locked, where none of them
/// matters, and where the efforts do not contradict the description.
pub(crate) fn locked_elsewhere(judge: &Judge, as_is: &ReadingFit) -> Option<LogReading> {
    let t = judge.thresholds;
    let contradicts =
        |j: usize| as_is.shares[j] >= t.misfit[1].max(t.above_floor * judge.floors[j]);
    if !(0..as_is.shares.len()).any(contradicts) {
        return None;
    }
    let mut postures = Postures::new(judge, as_is);
    let singles = postures.singles();
    if singles.is_empty() {
        return None;
    }
    postures.joints.retain(|joint| singles.contains_key(&joint.name));
    let best = singles.values().max_by(|a, b| a.gain.total_cmp(&b.gain))?.clone();
    let best = postures.pairs(best);
    let best = postures.without_idle(postures.refine(best));
    (!best.at.is_empty()).then_some(LogReading::LockedAt(best.at))
}

/// The joints of a reading, with their positions in the description.
pub(crate) fn other_locks(robot: &Robot, reading: &LogReading) -> Vec<OtherLock> {
    let LogReading::LockedAt(at) = reading else { return Vec::new() };
    let moved = robot.locks().iter().filter_map(|lock| Some((lock, *at.get(&lock.joint)?)));
    let other = |(lock, position): (&robot::LockedJoint, f64)| OtherLock {
        joint: lock.joint.clone(),
        described: lock.position,
        position,
    };
    moved.map(other).collect()
}

/// Positions of some locked joints (rad), and the gain of reading the logs so.
#[derive(Debug, Clone)]
struct Posture {
    at: BTreeMap<String, f64>,
    gain: f64,
}

/// A locked rotation and the positions that are tried (rad).
struct Tried {
    name: String,
    positions: Vec<f64>,
}

/// The search over positions of locked joints.
struct Postures<'a> {
    judge: &'a Judge<'a>,
    as_is: &'a ReadingFit,
    joints: Vec<Tried>,
}

impl<'a> Postures<'a> {
    fn new(judge: &'a Judge<'a>, as_is: &'a ReadingFit) -> Self {
        // A joint of another limb turns nothing that moves.
        let turns = |lock: &&robot::LockedJoint| {
            let elsewhere = BTreeMap::from([(lock.joint.clone(), lock.position + 1.0)]);
            let other = judge.robot.locked_at(&elsewhere);
            other.is_some_and(|other| other.links() != judge.robot.links())
        };
        let own = judge.robot.locks().iter().filter(|lock| lock.mimics.is_none()).filter(turns);
        let tried = |lock: &robot::LockedJoint| {
            let joint = &judge.robot.locked_link(&lock.joint)?.joint;
            let limits = joint.limits.position;
            let (low, high) =
                limits.filter(|(low, high)| high - low < 2.0 * PI).unwrap_or((-PI, PI));
            let steps = ((high - low) / judge.thresholds.lock_step).ceil().max(1.0);
            let at = |k: usize| low + (high - low) * k as f64 / steps;
            joint.kind.is_rotation().then(|| Tried {
                name: lock.joint.clone(),
                positions: (0..=steps as usize).map(at).collect(),
            })
        };
        Self { judge, as_is, joints: own.filter_map(tried).collect() }
    }

    /// The gain of a posture; minus infinity where the robot has none such.
    fn gain(&self, at: &BTreeMap<String, f64>) -> f64 {
        let Some(robot) = self.judge.robot.locked_at(at) else { return f64::NEG_INFINITY };
        let samples = &self.judge.samples;
        let tau = NominalTorque::new(&robot).whole(samples.joints, &samples.motion);
        let drive = Drive { gain: self.judge.thresholds.exact_gain };
        let fits = self.judge.fits(samples, &tau, drive);
        let shares: Vec<f64> = fits.iter().map(|fit| fit.share).collect();
        self.judge.gain(&self.as_is.shares, &shares)
    }

    fn posture(&self, at: BTreeMap<String, f64>) -> Posture {
        let gain = self.gain(&at);
        Posture { at, gain }
    }

    fn with(&self, from: &Posture, joint: &str, position: f64) -> Posture {
        let mut at = from.at.clone();
        at.insert(joint.to_owned(), position);
        self.posture(at)
    }

    /// The best position of each joint alone, of those joints whose position changes the fit.
    fn singles(&self) -> BTreeMap<String, Posture> {
        let described = self.posture(BTreeMap::new());
        let mut all = BTreeMap::new();
        for joint in &self.joints {
            let tried: Vec<Posture> =
                joint.positions.iter().map(|q| self.with(&described, &joint.name, *q)).collect();
            let least = tried.iter().map(|p| p.gain).fold(f64::INFINITY, f64::min);
            let Some(best) = tried.into_iter().max_by(|a, b| a.gain.total_cmp(&b.gain)) else {
                continue;
            };
            if best.gain - least > self.judge.thresholds.idle_lock {
                all.insert(joint.name.clone(), best);
            }
        }
        all
    }

    /// The best of `best` and of pairs of joints, at every other position tried.
    fn pairs(&self, mut best: Posture) -> Posture {
        let none = Posture { at: BTreeMap::new(), gain: f64::NEG_INFINITY };
        let most = self.joints.len().min(self.judge.thresholds.paired_locks);
        for (k, first) in self.joints[..most].iter().enumerate() {
            for second in &self.joints[k + 1..most] {
                for a in first.positions.iter().step_by(2) {
                    let from = self.with(&none, &first.name, *a);
                    for b in second.positions.iter().step_by(2) {
                        let pair = self.with(&from, &second.name, *b);
                        if pair.gain > best.gain {
                            best = pair;
                        }
                    }
                }
            }
        }
        best
    }

    /// The best that steps of single joints lead to, down to a tenth of a degree.
    fn refine(&self, mut best: Posture) -> Posture {
        let mut step = 2.0 * self.judge.thresholds.lock_step;
        while step > self.judge.thresholds.lock_precision {
            let before = best.gain;
            for joint in &self.joints {
                let lock = self.judge.robot.locks().iter().find(|lock| lock.joint == joint.name);
                let described = lock.map_or(0.0, |lock| lock.position);
                let now = best.at.get(&joint.name).copied().unwrap_or(described);
                for q in [now - step, now + step] {
                    let next = self.with(&best, &joint.name, q);
                    if next.gain > best.gain {
                        best = next;
                    }
                }
            }
            if best.gain - before < 1e-9 {
                step *= 0.5;
            }
        }
        best
    }

    /// The posture without the joints that change little.
    fn without_idle(&self, mut best: Posture) -> Posture {
        loop {
            let without = best.at.keys().map(|joint| {
                let mut at = best.at.clone();
                at.remove(joint);
                self.posture(at)
            });
            let Some(next) = without.max_by(|a, b| a.gain.total_cmp(&b.gain)) else { return best };
            if best.gain - next.gain > self.judge.thresholds.idle_lock {
                return best;
            }
            best = next;
        }
    }
}
