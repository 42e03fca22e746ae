use std::ops::Range;

use logs::Prepared;

use crate::error::LearnerError;

/// Samples of the motion and torque of every joint, run after run.
///
/// All signals are row-major: sample by sample, one entry a joint, in the order of the robot.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct Samples {
    joints: usize,
    q: Vec<f64>,
    qd: Vec<f64>,
    qdd: Vec<f64>,
    tau: Vec<f64>,
    runs: Vec<RunSpan>,
}

/// The samples of a run.
#[derive(Debug, Clone, PartialEq)]
pub struct RunSpan {
    /// Name of the run.
    pub name: String,
    /// Indices of its samples.
    pub samples: Range<usize>,
    /// Samples per second (Hz).
    pub rate_hz: f64,
}

/// The state of the arm in one sample, one entry a joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SampleState<'a> {
    /// Position (rad or m).
    pub q: &'a [f64],
    /// Velocity (rad/s or m/s).
    pub qd: &'a [f64],
    /// Acceleration (rad/s² or m/s²).
    pub qdd: &'a [f64],
}

/// Consecutive samples of the motion and the torque of all joints, row-major: sample by
/// sample, one entry a joint.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SampleSlices<'a> {
    /// Position (rad or m).
    pub q: &'a [f64],
    /// Velocity (rad/s or m/s).
    pub qd: &'a [f64],
    /// Acceleration (rad/s² or m/s²).
    pub qdd: &'a [f64],
    /// Torque (N·m or N).
    pub tau: &'a [f64],
}

impl Samples {
    /// The samples of prepared runs.
    pub fn new(prepared: &Prepared) -> Self {
        let joints = prepared.runs.first().map_or(0, |run| run.joints.len());
        let mut samples = Self { joints, ..Self::default() };
        for run in &prepared.runs {
            let start = samples.len();
            for t in 0..run.time.len() {
                for joint in &run.joints {
                    samples.q.push(joint.q[t]);
                    samples.qd.push(joint.qd[t]);
                    samples.qdd.push(joint.qdd[t]);
                    samples.tau.push(joint.effort[t]);
                }
            }
            let span = start..samples.len();
            let run = RunSpan { name: run.name.clone(), samples: span, rate_hz: run.rate_hz };
            samples.runs.push(run);
        }
        samples
    }

    /// States without torques, `[q, qd, qdd]` row-major, as one run without a name or rate.
    pub fn of_states(joints: usize, [q, qd, qdd]: [Vec<f64>; 3]) -> Self {
        let tau = vec![0.0; q.len()];
        Self { joints, q, qd, qdd, tau, runs: Vec::new() }
    }

    /// The signals `[q, qd, qdd, tau]`, row-major, of samples without runs.
    pub(crate) fn of_signals(joints: usize, [q, qd, qdd, tau]: [Vec<f64>; 4]) -> Self {
        Self { joints, q, qd, qdd, tau, runs: Vec::new() }
    }

    /// Appends samples without runs.
    pub(crate) fn append(&mut self, more: &Self) {
        self.q.extend_from_slice(&more.q);
        self.qd.extend_from_slice(&more.qd);
        self.qdd.extend_from_slice(&more.qdd);
        self.tau.extend_from_slice(&more.tau);
    }

    /// Number of samples.
    pub fn len(&self) -> usize {
        self.q.len().checked_div(self.joints).unwrap_or(0)
    }

    /// Whether there is no sample.
    pub fn is_empty(&self) -> bool {
        self.len() == 0
    }

    /// Number of joints.
    pub fn joints(&self) -> usize {
        self.joints
    }

    /// The runs, one after the other.
    pub fn runs(&self) -> &[RunSpan] {
        &self.runs
    }

    /// The state in sample `index`.
    ///
    /// # Panics
    ///
    /// When there is no such sample.
    pub fn state(&self, index: usize) -> SampleState<'_> {
        let at = index * self.joints..(index + 1) * self.joints;
        SampleState { q: &self.q[at.clone()], qd: &self.qd[at.clone()], qdd: &self.qdd[at] }
    }

    /// All samples, one run after the other.
    pub fn stretch(&self) -> SampleSlices<'_> {
        SampleSlices { q: &self.q, qd: &self.qd, qdd: &self.qdd, tau: &self.tau }
    }

    /// The effort of every joint in sample `index` (N m or N).
    ///
    /// # Panics
    ///
    /// When there is no such sample.
    pub fn tau(&self, index: usize) -> &[f64] {
        &self.tau[index * self.joints..(index + 1) * self.joints]
    }

    /// At most `points` samples, evenly spread over all: sample `floor(i n / points)` of `n`
    /// for `i` from 0. The rate of every run falls accordingly.
    pub fn thin(&self, points: usize) -> Self {
        let n = self.len();
        if points >= n {
            return self.clone();
        }
        self.select((0..points).map(|i| i * n / points))
    }

    /// The samples `chosen`, in ascending order.
    pub(crate) fn select(&self, chosen: impl Iterator<Item = usize>) -> Self {
        let chosen: Vec<usize> = chosen.collect();
        let pick = |signal: &[f64]| -> Vec<f64> {
            let rows = chosen.iter().map(|&i| &signal[i * self.joints..(i + 1) * self.joints]);
            rows.flatten().copied().collect()
        };
        let runs = self.runs.iter().map(|run| {
            let first = chosen.partition_point(|&i| i < run.samples.start);
            let end = chosen.partition_point(|&i| i < run.samples.end);
            let share = (end - first) as f64 / run.samples.len().max(1) as f64;
            RunSpan { name: run.name.clone(), samples: first..end, rate_hz: run.rate_hz * share }
        });
        Self {
            joints: self.joints,
            q: pick(&self.q),
            qd: pick(&self.qd),
            qdd: pick(&self.qdd),
            tau: pick(&self.tau),
            runs: runs.collect(),
        }
    }

    /// Refuses samples with an entry that is not finite; `before` so many samples come before these, and count in what is
    /// refused.
    ///
    /// # Errors
    ///
    /// [`LearnerError::BadSample`].
    pub(crate) fn check_behind(&self, before: usize) -> Result<(), LearnerError> {
        let signals = [("q", &self.q), ("qd", &self.qd), ("qdd", &self.qdd), ("tau", &self.tau)];
        for (signal, values) in signals {
            if let Some(at) = values.iter().position(|v| !v.is_finite()) {
                let (row, joint) = (at / self.joints.max(1), at % self.joints.max(1));
                let sample = before + row;
                let value = values[at];
                return Err(LearnerError::BadSample { signal, sample, joint, value });
            }
        }
        Ok(())
    }
}
