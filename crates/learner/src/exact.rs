use gaussian_process::{
    GaussianKernel, Inverse, KernelSum, LearnedKernel, Likelihood, Linear, LinearEvidence,
    LinearPosterior, ResidualProcess,
};

use crate::error::LearnerError;
use crate::kernels::{prior_by_evidence, rigid_body_kernel};
use crate::model::{Mean, Model, Process};
use crate::model_kind::ModelKind;
use crate::nominal_parameter::size;
use crate::rigid_body_fit::RigidBodyFit;
use crate::settings::PriorSpread;
use crate::spread::Spread;
use crate::training::{JointFit, TrainedModel, Training, features};

/// One joint, conditioned on the points. The weights of its linear part are still open.
pub(crate) struct JointPosterior {
    kernel: GaussianKernel,
    noise_variance: f64,
    inverse: Inverse,
    pub residual: ResidualProcess,
}

/// All joints, conditioned about the rigid bodies.
struct RigidBodyPart {
    joints: Vec<JointPosterior>,
    /// `Phi` of every joint, row-major.
    features: Vec<Vec<f64>>,
    kernels: Vec<LearnedKernel>,
}

/// One joint and the weights of its linear part.
pub(crate) struct WeightedJoint {
    pub joint: JointPosterior,
    pub posterior: LinearPosterior,
    pub fit: JointFit,
}

/// One joint with the final weights of its points.
struct FinalJoint {
    joint: JointPosterior,
    alpha: Vec<f64>,
    fit: JointFit,
}

impl Training<'_> {
    /// Conditions joint `k` on the points.
    pub(crate) fn condition(
        &self,
        (kernel, noise_variance): (GaussianKernel, f64),
        targets: &[f64],
        linear: Linear,
    ) -> Result<JointPosterior, LearnerError> {
        let likelihood = Likelihood::new(&self.points, self.inputs.width())?;
        let inverse = likelihood.condition(&kernel, noise_variance)?;
        let residual = ResidualProcess::new(&inverse, targets, linear)?;
        Ok(JointPosterior { kernel, noise_variance, inverse, residual })
    }

    /// A process about a fixed mean.
    pub(crate) fn about_fixed_mean(
        &mut self,
        kind: ModelKind,
    ) -> Result<TrainedModel, LearnerError> {
        let kernels = self.kernels(kind)?;
        let mean = self.mean(kind)?;
        let targets = self.residuals(&mean);
        self.progress.stage(&format!("conditioning {kind}"));
        let mut finals = Vec::new();
        for (found, y) in kernels.into_iter().zip(&targets) {
            let joint = self.condition(hyperparameters(&found), y, Linear::NONE)?;
            let log_likelihood = Some(joint.residual.evidence.without);
            let fit = JointFit { log_likelihood, kernel: Some(found), ..JointFit::default() };
            finals.push(FinalJoint { alpha: joint.residual.alpha.clone(), joint, fit });
        }
        self.assemble(kind, mean, finals, Vec::new())
    }

    /// Every joint about the rigid bodies, with their columns as linear part.
    fn about_rigid_bodies(&mut self, kind: ModelKind) -> Result<RigidBodyPart, LearnerError> {
        let kernels = self.kernels(kind)?;
        let fit = self.regression(kind)?;
        let features = features(self.robot, self.columns(), &self.few);
        self.progress.stage(&format!("conditioning {kind}"));
        let targets = self.residuals(&Mean::Zero);
        let mut joints = Vec::new();
        let (mean, _) = self.prior(fit);
        for ((found, y), phi) in kernels.iter().zip(&targets).zip(&features) {
            let linear = Linear { features: phi, mean: &mean };
            joints.push(self.condition(hyperparameters(found), y, linear)?);
        }
        Ok(RigidBodyPart { joints, features, kernels })
    }

    /// Mean and variances of the prior on the rigid-body parameters, before any evidence. It is a
    /// prior on base parameters: dependent columns have zero mean and variance.
    fn prior(&self, fit: &RigidBodyFit) -> (Vec<f64>, Vec<f64>) {
        let (base, covariance) = fit.base_parameters();
        let width = fit.columns.len();
        let (mut mean, mut variances) = (vec![0.0; width], vec![0.0; width]);
        for (i, &column) in fit.base.independent.iter().enumerate() {
            mean[column] = base[i];
            variances[column] = match self.settings.prior {
                PriorSpread::StandardErrors | PriorSpread::Evidence => covariance[(i, i)],
                PriorSpread::Share(share) => {
                    let typical = size(self.robot, fit.columns[column]);
                    (share * base[i].abs().max(typical)).powi(2)
                }
            };
        }
        (mean, variances)
    }

    /// The prior variances that the settings ask for, given the evidence.
    fn prior_variances(
        &self,
        evidence: &LinearEvidence,
        prior: &[f64],
    ) -> Result<Vec<f64>, LearnerError> {
        match self.settings.prior {
            PriorSpread::Evidence => prior_by_evidence(evidence, prior, &|count, best| {
                self.progress.evaluation(count, best)
            }),
            PriorSpread::StandardErrors | PriorSpread::Share(_) => Ok(prior.to_vec()),
        }
    }

    /// Equation 7, parameters of every joint's own.
    pub(crate) fn with_prior(&mut self) -> Result<TrainedModel, LearnerError> {
        let kind = ModelKind::GpRbdPrior;
        let part = self.about_rigid_bodies(kind)?;
        let (_, prior) = self.prior(self.regression(kind)?);
        let mut posteriors = Vec::new();
        for joint in &part.joints {
            let variances = self.prior_variances(&joint.residual.evidence, &prior)?;
            posteriors.push(joint.residual.evidence.posterior(&variances)?);
        }
        self.about_posterior(kind, part, &posteriors)
    }

    /// Equation 7, one set of parameters for all `n` joints:
    ///
    /// ```text
    /// beta_bar = (n B^-1 + sum_k Phi_k' K_k^-1 Phi_k)^-1 (sum_k Phi_k' K_k^-1 y_k + n B^-1 beta)
    /// ```
    pub(crate) fn with_shared_prior(&mut self) -> Result<TrainedModel, LearnerError> {
        let kind = ModelKind::GpRbdShared;
        let part = self.about_rigid_bodies(kind)?;
        let mut all = part.joints.iter().map(|joint| &joint.residual.evidence);
        let Some(mut together) = all.next().cloned() else { return Err(LearnerError::NoSamples) };
        for one in all {
            together.information += &one.information;
            together.score.iter_mut().zip(&one.score).for_each(|(s, o)| *s += o);
            together.without += one.without;
        }
        let n = part.joints.len() as f64;
        let (_, prior) = self.prior(self.regression(kind)?);
        let prior: Vec<f64> = prior.iter().map(|b| b / n).collect();
        let posterior = together.posterior(&self.prior_variances(&together, &prior)?)?;
        let log_likelihood = Some(posterior.log_likelihood);
        let shared = vec![posterior; part.joints.len()];
        let mut fitted = self.about_posterior(kind, part, &shared)?;
        fitted.joints.iter_mut().for_each(|joint| joint.log_likelihood = None);
        fitted.log_likelihood = log_likelihood;
        Ok(fitted)
    }

    /// The model with the posterior rigid-body parameters.
    fn about_posterior(
        &self,
        kind: ModelKind,
        part: RigidBodyPart,
        posteriors: &[LinearPosterior],
    ) -> Result<TrainedModel, LearnerError> {
        let (origin, _) = self.prior(self.regression(kind)?);
        let joints = part.joints.into_iter().zip(posteriors).zip(part.kernels);
        let joints = joints.map(|((joint, posterior), found)| {
            let log_likelihood = Some(posterior.log_likelihood);
            let fit = JointFit { log_likelihood, kernel: Some(found), ..JointFit::default() };
            WeightedJoint { joint, posterior: posterior.clone(), fit }
        });
        self.fit_of_weights(kind, &origin, joints.collect(), part.features)
    }

    /// The model whose linear part has the weights `origin` plus their change by the data.
    pub(crate) fn fit_of_weights(
        &self,
        kind: ModelKind,
        origin: &[f64],
        joints: Vec<WeightedJoint>,
        features: Vec<Vec<f64>>,
    ) -> Result<TrainedModel, LearnerError> {
        let beta = |change: &[f64]| origin.iter().zip(change).map(|(b, c)| b + c).collect();
        let beta = joints.iter().map(|joint| beta(&joint.posterior.change)).collect();
        let mean = Mean::Columns { set: self.columns(), beta };
        let weights = joints.iter().map(|joint| joint.posterior.covariance.clone()).collect();
        let finals = joints.into_iter().map(|WeightedJoint { joint, posterior, fit }| {
            let alpha = joint.residual.alpha(&posterior.change);
            FinalJoint { joint, alpha, fit }
        });
        let mut fitted = self.assemble(kind, mean, finals.collect(), features)?;
        fitted.model.weights = weights;
        Ok(fitted)
    }

    /// Equations 8 to 10: `phi' W phi + lambda k`, the two kernels searched for apart, lambda
    /// by cross-validation over stretches of time.
    pub(crate) fn rigid_body_kernel(&mut self) -> Result<TrainedModel, LearnerError> {
        let kind = ModelKind::RbdKernel;
        let kernels = self.kernels(kind)?;
        let set = self.columns();
        let features = features(self.robot, set, &self.few);
        let width = set.columns(self.robot.joint_count()).len();
        let targets = self.residuals(&Mean::Zero);
        let origin = vec![0.0; width];
        let mut joints = Vec::new();
        for (k, found) in kernels.into_iter().enumerate() {
            self.progress.stage(&format!("rigid-body kernel of joint {}", k + 1));
            let (phi, y) = (&features[k], &targets[k]);
            let rigid = rigid_body_kernel(phi, width, y, self.progress)?;
            let linear = Linear { features: phi, mean: &origin };
            let mut best: Option<(f64, f64, JointPosterior, LinearPosterior)> = None;
            let mut held_out = Vec::new();
            for &lambda in &self.settings.lambdas {
                let mut kernel = found.kernel.clone();
                kernel.signal_variance *= lambda;
                let joint = self.condition((kernel, rigid.noise_variance), y, linear)?;
                let posterior = joint.residual.evidence.posterior(&rigid.variances)?;
                let folds = self.settings.folds;
                let square = joint.residual.held_out_square(&joint.inverse, &posterior, folds)?;
                held_out.push(square.sqrt());
                if best.as_ref().is_none_or(|(least, ..)| square < *least) {
                    best = Some((square, lambda, joint, posterior));
                }
            }
            let Some((_, lambda, joint, posterior)) = best else {
                return Err(LearnerError::NoSamples);
            };
            let fit = JointFit {
                log_likelihood: Some(posterior.log_likelihood),
                kernel: Some(found),
                lambda: Some(lambda),
                held_out,
            };
            joints.push(WeightedJoint { joint, posterior, fit });
        }
        self.fit_of_weights(kind, &origin, joints, features)
    }

    /// Assembles the model from its joints.
    fn assemble(
        &self,
        kind: ModelKind,
        mean: Mean,
        finals: Vec<FinalJoint>,
        features: Vec<Vec<f64>>,
    ) -> Result<TrainedModel, LearnerError> {
        let (mut kernels, mut alpha, mut noise) = (Vec::new(), Vec::new(), Vec::new());
        let (mut inverse, mut joints) = (Vec::new(), Vec::new());
        for FinalJoint { joint, alpha: weights, fit } in finals {
            kernels.push(joint.kernel);
            alpha.push(weights);
            noise.push(joint.noise_variance);
            inverse.push(joint.inverse);
            joints.push(fit);
        }
        let sum = KernelSum::new(&self.points, self.inputs.width(), &kernels, &alpha)?;
        let spread = Some(Spread::Exact { inverse, features });
        let mut model = Model::new(kind, self.robot, mean, noise);
        model.process = Some(Process { inputs: self.inputs.clone(), sum, spread });
        let log_likelihood = joints.iter().map(|joint| joint.log_likelihood).sum();
        Ok(TrainedModel { model, joints, log_likelihood })
    }
}

fn hyperparameters(found: &LearnedKernel) -> (GaussianKernel, f64) {
    (found.kernel.clone(), found.noise_variance)
}
