use crate::signals::along::Along;

/// The residual efforts of one run, in the wide band of the tones.
pub(crate) struct Rest<'a> {
    /// The run about the robot.
    pub along: Along<'a>,
    /// Time (s).
    pub time: Vec<f64>,
    /// `[joint][sample]`: position and velocity of the motors, residual effort.
    pub q: Vec<Vec<f64>>,
    pub qd: Vec<Vec<f64>>,
    pub left: Vec<Vec<f64>>,
    /// Whether dry friction holds the joint at a sample, or at a moment that the low-pass mixes into the sample.
    pub stands: Vec<Vec<bool>>,
}

impl<'a> Rest<'a> {
    /// The efforts minus those of the robot of `along`, with the positions and velocities of the motors and the
    /// samples in which they stand.
    pub fn new(along: Along<'a>) -> Self {
        Self {
            time: along.time(),
            q: along.thin(&along.motion.q),
            qd: along.thin(&along.motion.qd),
            left: along.remaining_effort(&along.measured_effort()),
            stands: (0..along.motion.q.len()).map(|j| along.stands(j)).collect(),
            along,
        }
    }
}
