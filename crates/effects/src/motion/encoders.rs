use logs::GoalEffort;

/// Position, velocity and acceleration, each `[joint][sample]`.
pub(crate) type JointMotions = [Vec<Vec<f64>>; 3];

/// Position, velocity and acceleration of one link, each `[sample]`.
pub(crate) type LinkMotion = [Vec<f64>; 3];

/// Signals of the encoders in one run, and of what was sent to the drives.
#[derive(Debug, Clone)]
pub struct Encoders {
    /// Position, velocity and acceleration as reported, each `[joint][sample]` (rad or m, /s,
    /// /s²).
    pub reported: [Vec<Vec<f64>>; 3],
    /// The same of the links that have an encoder of their own; `reported` is then the motor's.
    pub links: Vec<Option<[Vec<f64>; 3]>>,
    /// Parts of the efforts that follow the goals, where efforts are computed from goals.
    pub goal_efforts: Vec<Option<GoalEffort>>,
    /// Time from when the drives were cold to the first sample (s).
    pub since_cold_s: f64,
}
