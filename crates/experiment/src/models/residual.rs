use diagnosis::{DiagnosisRun, HeldOutPart, Span, Verdict};
use learner::{
    Mean, Model, ModelKind, RobotTorque, Samples, TorqueModel, TrainSettings, TrainedModel,
    Training,
};
use logs::{LogError, LowPass, Prepared, PreparedRun, rest_speeds};
use rayon::prelude::*;
use robot::Robot;

use crate::error::ExperimentError;
use crate::models::relevance::{Relevance, relevance};
use crate::progress::Progress;

/// Order of the low-pass of the residual, as in the diagnosis.
const ORDER: usize = 4;

/// Number of samples for the processes: on a recorded LWR4, 500 predict as much as 1000.
const POINTS: usize = 600;

/// Least share of the residual that a process must predict to be used.
const LEAST_SHARE: f64 = 0.05;

/// A Gaussian process for the residual torque of a diagnosis.
#[derive(Debug, Clone)]
pub struct Residual {
    /// The extended robot, with the process added at the joints where it helps.
    pub model: Model,
    /// One entry a joint.
    pub joints: Vec<ResidualJoint>,
    /// Number of parts of the logs that were held out in turn.
    pub parts: usize,
    /// Whether Ctrl-C ended a search.
    pub is_cut_short: bool,
}

/// Effect of the process at one joint, on held-out data.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ResidualJoint {
    /// RMS of measured torque minus that of the extended robot, low-passed (N m or N).
    pub extended_rms: f64,
    /// The same with the process added.
    pub with_process_rms: f64,
    /// Number of held-out parts in which the process lowers the error.
    pub better_in: usize,
    /// Whether the model includes the process at this joint.
    pub is_used: bool,
    /// Signals on which the process depends, the strongest first; empty where it is not used.
    pub relevance: Vec<Relevance>,
}

impl ResidualJoint {
    /// Share of the power of the extended robot's residual that the process predicts; negative where it raises the
    /// error.
    pub fn share(&self) -> f64 {
        1.0 - (self.with_process_rms / self.extended_rms).powi(2)
    }
}

/// Learns a Gaussian process for the residual torque of the extended robot of a diagnosis,
///
/// ```text
/// tau = extended robot(q, qd, qdd) + f(q, qd, qdd) + noise,   f ~ GP
/// ```
///
/// and keeps it at the joints where it helps. The test is on the parts that the diagnosis held out, with extended
/// robot and process found on the rest. There the process must predict at least 5 % of the residual, and some of it
/// in more than half of the parts. At other joints the model is the extended robot.
///
/// Without [`DiagnosisRun::held_out`] the process is used at no joint.
///
/// # Errors
///
/// [`ExperimentError::Learner`] and [`ExperimentError::Log`].
pub fn learn_residual(
    robot: &Robot,
    outcome: &DiagnosisRun,
    progress: &dyn Progress,
) -> Result<Residual, ExperimentError> {
    let logs = Logs { robot, prepared: &outcome.prepared, rest: rest_speeds(&outcome.prepared) };
    let parts = outcome.held_out.len();
    progress.begin(&format!("process of what is left, without each of {parts} parts"));
    let tested: Vec<[Vec<Vec<f64>>; 2]> = outcome
        .held_out
        .par_iter()
        .map(|part| logs.residuals_on(part, progress))
        .collect::<Result<_, _>>()?;
    let mut errors = vec![Errors::default(); robot.joint_count()];
    for [before, after] in &tested {
        errors.iter_mut().zip(before.iter().zip(after)).for_each(|(e, (b, a))| e.add(b, a));
    }
    let verdicts = outcome.diagnosis.joints.iter().map(|joint| joint.verdict);
    let mut joints: Vec<ResidualJoint> =
        errors.iter().zip(verdicts).map(|(e, verdict)| e.joint(verdict, parts)).collect();

    progress.begin("process of what is left");
    let all = Samples::new(logs.prepared);
    let mut fitted = logs.fit(&outcome.extended, &all, progress)?;
    let noise = logs.mean_squares(&outcome.extended, &all);
    for (j, joint) in joints.iter_mut().enumerate() {
        if joint.is_used {
            joint.relevance = relevance(&fitted, j, robot, &all);
        } else {
            fitted.model.drop_process(j, noise[j])?;
        }
    }
    Ok(Residual { model: fitted.model, joints, parts, is_cut_short: progress.is_stopped() })
}

/// The logs and the robot that they belong to.
struct Logs<'a> {
    robot: &'a Robot,
    prepared: &'a Prepared,
    /// Speed below which each joint counts as at rest (rad/s or m/s).
    rest: Vec<f64>,
}

impl Logs<'_> {
    /// The process added to an extended robot.
    fn fit(
        &self,
        extended: &Robot,
        samples: &Samples,
        progress: &dyn Progress,
    ) -> Result<TrainedModel, ExperimentError> {
        let settings = TrainSettings { points: POINTS, ..TrainSettings::default() };
        let training = Training::new(self.robot, samples, self.rest.clone(), &settings, progress)?;
        Ok(training.with_named(extended).fit(ModelKind::NamedGp)?)
    }

    /// Residuals on a held-out part: of the extended robot, and of the robot with a process that was learned on the
    /// other parts.
    fn residuals_on(
        &self,
        part: &HeldOutPart,
        progress: &dyn Progress,
    ) -> Result<[Vec<Vec<f64>>; 2], ExperimentError> {
        let fitted = self.fit(&part.extended, &self.samples(&part.train), progress)?;
        let alone = self.model_of(&part.extended);
        Ok([self.residual_of(&alone, &part.test)?, self.residual_of(&fitted.model, &part.test)?])
    }

    /// An extended robot as a model.
    fn model_of(&self, extended: &Robot) -> Model {
        let torque = RobotTorque::new(extended.clone(), self.rest.clone());
        let noise = vec![0.0; self.robot.joint_count()];
        Model::new(ModelKind::Named, self.robot, Mean::Robot(Box::new(torque)), noise)
    }

    /// Mean square of the residual of an extended robot at every joint.
    fn mean_squares(&self, extended: &Robot, samples: &Samples) -> Vec<f64> {
        let (expected, joints) =
            (self.model_of(extended).torque(samples), self.robot.joint_count());
        let mut sums = vec![0.0; joints];
        for (i, expected) in expected.chunks_exact(joints).enumerate() {
            let errors = samples.tau(i).iter().zip(expected).map(|(tau, e)| tau - e);
            sums.iter_mut().zip(errors).for_each(|(sum, error)| *sum += error * error);
        }
        sums.iter().map(|sum| sum / samples.len() as f64).collect()
    }

    /// Residual of a model over some stretches, low-passed, one row a joint.
    fn residual_of(&self, model: &Model, spans: &[Span]) -> Result<Vec<Vec<f64>>, LogError> {
        let joints = self.robot.joint_count();
        let mut all = vec![Vec::new(); joints];
        for span in spans {
            let run = &self.prepared.runs[span.run];
            let torque = model.torque(&Samples::new(&self.prepared.with_runs(vec![run.clone()])));
            let low_pass = LowPass::new(ORDER, self.prepared.cutoff_hz, run.rate_hz)?;
            let samples = samples_in(run, span);
            for (j, (joint, all)) in run.joints.iter().zip(&mut all).enumerate() {
                let expected = torque.iter().skip(j).step_by(joints);
                let mut left: Vec<f64> =
                    joint.effort.iter().zip(expected).map(|(tau, e)| tau - e).collect();
                low_pass.apply(&mut left);
                all.extend_from_slice(&left[samples.clone()]);
            }
        }
        Ok(all)
    }

    /// The samples of some stretches.
    fn samples(&self, spans: &[Span]) -> Samples {
        let cut = |span: &Span| {
            let run = &self.prepared.runs[span.run];
            run.part(samples_in(run, span))
        };
        Samples::new(&self.prepared.with_runs(spans.iter().map(cut).collect()))
    }
}

/// The samples of a run within one stretch.
fn samples_in(run: &PreparedRun, span: &Span) -> std::ops::Range<usize> {
    let [from, to] = span.time_s.map(|edge| run.time.partition_point(|t| *t < edge));
    from..to
}

/// Errors at one joint, summed over the held-out parts.
#[derive(Debug, Clone, Default)]
struct Errors {
    samples: usize,
    extended: f64,
    with_process: f64,
    better_in: usize,
}

impl Errors {
    /// Adds the residuals of one part, without and with the process.
    fn add(&mut self, extended: &[f64], with_process: &[f64]) {
        let power = |left: &[f64]| left.iter().map(|x| x * x).sum::<f64>();
        let (before, after) = (power(extended), power(with_process));
        self.samples += extended.len();
        self.extended += before;
        self.with_process += after;
        self.better_in += usize::from(after < before);
    }

    fn joint(&self, verdict: Verdict, parts: usize) -> ResidualJoint {
        let rms = |power: f64| (power / self.samples as f64).sqrt();
        let joint = ResidualJoint {
            extended_rms: rms(self.extended),
            with_process_rms: rms(self.with_process),
            better_in: self.better_in,
            ..ResidualJoint::default()
        };
        let pays = joint.share() >= LEAST_SHARE && 2 * self.better_in > parts;
        ResidualJoint { is_used: pays && verdict != Verdict::DataInadequate, ..joint }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn joint(parts: &[[f64; 2]]) -> ResidualJoint {
        let mut errors = Errors::default();
        parts.iter().for_each(|&[before, after]| errors.add(&[before; 3], &[after; 3]));
        errors.joint(Verdict::PartlyExplained, parts.len())
    }

    #[test]
    fn a_process_is_used_where_it_predicts_a_twentieth_and_in_most_of_the_parts() {
        let halved = joint(&[[2.0, 1.0], [2.0, 1.0]]);
        assert!((halved.share() - 0.75).abs() < 1e-12 && halved.is_used);
        let mut errors = Errors::default();
        errors.add(&[2.0], &[1.0]);
        assert!(errors.joint(Verdict::Explained, 1).is_used);
        assert!(!errors.joint(Verdict::DataInadequate, 1).is_used);
        assert!(!joint(&[[2.0, 1.99], [2.0, 1.99]]).is_used, "1 %");
        // One part in two is no majority, whatever the sum says.
        assert!(!joint(&[[9.0, 1.0], [1.0, 1.1]]).is_used);
        assert!(!joint(&[]).is_used, "nothing was held out");
    }
}
