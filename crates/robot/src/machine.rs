/// What a machine reports at one instant, joints in the order of the robot.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Reading {
    /// Time since the machine was started (s).
    pub time_s: f64,
    /// Position (rad or m).
    pub q: Vec<f64>,
    /// Velocity (rad/s or m/s).
    pub qd: Vec<f64>,
    /// Torque or force, positive when it accelerates the joint in its positive direction
    /// (N m or N).
    pub effort: Vec<f64>,
}

impl Reading {
    /// A reading of zeros for `joint_count` joints.
    pub fn zero(joint_count: usize) -> Self {
        let zeros = vec![0.0; joint_count];
        Self { time_s: 0.0, q: zeros.clone(), qd: zeros.clone(), effort: zeros }
    }
}

/// The machine stopped: a joint did what no joint may.
#[derive(Debug, Clone, PartialEq)]
pub struct MachineFault {
    /// When (s).
    pub time_s: f64,
    /// The joint.
    pub joint: String,
    /// What was out of bounds, with its value and the bound.
    pub found: String,
    /// What to change.
    pub advice: String,
}

impl std::fmt::Display for MachineFault {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self { time_s, joint, found, advice } = self;
        write!(f, "joint {joint} at {time_s:.4} s: {found}; {advice}")
    }
}

impl std::error::Error for MachineFault {}

/// An arm that takes torques and tells where it is: a simulation, or the driver of a real arm.
///
/// One turn of a control loop is [`read`](Self::read), then a torque from it, then
/// [`actuate`](Self::actuate).
pub trait Machine {
    /// Number of joints.
    fn joint_count(&self) -> usize;

    /// Time for which a command is held (s).
    fn period_s(&self) -> f64;

    /// Fills `reading`, whose vectors have one entry a joint, with what the sensors say now.
    ///
    /// # Errors
    ///
    /// [`MachineFault`] when the machine has stopped.
    fn read(&mut self, reading: &mut Reading) -> Result<(), MachineFault>;

    /// Holds a torque or force on every joint (N m or N) for one period, and returns at its end.
    ///
    /// # Errors
    ///
    /// [`MachineFault`] when a joint does what no joint may; the machine has then stopped.
    fn actuate(&mut self, effort: &[f64]) -> Result<(), MachineFault>;

    /// Where the links are at the time of the last [`read`](Self::read), behind the transmission
    /// (rad or m), where the machine knows: one with encoders at its motors alone does not.
    fn link_positions(&self) -> Option<&[f64]> {
        None
    }
}
