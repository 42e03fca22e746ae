use gaussian_process::{GaussianKernel, Inducing, KernelSum, inducing_points, shared_kernel};

use crate::error::LearnerError;
use crate::model::{Model, Process};
use crate::model_kind::ModelKind;
use crate::spread::Spread;
use crate::training::{JointFit, TrainedModel, Training, residuals};

/// Candidates for every inducing point.
const CANDIDATES: usize = 3;

impl Training<'_> {
    /// A process conditioned on all samples through inducing points that all joints share. For `m` points it holds `m²`
    /// numbers a joint and one block of samples, however many there are.
    ///
    /// The hyperparameters are those of the exact process on the thinned points; the points
    /// are chosen for the geometric mean of the joints' kernels, since a query over shared
    /// points costs a fraction of one over points of every joint's own.
    pub(crate) fn by_inducing_points(
        &mut self,
        kind: ModelKind,
    ) -> Result<TrainedModel, LearnerError> {
        let kernels = self.kernels(kind)?;
        let mean = self.mean(kind)?;
        self.progress.stage(&format!("inducing points of {kind}"));
        let of_all: Vec<GaussianKernel> = kernels.iter().map(|k| k.kernel.clone()).collect();
        let points = self.shared_points(&of_all)?;
        let per_point = self.all.len() as f64 / self.few.len() as f64;
        let learners =
            kernels.iter().map(|k| Inducing::new(&points, &k.kernel, per_point * k.noise_variance));
        let mut learners = learners.collect::<Result<Vec<_>, _>>()?;
        self.progress.stage(&format!("summing {} samples for {kind}", self.all.len()));
        let (robot, own) = (self.robot, &self.inputs);
        self.all.blocks(&mut |block| {
            let inputs = own.points(block);
            let targets = residuals(robot, &mean, block);
            for (learner, y) in learners.iter_mut().zip(&targets) {
                learner.add(&inputs, y)?;
            }
            Ok(())
        })?;
        let posteriors =
            learners.into_iter().map(Inducing::finish).collect::<Result<Vec<_>, _>>()?;
        let alpha: Vec<Vec<f64>> = posteriors.iter().map(|p| p.alpha.clone()).collect();
        let joints: Vec<JointFit> = kernels
            .iter()
            .map(|found| JointFit { kernel: Some(found.clone()), ..JointFit::default() })
            .collect();
        let sum = KernelSum::new(&points, self.inputs.width(), &of_all, &alpha)?;
        let noise = kernels.iter().map(|k| k.noise_variance).collect();
        let mut model = Model::new(kind, self.robot, mean, noise);
        let spread = Some(Spread::Inducing(posteriors));
        model.process = Some(Process { inputs: self.inputs.clone(), sum, spread });
        Ok(TrainedModel { model, joints, log_likelihood: None })
    }

    fn shared_points(&self, kernels: &[GaussianKernel]) -> Result<Vec<f64>, LearnerError> {
        let count = self.settings.inducing_points;
        let candidates = self.inputs.points(&self.all.thin(CANDIDATES * count)?);
        let kernel = shared_kernel(kernels)?;
        let chosen = inducing_points(&candidates, &kernel, count)?;
        let width = self.inputs.width();
        let rows = chosen.iter().map(|&i| &candidates[i * width..(i + 1) * width]);
        Ok(rows.flatten().copied().collect())
    }
}
