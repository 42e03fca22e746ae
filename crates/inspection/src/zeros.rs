use std::collections::BTreeMap;

use nalgebra::{DMatrix, DVector};

use crate::judge::Judge;
use crate::observation::{Observation, ObservationKind, ReadingEvidence, RunZero, Spoils};

/// Joints whose effort at no torque differs from run to run, as that of a torque sensor does which warms up or is set to zero
/// again:
///
/// ```text
/// effort_j = c tau_j + g_j . d + f sign(qd_j) + b qd_j + i qdd_j + offset_jr,   r the run
/// ```
///
/// against the same with one offset. `g_j` is the torque of gravity along each axis of the base: what wrong masses and centres
/// of mass add is much like it, and differs between two postures as well.
pub(crate) fn zeros_of_runs(judge: &Judge, runs: usize) -> Option<Observation> {
    let all: Vec<JointZeros> =
        (0..judge.samples.joints).filter_map(|j| JointZeros::of(judge, j)).collect();
    let best = all.iter().max_by(|a, b| a.gain().total_cmp(&b.gain()))?;
    let evidence = ReadingEvidence {
        joint: best.joint,
        before: best.before,
        after: best.after,
        gain: all.iter().map(JointZeros::gain).sum(),
    };
    let (kind, joints) = (ObservationKind::ZerosOfRuns, all.iter().map(|own| own.joint).collect());
    Some(Observation {
        zeros: all.into_iter().flat_map(|own| own.of_runs).collect(),
        evidence: Some(evidence),
        ..Observation::of_runs(kind, joints, (0..runs).collect(), Spoils::Joints)
    })
}

/// The zeros of a joint, where they differ.
struct JointZeros {
    joint: usize,
    /// Share of the effort about its mean that is left with one offset, and with one of each run.
    before: f64,
    after: f64,
    of_runs: Vec<RunZero>,
}

impl JointZeros {
    fn of(judge: &Judge, joint: usize) -> Option<Self> {
        let (t, samples) = (judge.thresholds, &judge.samples);
        let run = samples.runs(joint);
        let column = |signal: &[f64]| samples.column(signal, joint);
        let (tau, effort) = (column(&judge.whole), column(&samples.effort));
        let count = |r: &usize| run.iter().filter(|own| *own == r).count();
        let means = group_means(&effort, &run);
        if means.len() < 2 || !means.keys().all(|r| count(r) >= t.zero_rows) {
            return None;
        }
        let [x, y, z] = judge.gravity.each_ref().map(|unit| column(unit));
        let (qd, qdd) = (column(&samples.motion[1]), column(&samples.motion[2]));
        let columns = [tau, x, y, z, samples.direction(joint), qd, qdd];
        let one = LeastSquares::of(&columns, &effort, &vec![0; effort.len()])?;
        let own = LeastSquares::of(&columns, &effort, &run)?;
        let whole = one.total.max(f64::MIN_POSITIVE);
        let (before, after) = (one.left / whole, own.left / whole);
        if before < t.zeros_of_runs * (after + t.zeros_floor) {
            return None;
        }
        let drive = &judge.robot.links()[joint].actuator;
        let per_torque = drive.transmission_ratio * drive.torque_gain;
        let of_columns = columns.each_ref().map(|column| group_means(column, &run));
        let zero = |(&run, mean): (&usize, &f64)| {
            let explained = own.coefficients.iter().zip(&of_columns);
            let explained: f64 = explained.map(|(c, means)| c * means[&run]).sum();
            let offset = per_torque * (mean - explained) - drive.torque_offset;
            RunZero { joint, run, offset }
        };
        Some(Self { joint, before, after, of_runs: means.iter().map(zero).collect() })
    }

    /// Logarithm of the factor by which the residual falls.
    fn gain(&self) -> f64 {
        (self.before / self.after.max(f64::MIN_POSITIVE)).ln()
    }
}

/// The mean of the rows of each group.
fn group_means(x: &[f64], group: &[usize]) -> BTreeMap<usize, f64> {
    let mut sums: BTreeMap<usize, (f64, f64)> = BTreeMap::new();
    for (v, g) in x.iter().zip(group) {
        let (sum, count) = sums.entry(*g).or_default();
        (*sum, *count) = (*sum + v, *count + 1.0);
    }
    sums.into_iter().map(|(g, (sum, count))| (g, sum / count)).collect()
}

/// A fit of columns and an offset for each group of rows.
struct LeastSquares {
    coefficients: Vec<f64>,
    /// Sum of squares of the effort about the means of the groups.
    total: f64,
    /// The part of it that is left.
    left: f64,
}

/// Part of the square of a column that is added to it, so that columns which are alike or zero have a solution.
const RIDGE: f64 = 1e-9;

impl LeastSquares {
    fn of(columns: &[Vec<f64>], effort: &[f64], group: &[usize]) -> Option<Self> {
        let centred = |x: &[f64]| {
            let means = group_means(x, group);
            DVector::from_iterator(x.len(), x.iter().zip(group).map(|(v, g)| v - means[g]))
        };
        let columns: Vec<DVector<f64>> = columns.iter().map(|x| centred(x)).collect();
        let a = DMatrix::from_columns(&columns);
        let effort = centred(effort);
        let scale = a.tr_mul(&a).diagonal().map(|d| d.max(f64::MIN_POSITIVE).sqrt());
        let scaled = DMatrix::from_fn(a.nrows(), a.ncols(), |i, k| a[(i, k)] / scale[k]);
        let mut gram = scaled.tr_mul(&scaled);
        (0..gram.nrows()).for_each(|i| gram[(i, i)] += RIDGE);
        let solution = gram.cholesky()?.solve(&scaled.tr_mul(&effort));
        let left = (&effort - &scaled * &solution).norm_squared();
        let coefficients = solution.component_div(&scale).iter().copied().collect();
        Some(Self { coefficients, total: effort.norm_squared(), left })
    }
}
