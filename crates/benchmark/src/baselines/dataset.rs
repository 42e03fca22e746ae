use std::ops::Range;

use dynamics::add_gram;
use experiment::Band;
use faer::{Mat, MatRef};
use logs::{LogError, Prepared, PreparedRun};
use robot::Robot;

use crate::baselines::run_columns::RunColumns;
use crate::baselines::scales::Scales;
use crate::baselines::shape::Shape;

/// What is left out at both ends of a run behind the low-pass: periods of the cut-off, and at
/// least as many seconds, in which a controller that was just started settles.
const SETTLING_PERIODS: f64 = 1.5;
const SETTLING_S: f64 = 0.5;

/// All columns at one joint over all runs, and their sums of products.
pub(super) struct Joint {
    /// Shapes of the columns; the effort follows them.
    pub shapes: Vec<Shape>,
    /// RMS of each column, by which the stored columns are divided.
    pub scales: Vec<f64>,
    /// Values column by column, the effort last.
    columns: Vec<f64>,
    /// Number of samples over all runs.
    pub samples: usize,
    /// Gram matrix over all samples.
    pub total: Mat<f64>,
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

/// Columns by joint that grow run by run, followed by the effort.
struct Growing {
    columns: Vec<Vec<Vec<f64>>>,
    runs: Vec<Range<usize>>,
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
    ) -> Result<Self, LogError> {
        let columns = shapes.iter().map(|s| vec![Vec::new(); s.len() + 1]).collect();
        let mut growing = Growing { columns, runs: Vec::new() };
        for run in &logs.runs {
            growing.add((robot, scales), (run, logs.cutoff_hz), &shapes)?;
        }
        let Growing { columns, runs } = growing;
        let all = columns.into_iter().zip(shapes);
        let joints = all.map(|(columns, shapes)| Joint::of(columns, shapes, &runs));
        Ok(Self { joints: joints.collect(), runs })
    }
}

impl Growing {
    fn add(
        &mut self,
        (robot, scales): (&Robot, &Scales),
        (run, cutoff_hz): (&PreparedRun, f64),
        shapes: &[Vec<Shape>],
    ) -> Result<(), LogError> {
        let band = Band::new(cutoff_hz, run.rate_hz)?;
        let run_columns = RunColumns::new(robot, scales, run, band.stride);
        let start = self.runs.last().map_or(0, |last| last.end);
        let rate_hz = run.rate_hz / band.whole_stride() as f64;
        let mut added = 0;
        let mut put = |into: &mut Vec<f64>, values: &[f64]| {
            let end_s = SETTLING_S.max(SETTLING_PERIODS / cutoff_hz);
            let end = (end_s * rate_hz).ceil() as usize;
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
            put(&mut all[shapes[j].len()], &effort);
        }
        self.runs.push(start..start + added);
        Ok(())
    }
}

impl Joint {
    fn of(mut columns: Vec<Vec<f64>>, shapes: Vec<Shape>, runs: &[Range<usize>]) -> Self {
        let torque_rms = columns.last().map_or(0.0, |effort| rms(effort));
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
        let total = sums(&columns, [samples, width], runs);
        Self { shapes, scales, columns, samples, total, torque_rms }
    }

    /// Index of the effort among the columns.
    pub fn target(&self) -> usize {
        self.shapes.len()
    }

    /// A column, or the effort.
    pub fn column(&self, index: usize) -> &[f64] {
        &self.columns[index * self.samples..(index + 1) * self.samples]
    }

    /// The effort minus the columns times their weights.
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
