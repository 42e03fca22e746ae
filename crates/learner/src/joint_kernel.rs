use gaussian_process::{
    Covariance, GaussianKernel, LearnedKernel, Likelihood, Linear, Objective, SearchEnd, maximise,
};

use crate::error::LearnerError;
use crate::exact::WeightedJoint;
use crate::kernels::rigid_body_kernel;
use crate::model::Mean;
use crate::model_kind::ModelKind;
use crate::training::{JointFit, TrainedModel, Training, features};

/// How far each hyperparameter may move from where the parts alone have it, as a natural
/// logarithm: a factor of some thousand each way.
const REACH: f64 = 8.0;

impl Training<'_> {
    /// Equations 8 to 10 with all hyperparameters, of `phi' W phi + k + noise`, optimised
    /// jointly on the marginal likelihood of the whole. The search starts from the
    /// rigid-body kernel alone, and from the Gaussian kernel of what its mean leaves.
    pub(crate) fn rigid_body_kernel_jointly(&mut self) -> Result<TrainedModel, LearnerError> {
        let kind = ModelKind::RbdKernelJoint;
        let set = self.columns();
        let width = set.columns(self.robot.joint_count()).len();
        let features = features(self.robot, set, &self.few);
        let targets = self.residuals(&Mean::Zero);
        let (mut joints, origin) = (Vec::new(), vec![0.0; width]);
        for (k, (phi, y)) in features.iter().zip(&targets).enumerate() {
            self.progress.stage(&format!("kernels of joint {} together", k + 1));
            let (found, variances) = self.joint_search(phi, width, y)?;
            let linear = Linear { features: phi, mean: &origin };
            let hyper = (found.kernel.clone(), found.noise_variance);
            let joint = self.condition(hyper, y, linear)?;
            let posterior = joint.residual.evidence.posterior(&variances)?;
            let log_likelihood = Some(posterior.log_likelihood);
            let fit = JointFit { log_likelihood, kernel: Some(found), ..JointFit::default() };
            joints.push(WeightedJoint { joint, posterior, fit });
        }
        self.fit_of_weights(kind, &origin, joints, features)
    }

    /// The Gaussian kernel with its noise, and the diagonal of `W`, of one joint.
    fn joint_search(
        &self,
        features: &[f64],
        width: usize,
        targets: &[f64],
    ) -> Result<(LearnedKernel, Vec<f64>), LearnerError> {
        let watch = |count, best| self.progress.evaluation(count, best);
        let rigid = rigid_body_kernel(features, width, targets, self.progress)?;
        let seen: Vec<usize> = (0..width).filter(|&j| rigid.variances[j] > 0.0).collect();
        let rows = features.chunks_exact(width);
        let left: Vec<f64> =
            targets.iter().zip(rows).map(|(y, row)| y - dot(row, &rigid.mean)).collect();
        let inputs = self.inputs.width();
        let mut found = self.settings.search.run(&self.points, inputs, &left, &watch)?;

        // Logarithms of signal variance, length scales, noise variance and weights.
        let kernel = &found.kernel;
        let alone = [kernel.signal_variance].into_iter().chain(kernel.length_scales.clone());
        let weights = seen.iter().map(|&j| rigid.variances[j]);
        let start = alone.chain([found.noise_variance]).chain(weights);
        let start: Vec<f64> = start.map(f64::ln).collect();
        let bounds: Vec<_> = start.iter().map(|s| (s - REACH, s + REACH)).collect();
        let kept: Vec<f64> =
            features.chunks_exact(width).flat_map(|row| seen.iter().map(|&j| row[j])).collect();
        let mut likelihood =
            Likelihood::new(&self.points, inputs)?.with_features(&kept, seen.len())?;
        let objective: &mut Objective = &mut |theta, slope| {
            let (kernel, noise_variance, weights) = split(theta, inputs);
            let covariance = Covariance { kernel: &kernel, noise_variance, weights: &weights };
            Ok(likelihood.evaluate_with_features(targets, &covariance, slope)?.log_likelihood)
        };
        let top = maximise(objective, &start, &bounds, self.settings.search.iterations, &watch)?;
        let (kernel, noise_variance, weights) = split(&top.at, inputs);
        let mut variances = vec![0.0; width];
        seen.iter().zip(weights).for_each(|(&j, w)| variances[j] = w);
        let stopped = found.end == SearchEnd::Stopped;
        found = LearnedKernel {
            kernel,
            noise_variance,
            log_likelihood: top.value,
            evaluations: top.evaluations,
            iterations: top.iterations,
            end: if stopped { SearchEnd::Stopped } else { top.end },
            ..found
        };
        Ok((found, variances))
    }
}

fn split(theta: &[f64], inputs: usize) -> (GaussianKernel, f64, Vec<f64>) {
    let exp = |part: &[f64]| part.iter().map(|t| t.exp()).collect::<Vec<_>>();
    let length_scales = exp(&theta[1..=inputs]);
    let kernel = GaussianKernel { signal_variance: theta[0].exp(), length_scales };
    (kernel, theta[inputs + 1].exp(), exp(&theta[inputs + 2..]))
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}
