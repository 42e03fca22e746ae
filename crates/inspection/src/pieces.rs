use std::ops::Range;

use logs::Run;

use crate::thresholds::InspectionThresholds;

/// A stretch of a run on an even clock, without the rows that are left out.
#[derive(Debug, Clone)]
pub(crate) struct RunPiece {
    /// Index of the run.
    pub run: usize,
    /// Time between two samples, on the clock of the file (s).
    pub step_s: f64,
    /// Signals of each joint.
    pub joints: Vec<JointSignals>,
}

/// Signals of a joint that are looked at.
#[derive(Debug, Clone, Default)]
pub(crate) struct JointSignals {
    pub position: Vec<f64>,
    pub effort: Vec<f64>,
    pub velocity: Option<Vec<f64>>,
    /// Part of the effort that follows the goal, where efforts are computed from goals.
    pub goal_effort: Option<Vec<f64>>,
}

impl RunPiece {
    /// Number of samples.
    pub fn len(&self) -> usize {
        self.joints.first().map_or(0, |joint| joint.position.len())
    }
}

/// The pieces of a run between its gaps and the rows that are left out.
///
/// A clock with jitter or lost rows is made even by linear interpolation.
pub(crate) fn pieces(
    (index, run): (usize, &Run),
    left_out: &[Range<usize>],
    t: &InspectionThresholds,
) -> Vec<RunPiece> {
    let usual = usual_step(&run.time);
    if usual <= 0.0 {
        return Vec::new();
    }
    let out = |k: usize| left_out.iter().any(|range| range.contains(&k));
    let mut all = Vec::new();
    let mut start = 0;
    for k in 0..=run.time.len() {
        let gap =
            k > 0 && k < run.time.len() && run.time[k] - run.time[k - 1] > t.longest_step * usual;
        if k == run.time.len() || gap || out(k) {
            if k > start + 1 {
                all.push(piece((index, run), start..k, usual, t.even_step));
            }
            start = if k < run.time.len() && out(k) { k + 1 } else { k };
        }
    }
    all
}

/// The middle step of a clock (s); 0 for fewer than two rows.
pub(crate) fn usual_step(time: &[f64]) -> f64 {
    let mut steps: Vec<f64> = time.windows(2).map(|t| t[1] - t[0]).collect();
    let middle = steps.len() / 2;
    if steps.is_empty() {
        return 0.0;
    }
    *steps.select_nth_unstable_by(middle, f64::total_cmp).1
}

fn piece((index, run): (usize, &Run), rows: Range<usize>, usual: f64, even_step: f64) -> RunPiece {
    let time = &run.time[rows.clone()];
    let even = time.windows(2).all(|t| (t[1] - t[0] - usual).abs() <= even_step * usual);
    let length = time.last().unwrap_or(&0.0) - time.first().unwrap_or(&0.0);
    let step_s = if even { length / (time.len() - 1).max(1) as f64 } else { usual };
    let read = |x: &[f64]| {
        let own = &x[rows.clone()];
        if even { own.to_vec() } else { resample(time, own, step_s) }
    };
    let joint = |joint: &logs::Channels| JointSignals {
        position: read(&joint.position),
        effort: read(&joint.effort),
        velocity: joint.velocity.as_deref().map(read),
        goal_effort: joint.goal_effort.as_ref().map(|goal| read(&goal.values[goal.lead..])),
    };
    RunPiece { run: index, step_s, joints: run.joints.iter().map(joint).collect() }
}

fn resample(time: &[f64], x: &[f64], step: f64) -> Vec<f64> {
    let (first, last) = (time[0], time[time.len() - 1]);
    let count = ((last - first) / step + 1e-6).floor() as usize + 1;
    let mut k = 0;
    let at = |i: usize| {
        let now = first + i as f64 * step;
        while k + 2 < time.len() && time[k + 1] <= now {
            k += 1;
        }
        let share = ((now - time[k]) / (time[k + 1] - time[k])).clamp(0.0, 1.0);
        x[k] + share * (x[k + 1] - x[k])
    };
    (0..count).map(at).collect()
}
