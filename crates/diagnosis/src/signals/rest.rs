use logs::LogError;

use crate::signals::along::Along;

/// What a robot leaves of one run, in the wide band.
pub(crate) struct Rest<'a> {
    /// The run about the robot.
    pub along: Along<'a>,
    /// Time (s).
    pub time: Vec<f64>,
    /// `[joint][sample]`: position and velocity of the motors, effort that is left.
    pub q: Vec<Vec<f64>>,
    pub qd: Vec<Vec<f64>>,
    pub left: Vec<Vec<f64>>,
    /// Whether the joint is held by any part of its dry friction, or the low-pass mixes that in.
    pub stands: Vec<Vec<bool>>,
}

impl<'a> Rest<'a> {
    /// What the robot of `along` leaves of the efforts, with the positions and speeds of the motors
    /// and where they stand.
    pub fn new(along: Along<'a>) -> Result<Self, LogError> {
        Ok(Self {
            time: along.time(),
            q: along.thin(&along.motion.q),
            qd: along.thin(&along.motion.qd),
            left: along.left(&along.measured()?),
            stands: (0..along.motion.q.len()).map(|j| along.stands(j)).collect(),
            along,
        })
    }
}
