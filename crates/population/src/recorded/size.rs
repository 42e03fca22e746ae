use logs::Run;
use robot::{JointKind, Robot};

use crate::recorded::law::dry;
use crate::recorded::signals::{acceleration, average, half, rms, velocity};
use crate::sheet::Strength;

/// Least range of a joint that moves (rad, m).
const MOVES: [f64; 2] = [0.1, 0.01];

/// Least noise of an effort, as a share of its RMS, since a smoothed log shows none.
const LEAST_NOISE: f64 = 1e-3;

/// Residual share below which a column counts as dependent on those before it.
const DEPENDENT: f64 = 1e-8;

/// The everyday column of a joint that equals the cause, and so cannot explain it instead.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Own {
    /// None of them.
    Nothing,
    /// A constant.
    Constant,
    /// The velocity.
    Velocity,
    /// The direction of motion.
    Direction,
}

/// The logs to which a cause is added, without the cause.
pub(super) struct Measured<'a> {
    /// The logs.
    pub(super) runs: &'a [Run],
    /// Joints that move in them.
    pub(super) moving: Vec<usize>,
}

/// Torque that a cause adds to every joint, run by run.
pub(super) type Added = Vec<Vec<Vec<f64>>>;

impl<'a> Measured<'a> {
    /// The logs of a robot.
    pub(super) fn new(robot: &Robot, runs: &'a [Run]) -> Self {
        let mut measured = Self { runs, moving: Vec::new() };
        let moves = |&joint: &usize| {
            let (low, high) = measured.range(joint);
            let translation = robot.links()[joint].joint.kind == JointKind::Prismatic;
            high - low > MOVES[usize::from(translation)]
        };
        let moving = (0..robot.joint_count()).filter(moves).collect();
        measured.moving = moving;
        measured
    }

    /// Lowest and highest position of a joint.
    pub(super) fn range(&self, joint: usize) -> (f64, f64) {
        let positions = || self.runs.iter().flat_map(|run| &run.joints[joint].position);
        let low = positions().fold(f64::INFINITY, |a, b| a.min(*b));
        (low, positions().fold(f64::NEG_INFINITY, |a, b| a.max(*b)))
    }

    /// RMS of the velocity of a joint.
    pub(super) fn speed_rms(&self, joint: usize) -> f64 {
        let speeds = |run: &Run| velocity(&run.time, &run.joints[joint].position);
        rms(self.runs.iter().flat_map(speeds).collect::<Vec<_>>().iter())
    }

    /// RMS of the effort of a joint.
    pub(super) fn effort_rms(&self, joint: usize) -> f64 {
        rms(self.runs.iter().flat_map(|run| &run.joints[joint].effort))
    }

    /// Largest ratio of added RMS to effort RMS over the joints that move.
    pub(super) fn share(&self, added: &Added) -> f64 {
        let share = |&joint: &usize| {
            let added = rms(added.iter().flat_map(|run| &run[joint]));
            ratio(added, self.effort_rms(joint))
        };
        self.moving.iter().map(share).fold(0.0, f64::max)
    }

    /// Visibility of a cause, by simple means, over the joints j that move:
    ///
    /// ```text
    /// r_j      what is added to joint j, less its best fit, by least squares over all logs, by 1, qd, dry(qd)
    ///          and qdd of that joint, the column left out that the cause itself is
    /// noise_j  RMS(e[k + 3h] - 3 e[k + 2h] + 3 e[k + h] - e[k]) / sqrt(20), at least 1e-3 RMS(effort_j)
    /// sigmas   sqrt(sum over j of (RMS(r_j) / noise_j)^2 n / h)
    /// share    largest RMS(r_j) / RMS(effort_j)
    /// torque   sqrt(sum over j of (RMS(added_j) / RMS(effort_j))^2)
    /// ```
    ///
    /// `n` is the number of rows and `h` that in 20 ms: a motion of 1 Hz keeps 1/2000 of itself in `noise_j`,
    /// and noise is taken as independent after 20 ms, because logs are smoothed before they are written.
    /// `effort_j` is the effort with the cause.
    pub(super) fn strength(&self, added: &Added, own: Own) -> Strength {
        let mut strength = Strength { sigmas: 0.0, share: 0.0, torque: 0.0 };
        for &joint in &self.moving {
            let here: Vec<f64> = added.iter().flat_map(|run| &run[joint]).copied().collect();
            let effort: Vec<f64> =
                self.runs.iter().flat_map(|run| &run.joints[joint].effort).copied().collect();
            let with: Vec<f64> = effort.iter().zip(&here).map(|(e, a)| e + a).collect();
            let (whole, effort) = (rms(here.iter()), rms(with.iter()));
            let left = rms(self.residual(joint, here, own).iter());
            let sigmas = ratio(left, self.noise(joint)) * self.independent().sqrt();
            strength.sigmas = strength.sigmas.hypot(sigmas);
            strength.share = strength.share.max(ratio(left, effort));
            strength.torque = strength.torque.hypot(ratio(whole, effort));
        }
        strength
    }

    /// Residual of a signal after a fit by the everyday columns of a joint.
    fn residual(&self, joint: usize, mut signal: Vec<f64>, own: Own) -> Vec<f64> {
        let mut columns = [const { Vec::new() }; 4];
        for run in self.runs {
            let position = &run.joints[joint].position;
            let qd = velocity(&run.time, position);
            let qdd = acceleration(&run.time, &average(&run.time, position));
            columns[0].extend(vec![1.0; qd.len()]);
            columns[1].extend(&qd);
            columns[2].extend(qd.iter().map(|qd| dry(*qd)));
            columns[3].extend(qdd);
        }
        let itself = match own {
            Own::Nothing => None,
            Own::Constant => Some(0),
            Own::Velocity => Some(1),
            Own::Direction => Some(2),
        };
        let mut basis: Vec<Vec<f64>> = Vec::new();
        for (index, mut column) in columns.into_iter().enumerate() {
            if Some(index) == itself {
                continue;
            }
            let before = rms(column.iter());
            // The second time takes away what rounding left of the first.
            for unit in basis.iter().chain(&basis.clone()) {
                less(&mut column, unit);
            }
            let after = rms(column.iter());
            if after > DEPENDENT * before {
                let length = after * (column.len() as f64).sqrt();
                column.iter_mut().for_each(|x| *x /= length);
                basis.push(column);
            }
        }
        basis.iter().for_each(|unit| less(&mut signal, unit));
        signal
    }

    /// Noise of a joint's effort.
    fn noise(&self, joint: usize) -> f64 {
        let mut differences = Vec::new();
        for run in self.runs {
            let (effort, h) = (&run.joints[joint].effort, half(&run.time));
            let third = |e: &[f64]| e[3 * h] - 3.0 * e[2 * h] + 3.0 * e[h] - e[0];
            differences.extend(effort.windows(3 * h + 1).map(third));
        }
        let noise = rms(differences.iter()) / 20.0_f64.sqrt();
        noise.max(LEAST_NOISE * self.effort_rms(joint))
    }

    /// Number of rows 20 ms apart.
    fn independent(&self) -> f64 {
        self.runs.iter().map(|run| run.time.len() as f64 / half(&run.time) as f64).sum()
    }
}

/// Subtracts the projection of a signal on a unit column.
fn less(signal: &mut [f64], unit: &[f64]) {
    let along: f64 = signal.iter().zip(unit).map(|(x, u)| x * u).sum();
    signal.iter_mut().zip(unit).for_each(|(x, u)| *x -= along * u);
}

/// A ratio of two sizes; 0 for a divisor of zero.
fn ratio(of: f64, to: f64) -> f64 {
    if to > 0.0 { of / to } else { 0.0 }
}
