use motion::{Motion, State};

use crate::scenario::spec::ServoSpec;

/// Share of a period by which a time may fall short of a goal's and still count as it.
const ROUNDING: f64 = 1e-6;

/// What the joints are told to follow, and what their loops follow: the motion, or goals of it that servos hold.
#[derive(Debug, Clone)]
pub(crate) struct Goals<'a> {
    motion: &'a Motion,
    servo: Option<ServoSpec>,
    sent: State,
    /// The goal of the position loops, which do not know its velocity; `None` without servos.
    held: Option<State>,
}

impl<'a> Goals<'a> {
    /// Those at the start of a motion.
    pub fn new(motion: &'a Motion, servo: Option<ServoSpec>) -> Self {
        let sent = motion.at(0.0);
        let held = servo.map(|_| at_rest(sent.clone()));
        Self { motion, servo, sent, held }
    }

    /// Goes to a time since the start (s).
    pub fn advance(&mut self, time_s: f64) {
        let (Some(servo), Some(held)) = (self.servo, &mut self.held) else {
            self.motion.sample(time_s, &mut self.sent);
            return;
        };
        let last_goal_s = |time_s: f64| {
            (time_s * servo.goal_rate_hz + ROUNDING).floor().max(0.0) / servo.goal_rate_hz
        };
        self.motion.sample(last_goal_s(time_s), &mut self.sent);
        self.motion.sample(last_goal_s(time_s - 1e-3 * servo.goal_delay_ms), held);
        held.qd.fill(0.0);
    }

    /// What is sent at this time, and logged.
    pub fn of_log(&self) -> &State {
        &self.sent
    }

    /// What the loops follow at this time.
    pub fn of_loop(&self) -> &State {
        self.held.as_ref().unwrap_or(&self.sent)
    }
}

fn at_rest(mut state: State) -> State {
    state.qd.fill(0.0);
    state
}
