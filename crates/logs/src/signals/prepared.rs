use std::ops::Range;

use crate::{
    runs::run::{GoalEffort, Run},
    signals::{cutoff::MULTIPLE, noise::JointNoise, uniform::MOVING_SHARE, warning::LogWarning},
};

/// A log ready for identification.
#[derive(Debug, Clone, PartialEq)]
pub struct Prepared {
    /// The runs. A run that was split at long gaps gives several, named `... part 1` and so on.
    pub runs: Vec<PreparedRun>,
    /// Cut-off of the low-pass (Hz), the same for all runs and joints.
    pub cutoff_hz: f64,
    /// The reason for this cut-off, in a sentence.
    pub cutoff_reason: String,
    /// Frequency below which 99 % of the motion lies (Hz).
    pub motion_hz: f64,
    /// Noise of each joint's channels, the mean over the runs in which the joint moves.
    pub noise: Vec<JointNoise>,
    /// Problems of the log that the reader should know.
    pub warnings: Vec<LogWarning>,
}

/// One run on a uniform clock, without its ends.
#[derive(Debug, Clone, PartialEq)]
pub struct PreparedRun {
    /// Name of the run.
    pub name: String,
    /// Sampling rate (Hz).
    pub rate_hz: f64,
    /// Time of each sample, on the clock of the file (s).
    pub time: Vec<f64>,
    /// Start of the session that the run belongs to, on the clock of the file (s). As far as the logs show, the arm
    /// stood still for at least an hour before a session.
    pub session_start_s: f64,
    /// Signals of each joint, in the order of the robot.
    pub joints: Vec<PreparedJoint>,
}

/// Signals of one joint, one value per entry of `time`.
#[derive(Debug, Clone, PartialEq)]
pub struct PreparedJoint {
    /// Position, low-passed (rad or m).
    pub q: Vec<f64>,
    /// Velocity, low-passed (rad/s or m/s).
    pub qd: Vec<f64>,
    /// Acceleration, low-passed (rad/s² or m/s²).
    pub qdd: Vec<f64>,
    /// Motion low-passed at four times the cut-off.
    pub wide: Wide,
    /// Effort on the same clock, not low-passed (N·m or N).
    pub effort: Vec<f64>,
    /// Motion of the link, where every run has a second encoder.
    pub link: Option<PreparedLink>,
    /// Part of the effort that follows the goal, where efforts are computed from goals; not low-passed.
    pub goal_effort: Option<GoalEffort>,
}

/// Motion low-passed at four times the cut-off of the other signals. A model computes effort from this motion, and that
/// effort then passes the same low-pass as the measured effort. The sign of the velocity is right up to the moments at
/// which the motion starts and stops.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Wide {
    /// Position (rad or m).
    pub q: Vec<f64>,
    /// Velocity (rad/s or m/s).
    pub qd: Vec<f64>,
    /// Acceleration (rad/s² or m/s²).
    pub qdd: Vec<f64>,
}

/// Signals of a second encoder at the link of a joint.
#[derive(Debug, Clone, PartialEq)]
pub struct PreparedLink {
    /// Position of the link, low-passed (rad or m).
    pub q: Vec<f64>,
    /// Velocity of the link, low-passed (rad/s or m/s).
    pub qd: Vec<f64>,
    /// Acceleration of the link, low-passed (rad/s² or m/s²).
    pub qdd: Vec<f64>,
    /// Position of the first encoder minus that of the link, not low-passed (rad or m).
    pub twist: Vec<f64>,
}

/// Share of noise in a joint's acceleration above which a warning is given.
const NOISE_TO_WARN_OF: f64 = 0.1;

impl Prepared {
    /// Runs with exact signals. Their noise is unknown; their motion is taken to lie below a fifth of the cut-off.
    pub fn exact(runs: Vec<PreparedRun>, cutoff_hz: f64) -> Self {
        let joints = runs.first().map_or(0, |run| run.joints.len());
        Self {
            runs,
            cutoff_hz,
            cutoff_reason: String::new(),
            motion_hz: cutoff_hz / MULTIPLE,
            noise: vec![JointNoise::UNKNOWN; joints],
            warnings: Vec::new(),
        }
    }

    /// Replaces the runs by others that were prepared in the same way, without warnings.
    pub fn with_runs(&self, runs: Vec<PreparedRun>) -> Self {
        Self {
            runs,
            cutoff_hz: self.cutoff_hz,
            cutoff_reason: self.cutoff_reason.clone(),
            motion_hz: self.motion_hz,
            noise: self.noise.clone(),
            warnings: Vec::new(),
        }
    }

    /// Frequency below which 99 % of the motion lies (Hz).
    pub fn motion_hz(&self) -> f64 {
        self.motion_hz
    }

    /// Ratio of the noise of joint `j`'s acceleration to its acceleration, both RMS; `None` without
    /// acceleration.
    pub fn noise_share(&self, j: usize) -> Option<f64> {
        let squares = self.runs.iter().flat_map(|run| &run.joints[j].qdd).map(|a| a * a);
        let (count, sum) = squares.fold((0.0, 0.0), |(n, sum), a| (n + 1.0, sum + a));
        let rms = f64::sqrt(sum / f64::max(count, 1.0));
        let noise = self.noise.get(j)?.acceleration_rms(self.cutoff_hz);
        (rms > 0.0).then_some(noise / rms)
    }

    /// Adds a warning for each moving joint with too much noise in its acceleration.
    pub(crate) fn with_noise_warnings(mut self, first: &Run) -> Self {
        let largest = (0..first.joints.len()).map(|j| self.way(j)).fold(0.0, f64::max);
        for (j, joint) in first.joints.iter().enumerate() {
            let moves = self.way(j) >= MOVING_SHARE * largest;
            if let Some(share) = self.noise_share(j).filter(|s| moves && *s > NOISE_TO_WARN_OF) {
                let (joint, cutoff_hz) = (joint.name.clone(), self.cutoff_hz);
                self.warnings.push(LogWarning::NoisyAcceleration { joint, share, cutoff_hz });
            }
        }
        self
    }

    /// Distance between the lowest and the highest position of joint `j` (rad or m).
    fn way(&self, j: usize) -> f64 {
        let (low, high) = self.span(j);
        (high - low).max(0.0)
    }

    /// Lowest and highest position of joint `j` over all runs (rad or m).
    pub fn span(&self, j: usize) -> (f64, f64) {
        let q = self.runs.iter().flat_map(|run| &run.joints[j].q);
        q.fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), &q| (l.min(q), h.max(q)))
    }
}

impl PreparedJoint {
    /// A joint with exact motion and without a second encoder. No low-pass is applied.
    pub fn exact([q, qd, qdd]: [Vec<f64>; 3], effort: Vec<f64>) -> Self {
        let wide = Wide { q: q.clone(), qd: qd.clone(), qdd: qdd.clone() };
        Self { q, qd, qdd, wide, effort, link: None, goal_effort: None }
    }
}

impl PreparedRun {
    /// The given range of samples of the run. A range beyond the end of the run is cut there.
    pub fn part(&self, samples: Range<usize>) -> Self {
        let end = samples.end.min(self.time.len());
        let samples = samples.start.min(end)..end;
        let part = |x: &[f64]| x[samples.clone()].to_vec();
        let joint = |j: &PreparedJoint| PreparedJoint {
            q: part(&j.q),
            qd: part(&j.qd),
            qdd: part(&j.qdd),
            wide: Wide { q: part(&j.wide.q), qd: part(&j.wide.qd), qdd: part(&j.wide.qdd) },
            effort: part(&j.effort),
            link: j.link.as_ref().map(|link| PreparedLink {
                q: part(&link.q),
                qd: part(&link.qd),
                qdd: part(&link.qdd),
                twist: part(&link.twist),
            }),
            goal_effort: j.goal_effort.as_ref().map(|goal| {
                let samples = samples.start..samples.end + goal.lead;
                goal.map(|x| x[samples].to_vec())
            }),
        };
        Self {
            name: self.name.clone(),
            rate_hz: self.rate_hz,
            time: part(&self.time),
            session_start_s: self.session_start_s,
            joints: self.joints.iter().map(joint).collect(),
        }
    }
}
