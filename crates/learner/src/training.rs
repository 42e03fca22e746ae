use std::collections::BTreeMap;

use dynamics::{ColumnSet, Dynamics};
use faer::Mat;
use gaussian_process::LearnedKernel;
use robot::Robot;

use crate::error::LearnerError;
use crate::inputs::ProcessInputs;
use crate::model::{Mean, Model};
use crate::model_kind::ModelKind;
use crate::progress::TrainingProgress;
use crate::rigid_body_fit::RigidBodyFit;
use crate::robot_torque::RobotTorque;
use crate::sample_source::SampleSource;
use crate::samples::Samples;
use crate::settings::TrainSettings;
use crate::torque_model::TorqueModel;
use crate::{kernels, memory};

/// Weight of one unit of divergence from the described inertias beside half a squared standard
/// error: enough to determine what the log leaves open, and little beside what the log determines.
const PRIOR_WEIGHT: f64 = 1.0;

/// A trained model and the results of its training.
#[derive(Debug, Clone)]
pub struct TrainedModel {
    /// The model.
    pub model: Model,
    /// The result of every joint; empty for a model without hyperparameters.
    pub joints: Vec<JointFit>,
    /// Log marginal likelihood of all joints together, where there is one.
    pub log_likelihood: Option<f64>,
}

/// The result of training one joint.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct JointFit {
    /// `log p(y_k)` under the model.
    pub log_likelihood: Option<f64>,
    /// Search for the Gaussian kernel, on the points that it was searched with.
    pub kernel: Option<LearnedKernel>,
    /// Weight of the Gaussian kernel beside the rigid-body kernel (equation 9).
    pub lambda: Option<f64>,
    /// Root mean square of the errors that the cross-validation made with every weight (N m
    /// or N), in the order of the settings.
    pub held_out: Vec<f64>,
}

/// The data and the kernels that models are trained with and share.
pub struct Training<'a> {
    pub(crate) robot: &'a Robot,
    pub(crate) settings: &'a TrainSettings,
    pub(crate) progress: &'a dyn TrainingProgress,
    /// Every sample.
    pub(crate) all: &'a dyn SampleSource,
    /// Those that exact processes are conditioned on.
    pub(crate) few: Samples,
    pub(crate) inputs: ProcessInputs,
    /// Inputs of `few`, row-major.
    pub(crate) points: Vec<f64>,
    rest_speed: Vec<f64>,
    regression: Option<&'a RigidBodyFit>,
    named: Option<&'a Robot>,
    kernels: BTreeMap<&'static str, Vec<LearnedKernel>>,
}

impl<'a> Training<'a> {
    /// Prepares the training on `samples` of `robot`, in memory or in a file, whose joints count as at rest below
    /// `rest_speed` (rad/s or m/s, one entry a joint).
    ///
    /// # Errors
    ///
    /// [`LearnerError`] for settings, samples or a robot that do not go together, and when
    /// exact processes of that many points would not fit into memory.
    pub fn new(
        robot: &'a Robot,
        samples: &'a dyn SampleSource,
        rest_speed: Vec<f64>,
        settings: &'a TrainSettings,
        progress: &'a dyn TrainingProgress,
    ) -> Result<Self, LearnerError> {
        settings.check()?;
        if samples.is_empty() {
            return Err(LearnerError::NoSamples);
        }
        let (expected, got) = (robot.joint_count(), samples.joints());
        if expected != got {
            return Err(LearnerError::WrongJoints { expected, got });
        }
        let mut before = 0;
        samples.blocks(&mut |block| {
            block.check_behind(before)?;
            before += block.len();
            Ok(())
        })?;
        memory::check(settings.points.min(samples.len()), expected)?;
        let few = samples.thin(settings.points)?;
        let inputs = ProcessInputs::new(&few, settings.direction_speeds.clone());
        let points = inputs.points(&few);
        let (regression, named, kernels) = (None, None, BTreeMap::new());
        let all = samples;
        Ok(Self {
            robot,
            settings,
            progress,
            all,
            few,
            inputs,
            points,
            rest_speed,
            regression,
            named,
            kernels,
        })
    }

    /// Gives the rigid-body parameters that models with a rigid-body mean start from.
    #[must_use]
    pub fn with_regression(mut self, regression: &'a RigidBodyFit) -> Self {
        self.regression = Some(regression);
        self
    }

    /// Gives the robot extended by named effects.
    #[must_use]
    pub fn with_named(mut self, named: &'a Robot) -> Self {
        self.named = Some(named);
        self
    }

    /// Number of points that exact processes are conditioned on.
    pub fn points(&self) -> usize {
        self.few.len()
    }

    /// Trains a model.
    ///
    /// # Errors
    ///
    /// [`LearnerError::Missing`] when the model needs a regression or named effects that were
    /// not given, and what the Gaussian process refuses.
    pub fn fit(&mut self, kind: ModelKind) -> Result<TrainedModel, LearnerError> {
        match kind {
            ModelKind::Cad | ModelKind::Named => self.described_robot(kind),
            ModelKind::Rbd => self.rigid_bodies(),
            ModelKind::RbdConsistent => self.consistent_rigid_bodies(),
            ModelKind::Gp | ModelKind::GpRbd | ModelKind::NamedGp => self.about_fixed_mean(kind),
            ModelKind::GpRbdPrior => self.with_prior(),
            ModelKind::GpRbdShared => self.with_shared_prior(),
            ModelKind::RbdKernel => self.rigid_body_kernel(),
            ModelKind::RbdKernelJoint => self.rigid_body_kernel_jointly(),
            ModelKind::GpInducing | ModelKind::GpRbdInducing | ModelKind::NamedGpInducing => {
                self.by_inducing_points(kind)
            }
        }
    }

    /// A description of the robot as a model.
    fn described_robot(&self, kind: ModelKind) -> Result<TrainedModel, LearnerError> {
        self.mean_alone(kind, self.mean(kind)?)
    }

    /// A mean as a model; its noise is the mean square of the residuals at the points.
    fn mean_alone(&self, kind: ModelKind, mean: Mean) -> Result<TrainedModel, LearnerError> {
        let n = self.few.len() as f64;
        let left = self.residuals(&mean);
        let noise = left.iter().map(|r| r.iter().map(|r| r * r).sum::<f64>() / n).collect();
        let model = Model::new(kind, self.robot, mean, noise);
        Ok(TrainedModel { model, joints: Vec::new(), log_likelihood: None })
    }

    fn rigid_bodies(&self) -> Result<TrainedModel, LearnerError> {
        let kind = ModelKind::Rbd;
        let fit = self.regression(kind)?;
        let noise = fit.noise.iter().map(|noise| noise.standard_deviation.powi(2)).collect();
        let mut model = Model::new(kind, self.robot, self.mean(kind)?, noise);
        let width = fit.covariance.nrows();
        let covariance = Mat::from_fn(width, width, |i, j| fit.covariance[(i, j)]);
        model.weights = vec![covariance; self.robot.joint_count()];
        Ok(TrainedModel { model, joints: Vec::new(), log_likelihood: None })
    }

    /// The physical links nearest to the regression; undetermined directions stay as described. The
    /// noise is the mean square of the residuals at the points.
    fn consistent_rigid_bodies(&self) -> Result<TrainedModel, LearnerError> {
        let kind = ModelKind::RbdConsistent;
        let found = self.regression(kind)?.consistent(self.robot, PRIOR_WEIGHT)?;
        let beta = vec![found.parameters; self.robot.joint_count()];
        self.mean_alone(kind, Mean::Columns { set: self.columns(), beta })
    }

    pub(crate) fn regression(&self, kind: ModelKind) -> Result<&'a RigidBodyFit, LearnerError> {
        let what = "the regression of the rigid-body parameters";
        self.regression.ok_or(LearnerError::Missing { model: kind.name(), what })
    }

    /// The columns of the rigid-body part.
    pub(crate) fn columns(&self) -> ColumnSet {
        self.regression.map_or(ColumnSet::INERTIAL, |fit| ColumnSet::of(&fit.columns))
    }

    /// The mean that the process of a model is about.
    pub(crate) fn mean(&self, kind: ModelKind) -> Result<Mean, LearnerError> {
        let described = |robot: &Robot| {
            Mean::Robot(Box::new(RobotTorque::new(robot.clone(), self.rest_speed.clone())))
        };
        Ok(match kind {
            ModelKind::Gp
            | ModelKind::GpInducing
            | ModelKind::RbdKernel
            | ModelKind::RbdKernelJoint => Mean::Zero,
            ModelKind::Cad => described(self.robot),
            ModelKind::Named | ModelKind::NamedGp | ModelKind::NamedGpInducing => {
                let what = "the robot with its named effects (extended.toml)";
                let missing = LearnerError::Missing { model: kind.name(), what };
                described(self.named.ok_or(missing)?)
            }
            ModelKind::Rbd
            | ModelKind::RbdConsistent
            | ModelKind::GpRbd
            | ModelKind::GpRbdPrior
            | ModelKind::GpRbdShared
            | ModelKind::GpRbdInducing => {
                let fit = self.regression(kind)?;
                let beta = vec![fit.parameters.clone(); self.robot.joint_count()];
                Mean::Columns { set: self.columns(), beta }
            }
        })
    }

    /// Torque of the points minus `mean`, one row a joint.
    pub(crate) fn residuals(&self, mean: &Mean) -> Vec<Vec<f64>> {
        residuals(self.robot, mean, &self.few)
    }

    /// The kernels of all joints for what the mean of `kind` leaves; searched for once.
    pub(crate) fn kernels(&mut self, kind: ModelKind) -> Result<Vec<LearnedKernel>, LearnerError> {
        let mean = self.mean(kind)?;
        let name = match &mean {
            Mean::Zero => "zero",
            Mean::Columns { .. } => "rigid bodies",
            Mean::Robot(_) => "named effects",
        };
        if let Some(known) = self.kernels.get(name) {
            return Ok(known.clone());
        }
        let targets = self.residuals(&mean);
        let search = &self.settings.search;
        let width = self.inputs.width();
        let found = kernels::search(search, &self.points, width, &targets, self.progress)?;
        Ok(self.kernels.entry(name).or_insert(found).clone())
    }
}

/// Torque of `samples` minus `mean`, one row a joint.
pub(crate) fn residuals(robot: &Robot, mean: &Mean, samples: &Samples) -> Vec<Vec<f64>> {
    let joints = robot.joint_count();
    let model = Model::new(ModelKind::Cad, robot, mean.clone(), vec![0.0; joints]);
    let expected = model.torque(samples);
    let measured = (0..samples.len()).flat_map(|i| samples.tau(i));
    let left: Vec<f64> = measured.zip(&expected).map(|(tau, e)| tau - e).collect();
    (0..joints).map(|k| left.iter().skip(k).step_by(joints).copied().collect()).collect()
}

/// Rows of the regressor with the columns of `set`, row-major, one matrix a joint.
pub(crate) fn features(robot: &Robot, set: ColumnSet, samples: &Samples) -> Vec<Vec<f64>> {
    let joints = robot.joint_count();
    let dynamics = Dynamics::new(robot);
    let (mut ws, width) = (dynamics.workspace(), set.columns(joints).len());
    let mut rows = vec![0.0; joints * width];
    let mut features = vec![Vec::with_capacity(samples.len() * width); joints];
    for i in 0..samples.len() {
        let state = samples.state(i);
        dynamics.columns_into(&mut ws, [state.q, state.qd, state.qdd], set, &mut rows);
        let rows = rows.chunks_exact(width);
        features.iter_mut().zip(rows).for_each(|(f, row)| f.extend_from_slice(row));
    }
    features
}
