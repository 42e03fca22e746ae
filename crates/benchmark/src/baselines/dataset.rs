use std::ops::Range;

use dynamics::add_gram;
use experiment::Band;
use faer::{Mat, MatRef};
use logs::{LogError, Prepared, PreparedRun};
use robot::Robot;

use crate::baselines::folds::folds;
use crate::baselines::run_columns::RunColumns;
use crate::baselines::scales::Scales;
use crate::baselines::shape::Shape;

/// What is left out at both ends of a run behind the low-pass: periods of the cut-off, and at
/// least as many seconds, in which a controller that was just started settles.
const SETTLING_PERIODS: f64 = 1.5;
const SETTLING_S: f64 = 0.5;

/// The signal that the columns explain.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Target {
    /// Effort minus that of the nominal robot.
    Gap,
    /// Effort.
    Effort,
}

/// All columns at one joint over all runs, and their sums of products.
pub(super) struct Joint {
    /// Shapes of the columns; the target follows them.
    pub shapes: Vec<Shape>,
    /// RMS of each column, by which the stored columns are divided.
    pub scales: Vec<f64>,
    /// Values column by column, the target last.
    columns: Vec<f64>,
    /// Number of samples over all runs.
    pub samples: usize,
    /// Gram matrix over all samples.
    pub total: Mat<f64>,
    /// Gram matrices of the training samples and of the held-out samples of each fold.
    pub folds: Vec<[Mat<f64>; 2]>,
    /// RMS of the effort (N m or N).
    pub torque_rms: f64,
}

/// The columns of every joint in the band, at the rate of the regression.
pub(super) struct Dataset {
    /// By joint.
    pub joints: Vec<Joint>,
    /// Samples of each run.
    pub runs: Vec<Range<usize>>,
}

/// Columns by joint that grow run by run, followed by the effort and the target.
struct Growing {
    columns: Vec<Vec<Vec<f64>>>,
    runs: Vec<Range<usize>>,
    rate_hz: f64,
}

impl Dataset {
    /// Evaluates `shapes`, listed by joint, along logs.
    ///
    /// With `N` samples at 2.5 cut-offs and `m` columns at a joint, the low-pass takes about
    /// `250 N m` operations and the sums `2 N m²`: 0.5 and 0.6 Gflop for seven joints, 140 columns
    /// at most and 80 s.
    pub fn of(
        (robot, scales): (&Robot, &Scales),
        logs: &Prepared,
        shapes: Vec<Vec<Shape>>,
        target: Target,
    ) -> Result<Self, LogError> {
        let columns = shapes.iter().map(|s| vec![Vec::new(); s.len() + 2]).collect();
        let mut growing = Growing { columns, runs: Vec::new(), rate_hz: 1.0 };
        for run in &logs.runs {
            growing.add((robot, scales), (run, logs.cutoff_hz), &shapes, target)?;
        }
        let Growing { columns, runs, rate_hz } = growing;
        let all = columns.into_iter().zip(shapes);
        let joints = all.map(|(columns, shapes)| Joint::of(columns, shapes, (&runs, rate_hz)));
        Ok(Self { joints: joints.collect(), runs })
    }
}

impl Growing {
    fn add(
        &mut self,
        (robot, scales): (&Robot, &Scales),
        (run, cutoff_hz): (&PreparedRun, f64),
        shapes: &[Vec<Shape>],
        target: Target,
    ) -> Result<(), LogError> {
        let band = Band::new(cutoff_hz, run.rate_hz)?;
        let run_columns = RunColumns::new(robot, scales, run, band.stride);
        let start = self.runs.last().map_or(0, |last| last.end);
        self.rate_hz = run.rate_hz / band.whole_stride() as f64;
        let mut added = 0;
        let mut put = |into: &mut Vec<f64>, values: &[f64]| {
            let end_s = SETTLING_S.max(SETTLING_PERIODS / cutoff_hz);
            let end = (end_s * self.rate_hz).ceil() as usize;
            let end = if values.len() > 8 * end { end } else { 0 };
            into.extend_from_slice(&values[end..values.len() - end]);
            added = values.len() - 2 * end;
        };
        for (j, columns) in run_columns.columns(shapes).into_iter().enumerate() {
            let all = &mut self.columns[j];
            for (into, column) in all.iter_mut().zip(columns) {
                put(into, &band.of_column(column));
            }
            let effort = band.of_log(run.joints[j].effort.clone());
            let nominal = band.of_column(run_columns.nominal[j].clone());
            let gap: Vec<f64> = effort.iter().zip(nominal).map(|(e, n)| e - n).collect();
            let width = shapes[j].len();
            put(&mut all[width], if target == Target::Gap { &gap } else { &effort });
            put(&mut all[width + 1], &effort);
        }
        self.runs.push(start..start + added);
        Ok(())
    }
}

impl Joint {
    fn of(
        mut columns: Vec<Vec<f64>>,
        shapes: Vec<Shape>,
        (runs, rate_hz): (&[Range<usize>], f64),
    ) -> Self {
        let torque_rms = columns.pop().map_or(0.0, |effort| rms(&effort));
        let samples = columns.last().map_or(0, Vec::len);
        let mut scales = Vec::new();
        for column in columns.iter_mut().take(shapes.len()) {
            let scale = rms(column);
            let scale = if scale > 0.0 { scale } else { 1.0 };
            column.iter_mut().for_each(|x| *x /= scale);
            scales.push(scale);
        }
        let columns = columns.concat();
        let width = shapes.len() + 1;
        let sums = |ranges: &[Range<usize>]| sums(&columns, [samples, width], ranges);
        let held = folds(runs, rate_hz);
        let parts: Vec<[Mat<f64>; 2]> =
            held.iter().map(|f| [sums(&f.held), sums(&f.near)]).collect();
        let mut total = Mat::zeros(width, width);
        parts.iter().for_each(|[held, _]| total += held);
        let folds = parts.into_iter().map(|[held, near]| [&total - &held - &near, held]);
        let folds = folds.collect();
        Self { shapes, scales, columns, samples, total, folds, torque_rms }
    }

    /// Index of the target among the columns.
    pub fn target(&self) -> usize {
        self.shapes.len()
    }

    /// A column, or the target.
    pub fn column(&self, index: usize) -> &[f64] {
        &self.columns[index * self.samples..(index + 1) * self.samples]
    }

    /// The target minus the columns times their weights.
    pub fn residual_of(&self, columns: &[usize], weights: &[f64]) -> Vec<f64> {
        let mut left = self.column(self.target()).to_vec();
        for (&column, weight) in columns.iter().zip(weights) {
            left.iter_mut().zip(self.column(column)).for_each(|(left, x)| *left -= weight * x);
        }
        left
    }
}

fn rms(x: &[f64]) -> f64 {
    (x.iter().map(|x| x * x).sum::<f64>() / x.len().max(1) as f64).sqrt()
}

/// Sums of products of all columns over ranges of samples.
fn sums(columns: &[f64], [samples, width]: [usize; 2], ranges: &[Range<usize>]) -> Mat<f64> {
    let all = MatRef::from_column_major_slice(columns, samples, width);
    let mut gram = Mat::zeros(width, width);
    for range in ranges.iter().filter(|range| !range.is_empty()) {
        add_gram(gram.as_mut(), all.subrows(range.start, range.len()));
    }
    for i in 0..width {
        for k in i + 1..width {
            gram[(i, k)] = gram[(k, i)];
        }
    }
    gram
}
