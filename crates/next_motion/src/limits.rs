use robot::{Joint, Link, Robot};

/// Share of every limit that a designed motion uses: a robot does not follow exactly.
const SHARE: f64 = 0.8;

/// Half the range of a joint without position limits (rad or m).
const REACH: f64 = 0.5;

/// Speed of a joint without a velocity limit (rad/s or m/s).
const SPEED: f64 = 1.0;

/// Effort that stands for that of a joint without an effort limit (N·m or N).
const EFFORT: f64 = 10.0;

/// Time in which a joint may come to its speed (s).
const RISE_S: f64 = 0.2;

/// What a designed motion may use of a joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Usable {
    /// Middle of the positions (rad or m).
    pub middle: f64,
    /// Half of their range (rad or m).
    pub half: f64,
    /// Largest speed (rad/s or m/s).
    pub speed: f64,
    /// Largest acceleration (rad/s² or m/s²).
    pub acceleration: f64,
    /// Largest effort (N·m or N).
    pub effort: f64,
}

impl Usable {
    /// Four fifths of a joint's limits.
    fn of(joint: &Joint) -> Self {
        let limits = &joint.limits;
        let (low, high) = limits.position.unwrap_or((-REACH, REACH));
        let speed = SHARE * limits.velocity.unwrap_or(SPEED);
        Self {
            middle: 0.5 * (low + high),
            half: 0.5 * SHARE * (high - low).min(std::f64::consts::TAU),
            speed,
            acceleration: speed / RISE_S,
            effort: SHARE * limits.effort.unwrap_or(f64::INFINITY),
        }
    }

    /// Farthest that a move from rest to rest may lead in a time (s), by
    /// `10 u^3 - 15 u^4 + 6 u^5`: it peaks at 15/8 of its mean speed, and its acceleration at
    /// `10 / sqrt(3)` distances over the time squared.
    pub fn farthest(&self, time_s: f64) -> f64 {
        let by_speed = self.speed * time_s / 1.875;
        by_speed.min(self.acceleration * time_s * time_s * 0.1 * 3.0_f64.sqrt())
    }
}

/// What a designed motion may use of every joint.
pub(crate) fn usable(robot: &Robot) -> Vec<Usable> {
    robot.links().iter().map(|link| Usable::of(&link.joint)).collect()
}

/// Effort limits of the joints (N·m or N), with a default for joints without one.
pub(crate) fn efforts(robot: &Robot) -> Vec<f64> {
    let effort = |link: &Link| link.joint.limits.effort.unwrap_or(EFFORT);
    robot.links().iter().map(effort).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::turntable;

    #[test]
    fn four_fifths_of_every_limit_are_usable() {
        let [one] = usable(&turntable()).try_into().unwrap();
        let expected =
            Usable { middle: 0.5, half: 1.2, speed: 2.4, acceleration: 12.0, effort: 40.0 };
        let pairs = [
            (one.middle, expected.middle),
            (one.half, expected.half),
            (one.speed, expected.speed),
            (one.acceleration, expected.acceleration),
            (one.effort, expected.effort),
        ];
        assert!(pairs.iter().all(|(found, wanted)| (found - wanted).abs() < 1e-12), "{one:?}");
    }

    /// Of `10 u^3 - 15 u^4 + 6 u^5` the speed is largest at `u = 1/2`, the acceleration at
    /// `u = 1/2 - sqrt(3)/6`.
    #[test]
    fn the_farthest_move_is_as_fast_as_is_usable_and_no_faster() {
        let [one] = usable(&turntable()).try_into().unwrap();
        for time_s in [0.1, 0.3, 1.0, 5.0] {
            let distance = one.farthest(time_s);
            let speed = distance / time_s * 30.0 / 16.0;
            let u = 0.5 - 3.0_f64.sqrt() / 6.0;
            let bend = 60.0 * u - 180.0 * u * u + 120.0 * u.powi(3);
            let acceleration = distance / (time_s * time_s) * bend;
            let used = (speed / one.speed).max(acceleration / one.acceleration);
            assert!((used - 1.0).abs() < 1e-12, "{used} in {time_s} s");
        }
    }
}
