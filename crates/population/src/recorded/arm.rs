use std::path::{Path, PathBuf};

use logs::{ReadOptions, Run, read_run};
use robot::Robot;

use crate::corner::{EffortClass, MotionClass};
use crate::error::PopulationError;
use crate::recorded::cut::{Part, part, thin, until};
use crate::robot_files::RobotFiles;

/// Longest part of a log that is used (s).
const LONGEST_S: f64 = 60.0;

/// Where the robot of recorded logs is described.
#[derive(Debug, Clone, Copy)]
enum Described {
    /// In files beside the logs.
    BesideTheLogs,
    /// In this project: Barrett's arm.
    Here,
}

/// A recorded log.
struct Log {
    name: &'static str,
    motion: MotionClass,
    /// Logs of one arm with the same number are of one motion.
    path: u8,
}

/// Which part of an arm's logs is held out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum HeldOut {
    /// One log of several.
    Log,
    /// The last quarter of the only log.
    LastQuarter,
    /// The same quarter of every log.
    Quarter,
}

/// A recorded arm and its logs.
struct Entry {
    name: &'static str,
    folder: &'static str,
    /// Where its robot is described.
    robot: Described,
    effort: EffortClass,
    held_out: HeldOut,
    logs: &'static [Log],
}

const fn log(name: &'static str, motion: MotionClass, path: u8) -> Log {
    Log { name, motion, path }
}

const fn entry(
    name: &'static str,
    folder: &'static str,
    robot: Described,
    effort: EffortClass,
    held_out: HeldOut,
    logs: &'static [Log],
) -> Entry {
    Entry { name, folder, robot, effort, held_out, logs }
}

/// The first two logs of the LWR4 are of one motion, and so are the first two of the Gen3.
static ARMS: [Entry; 7] = [
    entry(
        "lwr4",
        "kuka_lwr4",
        Described::BesideTheLogs,
        EffortClass::JointTorque,
        HeldOut::Log,
        &[
            log("measurements_1", MotionClass::Sinusoids, 0),
            log("measurements_2", MotionClass::Sinusoids, 0),
            log("measurements_3", MotionClass::Sinusoids, 1),
        ],
    ),
    entry(
        "gen3",
        "kinova_gen3",
        Described::BesideTheLogs,
        EffortClass::Current,
        HeldOut::Log,
        &[
            log("Trajectory1", MotionClass::PointToPoint, 0),
            log("RunTrajectory1", MotionClass::PointToPoint, 0),
            log("RecordTrajectory_quadratic", MotionClass::PointToPoint, 1),
            log("opti_traj_testing1", MotionClass::Sinusoids, 2),
            log("opti_traj_testing2", MotionClass::Sinusoids, 3),
        ],
    ),
    entry(
        "tx40",
        "staubli_tx40",
        Described::BesideTheLogs,
        EffortClass::Current,
        HeldOut::LastQuarter,
        &[log("excitation", MotionClass::Sinusoids, 0)],
    ),
    entry(
        "barrett_wam",
        "barrett_wam",
        Described::Here,
        EffortClass::Command,
        HeldOut::LastQuarter,
        &[log("shoulder_elbow_sweep", MotionClass::Sweep, 0)],
    ),
    entry(
        "ur10e",
        "ur10e_joint_by_joint",
        Described::BesideTheLogs,
        EffortClass::Current,
        HeldOut::Quarter,
        &[
            log("joint_1", MotionClass::JointByJoint, 0),
            log("joint_2", MotionClass::JointByJoint, 1),
            log("joint_3", MotionClass::JointByJoint, 2),
            log("joint_4", MotionClass::JointByJoint, 3),
            log("joint_5", MotionClass::JointByJoint, 4),
            log("joint_6", MotionClass::JointByJoint, 5),
        ],
    ),
    entry(
        "dfki_pendulum",
        "dfki_pendulum",
        Described::BesideTheLogs,
        EffortClass::Current,
        HeldOut::Log,
        &[
            log("ddp", MotionClass::SwingUp, 0),
            log("direct_collocation", MotionClass::SwingUp, 1),
            log("pd", MotionClass::SwingUp, 2),
            log("gravity_compensation", MotionClass::LedByHand, 3),
        ],
    ),
    entry(
        "panda",
        "panda",
        Described::BesideTheLogs,
        EffortClass::JointTorque,
        HeldOut::LastQuarter,
        &[log("whole", MotionClass::Sinusoids, 0)],
    ),
];

/// A real arm with recorded logs.
///
/// The first 60 s of each log are used, thinned to the rate nearest to 250 Hz. Dropouts, lags and outliers are
/// kept.
#[derive(Clone)]
pub struct RecordedArm {
    entry: &'static Entry,
    folder: PathBuf,
    robot: RobotFiles,
}

/// A log of an arm as trials use it.
pub(super) struct Used {
    pub(super) motion: MotionClass,
    pub(super) path: u8,
    pub(super) run: Run,
}

/// The arms whose logs and robot exist below the folder `data`.
pub fn available(data: &Path) -> Vec<RecordedArm> {
    ARMS.iter().filter_map(|entry| RecordedArm::find(data, entry)).collect()
}

impl RecordedArm {
    fn find(data: &Path, entry: &'static Entry) -> Option<Self> {
        let folder = data.join(entry.folder);
        let robot = match entry.robot {
            Described::BesideTheLogs => RobotFiles::read(&folder)?,
            Described::Here => crate::arms::wam::files(),
        };
        let arm = Self { entry, folder, robot };
        arm.logs().iter().all(|log| log.is_file()).then_some(arm)
    }

    /// Its name in tables.
    pub fn name(&self) -> &'static str {
        self.entry.name
    }

    /// Its nominal model.
    pub fn robot(&self) -> &RobotFiles {
        &self.robot
    }

    /// Files of its logs.
    pub fn logs(&self) -> Vec<PathBuf> {
        let path = |log: &Log| self.folder.join(format!("{}.parquet", log.name));
        self.entry.logs.iter().map(path).collect()
    }

    /// Source of the effort in its logs.
    pub fn effort(&self) -> EffortClass {
        self.entry.effort
    }

    pub(super) fn held_out_recordings(&self) -> HeldOut {
        self.entry.held_out
    }

    /// Number of ways to hold out a part of its logs.
    pub(super) fn splits(&self) -> usize {
        match self.entry.held_out {
            HeldOut::Log => self.entry.logs.len(),
            HeldOut::LastQuarter => 1,
            HeldOut::Quarter => Part::QUARTERS,
        }
    }

    /// Its logs, cut and thinned, and the smallest step of each joint's position in the full logs.
    pub(super) fn read(&self, robot: &Robot) -> Result<(Vec<Used>, Vec<f64>), PopulationError> {
        let mut steps = vec![f64::INFINITY; robot.joint_count()];
        let mut used = Vec::new();
        for (log, path) in self.entry.logs.iter().zip(self.logs()) {
            let whole = read_run(&path, robot, &ReadOptions::default())?;
            for (step, joint) in steps.iter_mut().zip(&whole.joints) {
                *step = step.min(smallest_step(&joint.position));
            }
            let rows = until(&whole, LONGEST_S);
            let run = thin(&part(&whole, log.name, rows));
            used.push(Used { motion: log.motion, path: log.path, run });
        }
        Ok((used, steps))
    }
}

/// Differences of positions below this are rounding (rad or m).
const ROUNDING: f64 = 1e-9;

/// Smallest difference of neighbouring positions above rounding; infinite where nothing moves.
fn smallest_step(position: &[f64]) -> f64 {
    let steps = position.windows(2).map(|q| (q[1] - q[0]).abs());
    steps.filter(|step| *step > ROUNDING).fold(f64::INFINITY, f64::min)
}
