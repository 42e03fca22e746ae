use std::{
    collections::BTreeMap,
    ops::{Bound, RangeBounds},
    path::Path,
};

use robot::{Joint, Robot};

use crate::clock::Clock;
use crate::curve::Curve;
use crate::error::{LimitedQuantity, MotionError};
use crate::extremes::extremes;
use crate::knots::Knots;
use crate::motion::ClockedCurve;

/// Longest motion (s): a day.
pub(crate) const LONGEST_S: f64 = 86_400.0;
/// Highest frequency (Hz).
const HIGHEST_HZ: f64 = 100.0;
/// Most periods of the highest frequency in one motion.
const MOST_PERIODS: f64 = 1e4;
/// How far a value may pass a limit by rounding, relative to the limit.
const ROUNDING: f64 = 1e-9;

/// Where a value stands in the spec, and the robot that it speaks of.
#[derive(Debug, Clone)]
pub(crate) struct Site<'a> {
    pub robot: &'a Robot,
    /// Folder that relative paths start from.
    pub folder: &'a Path,
    key: String,
}

impl<'a> Site<'a> {
    pub(crate) fn new(robot: &'a Robot, folder: &'a Path) -> Self {
        Self { robot, folder, key: String::new() }
    }

    /// The site of a value in the table of this one.
    pub(crate) fn within(&self, part: &str) -> Self {
        Self { key: self.key(&[part]), ..self.clone() }
    }

    /// The key of a value some tables below.
    pub(crate) fn key(&self, parts: &[&str]) -> String {
        let bare = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
        let mut key = self.key.clone();
        for part in parts {
            if !key.is_empty() {
                key.push('.');
            }
            match !part.is_empty() && part.chars().all(bare) {
                true => key.push_str(part),
                false => key.push_str(&format!("{part:?}")),
            }
        }
        key
    }

    pub(crate) fn joint(&self, index: usize) -> &'a Joint {
        &self.robot.links()[index].joint
    }

    /// Index of a joint named below `key`.
    pub(crate) fn joint_index(&self, key: &str, joint: &str) -> Result<usize, MotionError> {
        self.robot.joint_index(joint).ok_or_else(|| MotionError::UnknownJoint {
            key: self.key(&[key, joint]),
            joint: joint.to_owned(),
            expected: self.robot.joint_names().map(str::to_owned).collect(),
        })
    }

    /// The entries of a map of joints, by index.
    pub(crate) fn by_index<'m, T>(
        &self,
        key: &str,
        map: &'m BTreeMap<String, T>,
    ) -> Result<Vec<Option<&'m T>>, MotionError> {
        let mut entries: Vec<Option<&T>> = vec![None; self.robot.joint_count()];
        for (joint, value) in map {
            entries[self.joint_index(key, joint)?] = Some(value);
        }
        Ok(entries)
    }

    /// A posture (rad or m): the middle of a joint's range, 0 where it has none, for every
    /// joint that the map does not name.
    pub(crate) fn posture(
        &self,
        key: &str,
        map: &BTreeMap<String, f64>,
    ) -> Result<Vec<f64>, MotionError> {
        let middle = |joint: &Joint| joint.limits.position.map_or(0.0, |(a, b)| 0.5 * (a + b));
        let mut posture: Vec<f64> =
            (0..self.robot.joint_count()).map(|i| middle(self.joint(i))).collect();
        for (joint, &value) in map {
            self.number(&[key, joint], value, ..)?;
            posture[self.joint_index(key, joint)?] = value;
        }
        Ok(posture)
    }

    /// Refuses a number outside a range; the error states the range.
    pub(crate) fn number(
        &self,
        parts: &[&str],
        found: f64,
        range: impl RangeBounds<f64>,
    ) -> Result<(), MotionError> {
        if found.is_finite() && range.contains(&found) {
            return Ok(());
        }
        Err(MotionError::OutOfRange { key: self.key(parts), found, expected: words(&range) })
    }

    pub(crate) fn share(&self, key: &str, found: f64) -> Result<(), MotionError> {
        self.number(&[key], found, above_up_to(0.0, 1.0))
    }

    pub(crate) fn duration(&self, found_s: f64) -> Result<(), MotionError> {
        self.number(&["duration_s"], found_s, above_up_to(0.0, LONGEST_S))
    }

    /// Refuses a frequency that makes too many periods in a motion of `duration_s`.
    pub(crate) fn frequency(
        &self,
        key: &str,
        found_hz: f64,
        duration_s: f64,
    ) -> Result<(), MotionError> {
        let highest_hz = HIGHEST_HZ.min(MOST_PERIODS / duration_s);
        self.number(&[key], found_hz, above_up_to(0.0, highest_hz))
    }

    /// Refuses a motion that other values make too long.
    pub(crate) fn short_enough(&self, parts: &[&str], found_s: f64) -> Result<(), MotionError> {
        let short = found_s <= LONGEST_S;
        let key = || self.key(parts);
        if short {
            Ok(())
        } else {
            Err(MotionError::TooLong { key: key(), found_s, most_s: LONGEST_S })
        }
    }

    /// The clock of a motion of `duration_s` that fades in and out.
    pub(crate) fn clock(&self, duration_s: f64, fade_s: f64) -> Result<Clock, MotionError> {
        self.number(&["fade_s"], fade_s, 0.0..=0.5 * duration_s)?;
        Ok(Clock::fading(duration_s, fade_s))
    }

    /// Knots, one after the other at an even clock.
    pub(crate) fn evenly(&self, knots: Knots) -> Result<Vec<ClockedCurve>, MotionError> {
        let clock = Clock::steady(knots.duration_s());
        self.part(Curve::Knots(knots), clock)
    }

    /// A curve with its clock, held against the limits of every joint.
    pub(crate) fn part(
        &self,
        curve: Curve,
        clock: Clock,
    ) -> Result<Vec<ClockedCurve>, MotionError> {
        for index in 0..self.robot.joint_count() {
            let joint = self.joint(index);
            let found = extremes(&curve, index, clock.run_s());
            let speed = joint.limits.velocity.map(|limit| (-limit, limit));
            let rotates = joint.kind.is_rotation();
            let (angle, rate) = if rotates { ("rad", "rad/s") } else { ("m", "m/s") };
            for (limits, quantity, extreme, unit) in [
                (joint.limits.position, LimitedQuantity::Position, found.lowest, angle),
                (joint.limits.position, LimitedQuantity::Position, found.highest, angle),
                (speed, LimitedQuantity::Velocity, found.fastest, rate),
            ] {
                let (low, high) = limits.unwrap_or((f64::NEG_INFINITY, f64::INFINITY));
                let slack = ROUNDING * low.abs().max(high.abs()).min(1e3);
                let value = extreme.value;
                if value >= low - slack && value <= high + slack && value.is_finite() {
                    continue;
                }
                return Err(MotionError::LimitExceeded {
                    key: self.key.clone(),
                    joint: joint.name.clone(),
                    quantity,
                    time_s: clock.time_of(extreme.time_s),
                    found: value,
                    low,
                    high,
                    unit,
                });
            }
        }
        Ok(vec![ClockedCurve { curve, clock }])
    }
}

/// Numbers above `low` that are not above `high`.
pub(crate) fn above_up_to(low: f64, high: f64) -> impl RangeBounds<f64> {
    (Bound::Excluded(low), Bound::Included(high))
}

/// Numbers above `low`.
pub(crate) fn above(low: f64) -> impl RangeBounds<f64> {
    (Bound::Excluded(low), Bound::Unbounded)
}

/// A range in words.
fn words(range: &impl RangeBounds<f64>) -> String {
    let low = match range.start_bound() {
        Bound::Included(low) => Some(format!("not below {low}")),
        Bound::Excluded(low) => Some(format!("above {low}")),
        Bound::Unbounded => None,
    };
    let high = match range.end_bound() {
        Bound::Included(high) => Some(format!("not above {high}")),
        Bound::Excluded(high) => Some(format!("below {high}")),
        Bound::Unbounded => None,
    };
    let bounds: Vec<String> = low.into_iter().chain(high).collect();
    format!("a finite number {}", bounds.join(" and ")).trim_end().to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_range_says_what_it_holds() {
        assert_eq!(words(&..), "a finite number");
        assert_eq!(words(&above(0.0)), "a finite number above 0");
        assert_eq!(words(&(0.0..=2.5)), "a finite number not below 0 and not above 2.5");
    }
}
