use diagnosis::EffectAt;
use experiment::{Band, TurningError};
use logs::{PrepareSettings, PreparedJoint, PreparedRun, Run};
use robot::Robot;

use crate::baselines::prepare_runs::prepare_runs;
use crate::baselines::run_columns::RunColumns;
use crate::baselines::scales::Scales;
use crate::baselines::shape::Shape;
use crate::error::BenchmarkError;

/// The result of plain least squares on logs.
#[derive(Debug, Clone, PartialEq)]
pub struct Baseline {
    /// Names of causes, strongest first.
    pub names: Vec<EffectAt>,
    weights: Vec<Vec<Weighted>>,
    scales: Scales,
}

/// A column and its weight.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Weighted {
    /// The column.
    pub shape: Shape,
    /// Effort per unit of the column.
    pub weight: f64,
}

impl Baseline {
    pub(super) fn new(names: Vec<EffectAt>, weights: Vec<Vec<Weighted>>, scales: Scales) -> Self {
        Self { names, weights, scales }
    }

    /// Predicted effort of every joint along a run, `[joint][sample]` at the samples of the run (N m or N). It is not
    /// low-passed, as in a log.
    ///
    /// The motion is the wide-band motion of the run ([`logs::Wide`]), so that prediction and measurement can pass
    /// the same filter.
    ///
    /// # Panics
    ///
    /// When the baseline was made for another robot, or the run is of another robot.
    pub fn predict(&self, robot: &Robot, run: &PreparedRun) -> Vec<Vec<f64>> {
        let run_columns = RunColumns::new(robot, &self.scales, run, 1);
        let shapes: Vec<Vec<Shape>> =
            self.weights.iter().map(|w| w.iter().map(|w| w.shape).collect()).collect();
        let mut efforts = vec![vec![0.0; run_columns.samples()]; robot.joint_count()];
        let columns = run_columns.columns(&shapes);
        for ((effort, weights), columns) in efforts.iter_mut().zip(&self.weights).zip(columns) {
            for (Weighted { weight, .. }, column) in weights.iter().zip(columns) {
                effort.iter_mut().zip(column).for_each(|(effort, x)| *effort += weight * x);
            }
        }
        efforts
    }

    /// RMS of the error on held-out runs, by joint (N m or N):
    ///
    /// ```text
    /// error = L(clamp(effort, -limit, limit) - predicted)
    /// ```
    ///
    /// in the band of these runs' motion and at the samples of [`experiment::robot_error`].
    ///
    /// # Errors
    ///
    /// [`ExperimentError::Log`](experiment::ExperimentError::Log) for runs that cannot be prepared.
    ///
    /// # Panics
    ///
    /// When the baseline was made for another robot.
    pub fn held_out_error(
        &self,
        robot: &Robot,
        control_rate_hz: Option<f64>,
        runs: &[Run],
    ) -> Result<Vec<Option<f64>>, BenchmarkError> {
        let test = prepare_runs(robot, control_rate_hz, runs, &PrepareSettings::default())?;
        let mut errors = TurningError::new(robot.joint_count());
        for run in &test.runs {
            let band = Band::new(test.cutoff_hz, run.rate_hz)?;
            let error = |(joint, predicted): (&PreparedJoint, Vec<f64>)| {
                band.of_log(joint.effort.iter().zip(predicted).map(|(e, p)| e - p).collect())
            };
            let both = run.joints.iter().zip(self.predict(robot, run));
            errors.add(run, test.cutoff_hz, &both.map(error).collect::<Vec<_>>())?;
        }
        Ok(errors.rms())
    }
}
