use motion::{Motion, State};

use crate::scenario::spec::ServoSpec;

/// Share of a period by which a time may fall short of a goal's and still count as it.
const ROUNDING: f64 = 1e-6;

/// What the joints are told to follow, and what their loops follow: the motion, or goals of it that servos hold.
#[derive(Debug, Clone)]
pub(crate) struct Goals<'a> {
    motion: &'a Motion,
    servo: Option<ServoSpec>,
    /// Time from sending to following (s).
    delay_s: f64,
    sent: State,
    followed: State,
}

impl<'a> Goals<'a> {
    /// Those at the start of a motion, followed `delay_s` later beside the delay of the servos.
    pub fn new(motion: &'a Motion, servo: Option<ServoSpec>, delay_s: f64) -> Self {
        let sent = motion.at(0.0);
        let delay_s = delay_s + servo.map_or(0.0, |servo| 1e-3 * servo.goal_delay_ms);
        Self { motion, servo, delay_s, followed: sent.clone(), sent }
    }

    /// Goes to a time since the start (s).
    pub fn advance(&mut self, time_s: f64) {
        let Some(servo) = self.servo else {
            self.motion.sample(time_s, &mut self.sent);
            self.motion.sample((time_s - self.delay_s).max(0.0), &mut self.followed);
            return;
        };
        let last_goal_s = |time_s: f64| {
            (time_s * servo.goal_rate_hz + ROUNDING).floor().max(0.0) / servo.goal_rate_hz
        };
        self.motion.sample(last_goal_s(time_s), &mut self.sent);
        self.motion.sample(last_goal_s(time_s - self.delay_s), &mut self.followed);
        // A position loop does not know the velocity of its goal.
        self.followed.qd.fill(0.0);
    }

    /// What is sent at this time, and logged.
    pub fn of_log(&self) -> &State {
        &self.sent
    }

    /// What the loops follow at this time.
    pub fn of_loop(&self) -> &State {
        &self.followed
    }
}
