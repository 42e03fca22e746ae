use logs::Run;
use nalgebra::DMatrix;
use robot::Robot;

use crate::moving::body_torque;

/// Rate to which what an oracle looks at is thinned (Hz): motions have a band of 10 Hz.
const RATE_HZ: f64 = 50.0;

/// A noise-free run as an oracle sees it: what moves and what the efforts leave beyond the bodies.
///
/// Everything is a mean over the samples of the log that one of its own spans.
#[derive(Debug, Clone)]
pub(crate) struct SeenRun {
    /// Time between two samples (s).
    pub step_s: f64,
    /// Samples of the log in one of its own.
    pub thinned: usize,
    /// Position, velocity, acceleration (rad or m, per s, per s2): a row a sample, a column a joint.
    pub q: DMatrix<f64>,
    /// Velocity.
    pub qd: DMatrix<f64>,
    /// Acceleration.
    pub qdd: DMatrix<f64>,
    /// Effort (N m or N).
    pub effort: DMatrix<f64>,
    /// Effort less the torque of the bodies along the motion (N m or N).
    pub beyond: DMatrix<f64>,
}

impl SeenRun {
    /// A run whose position, velocity and effort have no noise.
    pub fn new(robot: &Robot, run: &Run) -> Self {
        let samples = (1.0 / (step_s(run) * RATE_HZ)).round() as usize;
        Self::thin(robot, run, samples.max(1))
    }

    /// The same, of so many samples of the log a mean; a velocity that is not logged is that of the positions.
    pub fn thin(robot: &Robot, run: &Run, thinned: usize) -> Self {
        let (rows, joints) = (run.time.len(), robot.joint_count());
        let step_s = step_s(run);
        let column = |values: &dyn Fn(usize, usize) -> f64| DMatrix::from_fn(rows, joints, values);
        let q = column(&|i, j| run.joints[j].position[i]);
        let rate = slopes(&q, step_s);
        let qd = column(&|i, j| run.joints[j].velocity.as_ref().map_or(rate[(i, j)], |v| v[i]));
        let effort = column(&|i, j| run.joints[j].effort[i]);
        let qdd = slopes(&qd, step_s);
        let mut beyond = effort.clone();
        let mut tau = vec![0.0; joints];
        for i in 0..rows {
            let of = |m: &DMatrix<f64>| m.row(i).iter().copied().collect::<Vec<f64>>();
            body_torque(robot, &of(&q), &of(&qd), &of(&qdd), &mut tau);
            tau.iter().enumerate().for_each(|(j, tau)| beyond[(i, j)] -= tau);
        }
        let [q, qd, qdd, effort, beyond] =
            [q, qd, qdd, effort, beyond].map(|signal| means(&signal, thinned));
        Self { step_s: step_s * thinned as f64, thinned, q, qd, qdd, effort, beyond }
    }

    /// Number of samples.
    pub fn rows(&self) -> usize {
        self.q.nrows()
    }
}

/// Mean time between two samples of a log (s).
fn step_s(run: &Run) -> f64 {
    let length = run.time.last().unwrap_or(&0.0) - run.time.first().unwrap_or(&0.0);
    if run.time.len() > 1 { length / (run.time.len() - 1) as f64 } else { 1.0 }
}

/// Central differences of signals over time.
pub(crate) fn slopes(signal: &DMatrix<f64>, step_s: f64) -> DMatrix<f64> {
    let last = signal.nrows().saturating_sub(1);
    DMatrix::from_fn(signal.nrows(), signal.ncols(), |i, j| {
        let (before, after) = (i.saturating_sub(1), (i + 1).min(last));
        (signal[(after, j)] - signal[(before, j)]) / ((after - before).max(1) as f64 * step_s)
    })
}

/// Means of `every` rows in turn; what is left at the end is left out.
pub(crate) fn means(signal: &DMatrix<f64>, every: usize) -> DMatrix<f64> {
    let rows = signal.nrows() / every;
    DMatrix::from_fn(rows, signal.ncols(), |i, j| {
        signal.column(j).rows(i * every, every).sum() / every as f64
    })
}
