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

/// Why the machine stopped: a joint left its allowed range.
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

/// An arm that takes torques and reports its state: a simulation, or the driver of a real arm.
///
/// One period of a control loop calls [`read`](Self::read), computes a torque and calls
/// [`actuate`](Self::actuate).
pub trait Machine {
    /// Number of joints.
    fn joint_count(&self) -> usize;

    /// Time for which a command is held (s).
    fn period_s(&self) -> f64;

    /// Fills `reading` with the current sensor values, one entry per joint.
    ///
    /// # Errors
    ///
    /// [`MachineFault`] when the machine has stopped.
    fn read(&mut self, reading: &mut Reading) -> Result<(), MachineFault>;

    /// Holds a torque or force on every joint (N m or N) for one period, and returns at its end.
    ///
    /// # Errors
    ///
    /// [`MachineFault`] when a joint leaves its allowed range; the machine has then stopped.
    fn actuate(&mut self, effort: &[f64]) -> Result<(), MachineFault>;

    /// Link positions behind the transmission at the last [`read`](Self::read) (rad or m); `None` for a
    /// machine with encoders at its motors alone.
    fn link_positions(&self) -> Option<&[f64]> {
        None
    }
}
