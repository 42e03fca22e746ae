use nalgebra::Vector3;

/// Something that is wrong with logs as a whole, or with a stretch of them.
#[derive(Debug, Clone, PartialEq)]
pub struct Observation {
    /// What it is.
    pub kind: ObservationKind,
    /// Other readings that mend the logs as well: nothing in these logs tells them apart.
    pub or: Vec<Rival>,
    /// Joints that it concerns, by index; all of the robot's where it concerns the whole arm.
    pub joints: Vec<usize>,
    /// Runs that it concerns, by index.
    pub runs: Vec<usize>,
    /// The seconds that it concerns, where it does not concern whole runs.
    pub stretches: Vec<Stretch>,
    /// What cannot be used while it is not mended.
    pub spoils: Spoils,
    /// How well the nominal torque fits before and after, where that is what tells it.
    pub evidence: Option<Evidence>,
}

/// A reading that explains the logs as well as another one.
#[derive(Debug, Clone, PartialEq)]
pub struct Rival {
    /// What it is.
    pub kind: ObservationKind,
    /// Joints that it concerns.
    pub joints: Vec<usize>,
}

/// What cannot be used of logs.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Spoils {
    /// Nothing: all can be used.
    Nothing,
    /// The seconds of [`Observation::stretches`].
    Stretches,
    /// The efforts of [`Observation::joints`].
    Joints,
    /// All of it.
    Everything,
}

/// Some seconds of a run.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Stretch {
    /// Index of the run.
    pub run: usize,
    /// Its first moment, on the clock of the file (s).
    pub from_s: f64,
    /// Its last moment (s).
    pub to_s: f64,
}

/// Shares of the effort that the nominal torque leaves, over all joints concerned.
///
/// ```text
/// share_j = min |effort_j - c tau_j - friction - rotor - offset|^2 / |effort_j - mean|^2
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Evidence {
    /// Joint at which the reading mends most.
    pub joint: usize,
    /// Share left at that joint with the log as it stands; above 1 worse than no model.
    pub before: f64,
    /// Share left there with the reading.
    pub after: f64,
    /// Natural logarithm of the factor by which the reading shortens what is left, all joints.
    pub gain: f64,
}

/// What may be wrong with logs.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ObservationKind {
    /// The effort of the joints has the other sign.
    EffortSign,
    /// The position of the joints has the other sign, its velocity too.
    PositionSign,
    /// The velocity column of the joints has the other sign than their position.
    VelocitySign,
    /// Two joints have each other's position and effort.
    JointsExchanged,
    /// Two joints have each other's effort.
    EffortsExchanged,
    /// The effort of the joints is in another unit.
    EffortUnit {
        /// Logged effort per N m (or N).
        factor: f64,
    },
    /// The effort lacks the torque that gravity asks for.
    EffortWithoutGravity,
    /// Gravity points elsewhere than the robot's description says.
    GravityDirection {
        /// Acceleration of free fall that the efforts ask for, in the base frame (m/s²).
        gravity_in_base: Vector3<f64>,
        /// Angle to the direction of the description (rad).
        angle: f64,
    },
    /// Gravity is stronger or weaker than the robot's description says.
    GravityValue {
        /// Size that the efforts ask for (m/s²).
        value: f64,
    },
    /// The position of a joint is off by a quarter or half a turn.
    PositionOffset {
        /// Logged minus true position (rad).
        offset: f64,
    },
    /// Positions are degrees.
    Degrees,
    /// Effort and motion disagree about what a second is.
    TimeUnit {
        /// Logged time per second.
        factor: f64,
    },
    /// Efforts are of another time than the motion.
    EffortShifted {
        /// How much later the efforts are in the log (s).
        shift_s: f64,
    },
    /// Velocity columns are in another unit than the derivative of the positions.
    VelocityUnit {
        /// Logged velocity per derivative of the position.
        factor: f64,
    },
    /// A position that moved stands still while the arm goes on.
    StuckEncoder,
    /// All signals stand still while the clock runs on.
    Held,
    /// Single samples of a position are off.
    Spikes {
        /// How many.
        count: usize,
        /// The largest deviation (rad or m).
        height: f64,
    },
    /// A position jumps by full turns between two samples.
    TurnJump {
        /// Turns of the largest jump.
        turns: i32,
    },
    /// The effort is at its limit for much of the time.
    AtLimit {
        /// Share of the samples, 0 to 1.
        share: f64,
        /// The limit (N m or N).
        limit: f64,
    },
    /// Two runs hold the same samples, one of them later.
    Overlap {
        /// Time in the second run less that in the first (s).
        shift_s: f64,
        /// Length of what they share (s).
        length_s: f64,
    },
    /// Nothing of the nominal torque is in the efforts.
    AnotherRobot,
}
