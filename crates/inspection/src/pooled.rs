use nalgebra::{DMatrix, DVector};

use crate::motion_samples::MotionSamples;

/// Rounds of weighting: every joint is weighted by one over its residual.
const ROUNDS: usize = 4;

/// Factors of columns that all joints share, by weighted least squares over all joints:
///
/// ```text
/// effort_j - granted_j = sum_k x_k column_kj + offset_j + f_j direction + b_j qd + i_j qdd
/// weight_j = 1 / residual of joint j, which is at least a share of its effort
/// ```
///
/// Signals are row-major, `rows x joints`. `None` where the columns cannot be told apart.
pub(crate) fn fit_pooled(
    samples: &MotionSamples,
    granted: &[f64],
    columns: &[&[f64]],
    least_share: f64,
) -> Option<Vec<f64>> {
    let joints: Vec<Projected> =
        (0..samples.joints).filter_map(|j| Projected::of(samples, granted, columns, j)).collect();
    let mut weights: Vec<f64> = joints.iter().map(|j| 1.0 / j.total).collect();
    let mut found = None;
    for _ in 0..ROUNDS {
        let size = columns.len();
        let (mut gram, mut right) = (DMatrix::zeros(size, size), DVector::zeros(size));
        for (joint, weight) in joints.iter().zip(&weights) {
            gram += &joint.gram * *weight;
            right += &joint.right * *weight;
        }
        let scale = gram.diagonal().map(|d: f64| d.max(f64::MIN_POSITIVE).sqrt());
        let mut scaled = DMatrix::from_fn(size, size, |i, k| gram[(i, k)] / (scale[i] * scale[k]));
        (0..size).for_each(|i| scaled[(i, i)] += 1e-6);
        let solution = scaled.cholesky()?.solve(&right.component_div(&scale));
        let x = solution.component_div(&scale);
        for (joint, weight) in joints.iter().zip(&mut weights) {
            let left = joint.target - 2.0 * x.dot(&joint.right) + (&joint.gram * &x).dot(&x);
            *weight = 1.0 / left.max(least_share * joint.total);
        }
        found = Some(x.iter().copied().collect());
    }
    found
}

/// The factor of a column at one joint, with its standard error, where one sample in `rows_of_independent` is independent:
///
/// ```text
/// effort - granted = x column + offset + f direction + b qd + i qdd
/// ```
///
/// `None` for a joint whose effort or column is constant.
pub(crate) fn own_factor(
    samples: &MotionSamples,
    granted: &[f64],
    column: &[f64],
    j: usize,
    rows_of_independent: f64,
) -> Option<[f64; 2]> {
    let Projected { gram, right, target, .. } = Projected::of(samples, granted, &[column], j)?;
    let (gram, right) = (gram[(0, 0)], right[0]);
    let rows = samples.column(&samples.effort, j).len() as f64;
    let independent = rows / rows_of_independent;
    (gram > 0.0 && independent > 1.0).then(|| {
        let factor = right / gram;
        let left = (target - factor * right).max(0.0);
        [factor, (left / (gram * independent)).sqrt()]
    })
}

/// Sums of a joint, orthogonal to the columns of its drive.
struct Projected {
    gram: DMatrix<f64>,
    right: DVector<f64>,
    /// Squares of the target, and of the effort about its mean.
    target: f64,
    total: f64,
}

impl Projected {
    fn of(samples: &MotionSamples, granted: &[f64], columns: &[&[f64]], j: usize) -> Option<Self> {
        let column = |x: &[f64]| samples.column(x, j);
        let [_, qd, qdd] = &samples.motion;
        let mut effort = column(&samples.effort);
        let rows = effort.len();
        let mut own = vec![vec![1.0; rows], samples.direction(j), column(qd), column(qdd)];
        make_orthonormal(&mut own);
        let mean = effort.iter().sum::<f64>() / rows.max(1) as f64;
        let target = effort.iter().zip(column(granted)).map(|(e, g)| e - g).collect();
        effort.iter_mut().for_each(|e| *e -= mean);
        let total = dot(&effort, &effort);
        let target = without(target, &own);
        let all: Vec<Vec<f64>> = columns.iter().map(|c| without(column(c), &own)).collect();
        let size = all.len();
        (total > 0.0).then(|| Self {
            gram: DMatrix::from_fn(size, size, |i, k| dot(&all[i], &all[k])),
            right: DVector::from_fn(size, |i, _| dot(&all[i], &target)),
            target: dot(&target, &target),
            total,
        })
    }
}

/// Makes columns orthonormal (Gram-Schmidt); what depends on earlier ones becomes zero.
fn make_orthonormal(columns: &mut [Vec<f64>]) {
    for k in 0..columns.len() {
        let (before, rest) = columns.split_at_mut(k);
        let Some(column) = rest.first_mut() else { return };
        let size = dot(column, column).sqrt();
        let mut left = without(std::mem::take(column), before);
        let norm = dot(&left, &left).sqrt();
        let by = if norm > 1e-9 * size { 1.0 / norm } else { 0.0 };
        left.iter_mut().for_each(|x| *x *= by);
        *column = left;
    }
}

fn without(mut x: Vec<f64>, orthonormal: &[Vec<f64>]) -> Vec<f64> {
    for column in orthonormal {
        let along = dot(&x, column);
        x.iter_mut().zip(column).for_each(|(x, c)| *x -= along * c);
    }
    x
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(x, y)| x * y).sum()
}
