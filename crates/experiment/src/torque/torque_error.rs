use diagnosis::{LeftOver, unexplained_torque};
use learner::{Mean, Model, Samples, TorqueModel};
use logs::{
    LogError, LowPass, PrepareSettings, Prepared, PreparedRun, Run, centre_commands, prepare,
    rest_speeds,
};
use robot::Robot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::error::ExperimentError;
use crate::models::learned::Learned;
use crate::scenario::tracking_scenario::TrackingScenario;
use crate::torque::turning_error::TurningError;

/// Order of the low-pass of torques, as in the diagnosis.
const ORDER: usize = 4;

/// Error of a model's torque prediction on held-out runs, in the band of the motion.
///
/// ```text
/// error = L(measured - predicted),   nMSE = mean(error²) / variance(L measured)
/// ```
///
/// with `L` the low-pass of the diagnosis. Faster signals are noise or vibration, which no model of the state
/// predicts. A described robot predicts along the motion, with delays, springs and encoder errors
/// ([`unexplained_torque`]). A learned model predicts from the state at each instant.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
pub struct TorqueError {
    /// Name of the model.
    pub model: String,
    /// RMS of the error, by joint (N m or N).
    pub rms_nm: Vec<f64>,
    /// nMSE, by joint; `None` where the torque is constant.
    pub nmse: Vec<Option<f64>>,
}

/// The errors of every model that a scenario feeds forward, on runs that the models were not learned from.
///
/// # Errors
///
/// [`ExperimentError::Log`] for runs that cannot be prepared.
pub fn torque_errors(
    scenario: &TrackingScenario,
    learned: &Learned,
    test: &[Run],
) -> Result<Vec<TorqueError>, ExperimentError> {
    let mut prepared = prepare(test, &PrepareSettings::default())?;
    centre_commands(scenario.robot(), &mut prepared.runs, scenario.loaded_robot().control.rate_hz);
    let mut errors: Vec<TorqueError> = Vec::new();
    for kind in scenario.all_feedforward().into_iter().filter_map(|kind| kind.model()) {
        let is_new = errors.iter().all(|error| error.model != kind.name());
        if let Some(model) = learned.model(kind).filter(|_| is_new) {
            errors.push(TorqueError::of(model, &prepared)?);
        }
    }
    Ok(errors)
}

/// RMS of the torque that a described robot leaves unexplained, by joint (N m or N), while the joint moves, in the
/// band of the motion ([`unexplained_torque`]). The robot may be the nominal one or one that a diagnosis has
/// extended.
///
/// A joint slower than 5 mrad/s (or mm/s) for 0.2 s is held by dry friction of any size up to its level, which no
/// model predicts. These samples are left out, and a joint that only stands has no error.
///
/// # Errors
///
/// [`ExperimentError::Log`] for runs that cannot be prepared.
///
/// # Panics
///
/// When robot and runs differ in their number of joints.
pub fn robot_error(
    robot: &Robot,
    control_rate_hz: Option<f64>,
    runs: &[Run],
) -> Result<Vec<Option<f64>>, ExperimentError> {
    let mut test = prepare(runs, &PrepareSettings::default())?;
    centre_commands(robot, &mut test.runs, control_rate_hz);
    let mut errors = TurningError::new(robot.joint_count());
    for (run, rest) in test.runs.iter().zip(unexplained_torque(robot, &rest_speeds(&test), &test)?)
    {
        errors.add(run, test.cutoff_hz, &rest.left)?;
    }
    Ok(errors.rms())
}

impl TorqueError {
    fn of(model: &Model, test: &Prepared) -> Result<Self, LogError> {
        let left_over = match (&model.mean, &model.process) {
            (Mean::Robot(torque), None) => {
                unexplained_torque(torque.robot(), torque.rest_speed(), test)?
            }
            _ => unexplained_by(model, test)?,
        };
        let mut sums = vec![Sums::default(); model.joints()];
        for run in left_over {
            let joints = run.measured.iter().zip(&run.left);
            sums.iter_mut().zip(joints).for_each(|(sums, (torque, left))| sums.add(torque, left));
        }
        Ok(Self {
            model: model.kind.name().to_owned(),
            rms_nm: sums.iter().map(|sums| sums.mean(sums.error).sqrt()).collect(),
            nmse: sums.iter().map(Sums::nmse).collect(),
        })
    }
}

/// The torque of each run that a learned model leaves unexplained.
fn unexplained_by(model: &Model, test: &Prepared) -> Result<Vec<LeftOver>, LogError> {
    let of = |run: &PreparedRun| {
        let part = test.with_runs(vec![run.clone()]);
        let low_pass = LowPass::new(ORDER, test.cutoff_hz, run.rate_hz)?;
        Ok(in_band(run, &model.torque(&Samples::new(&part)), &low_pass))
    };
    test.runs.iter().map(of).collect()
}

/// The efforts of a run, and their residual after `predicted` (row-major), in the band.
fn in_band(run: &PreparedRun, predicted: &[f64], low_pass: &LowPass) -> LeftOver {
    let mut measured: Vec<Vec<f64>> = run.joints.iter().map(|j| j.effort.clone()).collect();
    let mut left = measured.clone();
    for (j, left) in left.iter_mut().enumerate() {
        let predicted = predicted.iter().skip(j).step_by(run.joints.len());
        left.iter_mut().zip(predicted).for_each(|(left, predicted)| *left -= predicted);
    }
    measured.iter_mut().chain(&mut left).for_each(|signal| low_pass.apply(signal));
    LeftOver { measured, left }
}

/// Sums over the samples of a joint.
#[derive(Debug, Clone, Default)]
struct Sums {
    samples: usize,
    error: f64,
    torque: f64,
    square: f64,
}

impl Sums {
    fn add(&mut self, torque: &[f64], error: &[f64]) {
        self.samples += torque.len();
        self.error += error.iter().map(|e| e * e).sum::<f64>();
        self.torque += torque.iter().sum::<f64>();
        self.square += torque.iter().map(|tau| tau * tau).sum::<f64>();
    }

    fn mean(&self, sum: f64) -> f64 {
        sum / self.samples as f64
    }

    fn nmse(&self) -> Option<f64> {
        let variance = self.mean(self.square) - self.mean(self.torque).powi(2);
        (variance > 0.0).then(|| self.mean(self.error) / variance)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use logs::PreparedJoint;

    /// Two joints of which the second has this torque.
    fn run(torque: &[f64]) -> PreparedRun {
        let joint =
            |effort: &[f64]| PreparedJoint::exact([vec![], vec![], vec![]], effort.to_vec());
        PreparedRun {
            name: "run".into(),
            rate_hz: 500.0,
            time: (0..torque.len()).map(|k| 0.002 * k as f64).collect(),
            session_start_s: 0.0,
            joints: vec![joint(&vec![9.0; torque.len()]), joint(torque)],
        }
    }

    #[test]
    fn a_slow_error_counts_whole_and_a_fast_one_not_at_all() {
        // Ten turns at 1 Hz, and a ripple of 100 Hz that no low-pass at 10 Hz lets through.
        let wave = |k: usize, hz: f64| (std::f64::consts::TAU * hz * 0.002 * k as f64).sin();
        let torque: Vec<f64> =
            (0..5000).map(|k| 2.0 + wave(k, 1.0) + 0.5 * wave(k, 100.0)).collect();
        let predicted: Vec<f64> = (0..5000).flat_map(|k| [0.0, 1.9 + wave(k, 1.0)]).collect();
        let filter = LowPass::new(ORDER, 10.0, 500.0).unwrap();
        let LeftOver { measured, left } = in_band(&run(&torque), &predicted, &filter);
        let mut sums = Sums::default();
        sums.add(&measured[1], &left[1]);
        // A constant error of 0.1 N m, and a torque of variance 1/2.
        assert!((sums.mean(sums.error).sqrt() - 0.1).abs() < 1e-3, "{sums:?}");
        assert!((sums.nmse().unwrap() - 0.02).abs() < 1e-3, "{sums:?}");
    }

    #[test]
    fn a_constant_torque_has_no_variance_to_compare_with() {
        assert_eq!(Sums { samples: 4, error: 1.0, torque: 8.0, square: 16.0 }.nmse(), None);
    }
}
