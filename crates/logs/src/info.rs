use robot::{Joint, Robot};

use crate::{
    checks::{degrees, saturation::saturation},
    runs::{
        repair::Repair,
        run::{Channel, Channels, Run, median, range},
    },
    signals::{
        agreement::Agreement,
        choice,
        clock::Fill,
        sources::ComparisonBands,
        uniform::{moving, uniform_pieces},
    },
};

/// Description of a run as it was read, before it is prepared.
#[derive(Debug, Clone, PartialEq)]
pub struct LogInfo {
    /// Name of the run.
    pub name: String,
    /// Number of samples.
    pub samples: usize,
    /// Whether the file ended in the middle of a row. That row is left out.
    pub is_torn: bool,
    /// Changes made while the run was read.
    pub mended: Vec<Repair>,
    /// Time from the first row to the last (s).
    pub duration_s: f64,
    /// One over the median step of time (Hz).
    pub rate_hz: f64,
    /// Standard deviation of the time steps, without gaps (s).
    pub jitter_std_s: f64,
    /// Largest difference of a time step from the median step, without gaps (s).
    pub jitter_max_s: f64,
    /// Gaps: time steps of more than one and a half times the median step.
    pub gaps: Vec<TimeGap>,
    /// Each joint, in the order of the robot.
    pub joints: Vec<JointInfo>,
    /// Joints of the log that the robot does not have.
    pub unknown_joints: Vec<String>,
    /// Columns that belong to none of the robot's signals.
    pub extra: Vec<String>,
}

/// A time step that is too long.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct TimeGap {
    /// Row before the gap, counted from 1.
    pub row: usize,
    /// Time of that row, as in the file (s).
    pub start_s: f64,
    /// Length of the gap (s).
    pub length_s: f64,
}

/// Description of one joint of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct JointInfo {
    /// Name of the joint.
    pub name: String,
    /// Channels that the log does not have.
    pub missing: Vec<Channel>,
    /// Lowest and highest position (rad or m).
    pub position: (f64, f64),
    /// Position limits in the robot's description (rad or m).
    pub limits: Option<(f64, f64)>,
    /// Share of the samples outside those limits, 0 to 1.
    pub share_outside_limits: f64,
    /// Whether the position ranges over 0.05 rad or 5 mm.
    pub moves: bool,
    /// Smallest step between positions that occurs repeatedly (rad or m); `None`
    /// where positions are not quantised.
    pub quantisation_step: Option<f64>,
    /// Lowest and highest effort (N·m or N).
    pub effort: (f64, f64),
    /// Effort limit in the robot's description (N·m or N).
    pub effort_limit: Option<f64>,
    /// Share of the samples at the lowest or the highest effort, without one of each, 0 to 1.
    pub effort_saturation: f64,
    /// Whether the positions may be degrees. Reading refuses a log in which they must be degrees.
    pub suspected_degrees: bool,
    /// The velocity column compared with the derivative of the position, both low-passed at
    /// the cut-off of this run; `None` without the column or without motion.
    pub velocity_agreement: Option<Agreement>,
}

/// Describes a run as it was read, before it is prepared.
///
/// Joints are taken in the order of the robot, as [`crate::read_run`] returns them.
pub fn log_info(run: &Run, robot: &Robot) -> LogInfo {
    let steps: Vec<f64> = run.time.windows(2).map(|t| t[1] - t[0]).collect();
    let usual = median(&steps);
    let is_gap = |step: f64| step > 1.5 * usual;
    let regular: Vec<f64> = steps.iter().copied().filter(|&s| !is_gap(s)).collect();
    let (jitter_std_s, jitter_max_s) = jitter(&regular, usual);
    let gap = |(row, &step): (usize, &f64)| {
        is_gap(step).then(|| TimeGap { row: row + 1, start_s: run.time[row], length_s: step })
    };
    let agreements = agreements(run);
    let joints = robot.links().iter().zip(&run.joints).zip(agreements);
    LogInfo {
        name: run.name.clone(),
        samples: run.time.len(),
        is_torn: run.is_torn,
        mended: run.mended.clone(),
        duration_s: steps.iter().sum(),
        rate_hz: 1.0 / usual,
        jitter_std_s,
        jitter_max_s,
        gaps: steps.iter().enumerate().filter_map(gap).collect(),
        joints: joints.map(|((link, c), a)| joint_info(&link.joint, c, a)).collect(),
        unknown_joints: run.unknown_joints(),
        extra: run.extra.keys().cloned().collect(),
    }
}

fn jitter(steps: &[f64], usual: f64) -> (f64, f64) {
    let count = steps.len().max(1) as f64;
    let mean = steps.iter().sum::<f64>() / count;
    let variance = steps.iter().map(|s| (s - mean).powi(2)).sum::<f64>() / count;
    (variance.sqrt(), steps.iter().map(|s| (s - usual).abs()).fold(0.0, f64::max))
}

fn joint_info(joint: &Joint, channels: &Channels, agreement: Option<Agreement>) -> JointInfo {
    let position = range(&channels.position);
    let limits = joint.limits.position;
    let least = if joint.kind.is_rotation() { 0.05 } else { 0.005 };
    JointInfo {
        name: channels.name.clone(),
        missing: Channel::ALL.into_iter().filter(|&c| channels.get(c).is_none()).collect(),
        position,
        limits,
        share_outside_limits: limits
            .map_or(0.0, |(lower, upper)| share(&channels.position, |q| q < lower || q > upper)),
        moves: position.1 - position.0 >= least,
        quantisation_step: quantisation_step(&channels.position),
        effort: range(&channels.effort),
        effort_limit: joint.limits.effort,
        effort_saturation: saturation(&channels.effort),
        suspected_degrees: degrees::beyond_limits(joint, &channels.position).is_some(),
        velocity_agreement: agreement,
    }
}

fn share(x: &[f64], test: impl Fn(f64) -> bool) -> f64 {
    x.iter().filter(|&&v| test(v)).count() as f64 / x.len().max(1) as f64
}

/// The smallest difference between neighbouring positions that at least one difference in a
/// hundred has; `None` where more than half of the differences occur only once.
fn quantisation_step(position: &[f64]) -> Option<f64> {
    let (low, high) = range(position);
    let rounding = 8.0 * f64::EPSILON * low.abs().max(high.abs());
    let mut differences: Vec<f64> =
        position.windows(2).map(|q| (q[1] - q[0]).abs()).filter(|&d| d > rounding).collect();
    differences.sort_unstable_by(f64::total_cmp);
    let groups: Vec<&[f64]> = differences.chunk_by(|a, b| b - a <= rounding).collect();
    if groups.len() < 2 && differences.len() < 10 || 2 * groups.len() > differences.len() {
        return None;
    }
    let often = (differences.len() / 100).max(3);
    groups.into_iter().find(|g| g.len() >= often).map(|g| g[g.len() / 2])
}

/// Agreement of each joint's velocity column, over the longest piece of the run.
fn agreements(run: &Run) -> Vec<Option<Agreement>> {
    let none = || vec![None; run.joints.len()];
    let pieces = uniform_pieces(run, 0, Fill::SAMPLES);
    let longest = pieces.into_iter().max_by(|a, b| a.duration_s().total_cmp(&b.duration_s()));
    let Some(piece) = longest else { return none() };
    let pieces = [piece];
    let moves = moving(&pieces);
    let Ok(choice) = choice::choose(std::slice::from_ref(run), &pieces, None) else {
        return none();
    };
    let (cutoff_hz, motion_hz) = (choice.cutoff.cutoff_hz, choice.cutoff.motion_hz);
    let comparison = ComparisonBands { cutoff_hz, motion_hz };
    let of = |joint: usize| match moves[0][joint] {
        true => comparison.velocity_agreement(&pieces[0], joint),
        false => None,
    };
    (0..run.joints.len()).map(of).collect()
}
