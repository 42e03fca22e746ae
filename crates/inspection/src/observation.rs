use std::ops::Range;

use logs::Run;
use nalgebra::Vector3;

/// An error of logs as a whole, or of a stretch of them.
#[derive(Debug, Clone, PartialEq)]
pub struct Observation {
    /// The error.
    pub kind: ObservationKind,
    /// Other errors that explain the logs as well: nothing in these logs tells them apart.
    pub or: Vec<Rival>,
    /// Joints that it concerns, by index; all of the robot's where it concerns the whole arm.
    pub joints: Vec<usize>,
    /// The unit of each joint whose effort is in another one.
    pub units: Vec<JointUnit>,
    /// The zero of each run's effort, where they differ.
    pub zeros: Vec<RunZero>,
    /// Positions of locked joints that fit the efforts, where they differ from the description.
    pub locks: Vec<OtherLock>,
    /// Runs that it concerns, by index.
    pub runs: Vec<usize>,
    /// The seconds that it concerns, where it does not concern whole runs.
    pub stretches: Vec<RunStretch>,
    /// The part of the logs that cannot be used until the error is corrected.
    pub spoils: Spoils,
    /// How well the nominal torque fits before and after a correction, where this shows the error.
    pub evidence: Option<ReadingEvidence>,
}

impl Observation {
    /// An observation of joints in whole runs, without evidence.
    pub(crate) fn of_runs(
        kind: ObservationKind,
        joints: Vec<usize>,
        runs: Vec<usize>,
        spoils: Spoils,
    ) -> Self {
        let (or, units, zeros, locks, stretches) = Default::default();
        Self { kind, or, joints, units, zeros, locks, runs, stretches, spoils, evidence: None }
    }

    /// An observation of some seconds of a joint, which cannot be used.
    pub(crate) fn of_seconds(
        kind: ObservationKind,
        joint: usize,
        stretches: Vec<RunStretch>,
    ) -> Self {
        let runs = stretches.first().map(|s| s.run).into_iter().collect();
        let own = Self::of_runs(kind, vec![joint], runs, Spoils::Stretches);
        Self { stretches, ..own }
    }
}

/// The unit of a joint's effort.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct JointUnit {
    /// The joint, by index.
    pub joint: usize,
    /// Logged effort per N m (or N); `None` where the motion of the joint does not show it.
    pub factor: Option<f64>,
    /// Standard error of a factor that is the joint's own; `None` where all joints have it.
    pub standard_error: Option<f64>,
}

/// What the effort of a joint is in one run where its torque is zero.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct RunZero {
    /// The joint, by index.
    pub joint: usize,
    /// The run, by index.
    pub run: usize,
    /// Effort at no torque, beyond what the description says (N m or N).
    pub offset: f64,
}

/// A locked joint, and where it seems to stand.
#[derive(Debug, Clone, PartialEq)]
pub struct OtherLock {
    /// Name of the joint.
    pub joint: String,
    /// Where it is locked (rad).
    pub described: f64,
    /// The position that fits the efforts (rad).
    pub position: f64,
}

/// A reading that explains the logs as well as another one.
#[derive(Debug, Clone, PartialEq)]
pub struct Rival {
    /// The error.
    pub kind: ObservationKind,
    /// Joints that it concerns.
    pub joints: Vec<usize>,
}

/// The part of logs that cannot be used.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub enum Spoils {
    /// None of it.
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
pub struct RunStretch {
    /// Index of the run.
    pub run: usize,
    /// Its first moment, on the clock of the file (s).
    pub from_s: f64,
    /// Its last moment (s).
    pub to_s: f64,
}

impl RunStretch {
    /// The stretch of some rows of a run.
    pub(crate) fn of_rows(run: &Run, index: usize, rows: &Range<usize>) -> Self {
        let last = run.time.len().saturating_sub(1);
        let at = |k: usize| run.time.get(k.min(last)).copied().unwrap_or(0.0);
        Self { run: index, from_s: at(rows.start), to_s: at(rows.end.saturating_sub(1)) }
    }
}

/// Shares of the effort that the nominal torque leaves, over all joints concerned.
///
/// ```text
/// share_j = min |effort_j - c tau_j - friction - rotor - offset|^2 / |effort_j - mean|^2
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ReadingEvidence {
    /// Joint at which the correction improves the fit most.
    pub joint: usize,
    /// Share left at that joint with the log as it stands; above 1 worse than no model.
    pub before: f64,
    /// Share left there with the correction.
    pub after: f64,
    /// Natural logarithm of the factor by which the correction reduces the residual, over all joints.
    pub gain: f64,
}

/// A joint whose position is counted together with that of the joint before it, as where bars or belts drive it from there.
///
/// ```text
/// q_log = q + sign q_with,   and, where the drive works so as well,   tau_log_with = tau_with - sign tau
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct CountedTogether {
    /// The joint.
    pub joint: usize,
    /// The joint before it, about a parallel axis.
    pub with: usize,
    /// 1 where the positions are added, -1 where they are subtracted.
    pub sign: f64,
    /// Whether the effort of the joint before it is that of a drive which does not carry the other drive.
    pub is_driven: bool,
}

/// Errors that logs may have.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum ObservationKind {
    /// The effort of the joints has the other sign.
    EffortSign,
    /// The position of the joints has the other sign, its velocity too.
    PositionSign,
    /// The joints are counted the other way round than their axes are described: position and effort have the other sign.
    AxisSign,
    /// The velocity column of the joints has the other sign than their position.
    VelocitySign,
    /// Two joints have each other's position and effort.
    JointsExchanged,
    /// Two joints have each other's effort.
    EffortsExchanged,
    /// The effort of the joints is in another unit.
    EffortUnit {
        /// Logged effort per N m (or N); of several that differ, the middle one.
        factor: f64,
    },
    /// The effort of the joints is in another unit, as that of other joints is, and their motion does not show which.
    UnknownUnit,
    /// The position loops of the joints follow the velocity of their goals: `kp (goal - q) + kd (d goal/dt - qd)`.
    GoalVelocity,
    /// The effort lacks the torque that holds the arm against gravity.
    EffortWithoutGravity,
    /// The effort of the joints at no torque differs from run to run.
    ZerosOfRuns,
    /// Gravity has another direction than in the robot's description.
    GravityDirection {
        /// Acceleration of free fall that fits the efforts, in the base frame (m/s²).
        gravity_in_base: Vector3<f64>,
        /// Angle to the direction of the description (rad).
        angle: f64,
    },
    /// Gravity has another size than in the robot's description.
    GravityValue {
        /// Size that fits the efforts (m/s²).
        value: f64,
    },
    /// The position of a joint is off by a quarter or half a turn.
    PositionOffset {
        /// Logged minus true position (rad).
        offset: f64,
    },
    /// Positions are degrees.
    Degrees,
    /// Positions that were taken for degrees may be normalised: a joint is beyond its limits, and none is beyond 100.
    NormalisedPositions {
        /// Share of the samples in which the joint that is farthest out is beyond its limits, 0 to 1.
        share: f64,
    },
    /// The position of a joint is counted from further inward than its parent link: `q_log = q + sign q_parent`.
    CountedTogether(CountedTogether),
    /// Effort and motion disagree about the unit of time.
    TimeUnit {
        /// Logged time per second.
        factor: f64,
    },
    /// Efforts are shifted in time against the motion.
    EffortShifted {
        /// How much later the efforts are in the log (s).
        shift_s: f64,
    },
    /// The clock of a run goes otherwise than that of the others.
    OtherClock {
        /// Logged time of the run per second.
        factor: f64,
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
    /// So many single samples of a position are off that none can be told from its neighbours.
    FrequentSpikes {
        /// Share of the samples of the run, 0 to 1.
        share: f64,
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
    /// Joints that the robot has locked stand elsewhere.
    LockedElsewhere,
    /// Links of the description have an inertia in another unit.
    InertiaUnit,
    /// The efforts contradict the nominal torque.
    AnotherRobot,
}
