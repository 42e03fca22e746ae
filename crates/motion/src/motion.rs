use crate::{clock::Clock, curve::Curve};

/// Position, velocity and acceleration of all joints, in the order of the robot.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct State {
    /// Position (rad or m).
    pub q: Vec<f64>,
    /// Velocity (rad/s or m/s).
    pub qd: Vec<f64>,
    /// Acceleration (rad/s² or m/s²).
    pub qdd: Vec<f64>,
}

/// The reference of all joints of a robot, from time 0 to its end.
///
/// ```text
/// q(t) = x(s(t)),   qd = x' s',   qdd = x'' s'^2 + x' s''
/// ```
///
/// with `x` a closed form and `s` its clock, which starts and stops smoothly where the
/// motion fades in and out. Made by [`MotionSpec::build`](crate::MotionSpec::build), so within the limits of
/// the robot.
#[derive(Debug, Clone, PartialEq)]
pub struct Motion {
    joint_count: usize,
    duration_s: f64,
    /// At least one, each with the time at which it begins.
    parts: Vec<(f64, ClockedCurve)>,
}

/// One curve and its clock.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct ClockedCurve {
    pub curve: Curve,
    pub clock: Clock,
}

impl Motion {
    /// The parts one after the other.
    pub(crate) fn new(joint_count: usize, parts: Vec<ClockedCurve>) -> Self {
        let mut duration_s = 0.0;
        let begin = |part: ClockedCurve| {
            let begin_s = duration_s;
            duration_s += part.clock.duration_s();
            (begin_s, part)
        };
        let parts = parts.into_iter().map(begin).collect();
        Self { joint_count, duration_s, parts }
    }

    /// Number of joints.
    pub fn joint_count(&self) -> usize {
        self.joint_count
    }

    /// Time from the beginning to the end (s).
    pub fn duration_s(&self) -> f64 {
        self.duration_s
    }

    /// Puts the state at a time (s) into `state`.
    ///
    /// Before 0 and after the end it rests where the motion begins and ends; a time that is
    /// not a number counts as 0. Allocates nothing once `state` has the robot's size.
    pub fn sample(&self, time_s: f64, state: &mut State) {
        for signal in [&mut state.q, &mut state.qd, &mut state.qdd] {
            signal.resize(self.joint_count, 0.0);
        }
        let t = time_s.max(0.0).min(self.duration_s);
        let rests = t < time_s || time_s < 0.0;
        let part = self.parts.partition_point(|(begin_s, _)| *begin_s <= t).saturating_sub(1);
        let Some((begin_s, part)) = self.parts.get(part) else { return };
        for joint in 0..self.joint_count {
            let [q, qd, qdd] = part.at(joint, t - begin_s);
            state.q[joint] = q;
            state.qd[joint] = if rests { 0.0 } else { qd };
            state.qdd[joint] = if rests { 0.0 } else { qdd };
        }
    }

    /// The state at a time (s), as [`Motion::sample`] gives it.
    pub fn at(&self, time_s: f64) -> State {
        let mut state = State::default();
        self.sample(time_s, &mut state);
        state
    }
}

impl ClockedCurve {
    /// Position, velocity and acceleration of a joint at a time since the part began (s).
    pub(crate) fn at(&self, joint: usize, time_s: f64) -> [f64; 3] {
        let [s, ds, dds] = self.clock.at(time_s);
        let [x, dx, ddx] = self.curve.at(joint, s);
        [x, dx * ds, ddx * ds * ds + dx * dds]
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::knots::Knots;

    fn moves_for_one_second(to: f64) -> ClockedCurve {
        let mut knots = Knots::at_rest(vec![to - 1.0]);
        knots.glide(&[to], 1.0);
        ClockedCurve { curve: Curve::Knots(knots), clock: Clock::steady(1.0) }
    }

    #[test]
    fn a_motion_rests_at_its_ends_outside_its_time() {
        let motion = Motion::new(1, vec![moves_for_one_second(1.0), moves_for_one_second(2.0)]);
        assert!((motion.duration_s() - 2.0).abs() < 1e-15);
        for (time, q) in [(-3.0, 0.0), (f64::NAN, 0.0), (2.5, 2.0), (f64::INFINITY, 2.0)] {
            let expected = State { q: vec![q], qd: vec![0.0], qdd: vec![0.0] };
            assert_eq!(motion.at(time), expected, "at {time} s");
        }
        assert_eq!(motion.at(0.5).q, [0.5]);
        assert_eq!(motion.at(1.5).qd, [1.875]);
    }
}
