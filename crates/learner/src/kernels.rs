use std::ops::ControlFlow;

use gaussian_process::{KernelSearch, LearnedKernel, WhiteSums, maximise};

use crate::error::LearnerError;
use crate::progress::TrainingProgress;

/// How far a search may take a prior variance from where it starts, as a natural logarithm:
/// a factor of a million each way, which is as good as a weight held and a weight free.
const REACH: f64 = 14.0;

/// Mean square of the targets below which they count as zero.
const SILENT: f64 = 1e-200;

/// Iterations for a linear part, whose evaluations cost little.
const ITERATIONS: usize = 500;

/// Hyperparameters of the kernel of every joint for `targets`, one row a joint.
pub(crate) fn search(
    search: &KernelSearch,
    points: &[f64],
    width: usize,
    targets: &[Vec<f64>],
    progress: &dyn TrainingProgress,
) -> Result<Vec<LearnedKernel>, LearnerError> {
    let joints = targets.iter().enumerate();
    joints
        .map(|(k, y)| {
            progress.stage(&format!("kernel of joint {}", k + 1));
            Ok(search.run(points, width, y, &|count, best| progress.evaluation(count, best))?)
        })
        .collect()
}

/// The rigid-body kernel of one joint: `W` and the noise variance that maximise the marginal
/// likelihood of equation 8 of Nguyen-Tuong & Peters 2010.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct RigidBodyKernel {
    /// Diagonal of `W`; zero for columns that the joint does not see.
    pub variances: Vec<f64>,
    /// `sigma_k²`.
    pub noise_variance: f64,
    /// Mean of the weights after the data.
    pub mean: Vec<f64>,
}

/// Searches for the rigid-body kernel of one joint.
pub(crate) fn rigid_body_kernel(
    features: &[f64],
    width: usize,
    targets: &[f64],
    progress: &dyn TrainingProgress,
) -> Result<RigidBodyKernel, LearnerError> {
    let sums = WhiteSums::new(features, width, targets)?;
    let n = targets.len().max(1) as f64;
    // Targets that are all zero have no scale of their own.
    let power = if sums.square > SILENT { sums.square / n } else { 1.0 };
    let seen: Vec<usize> = (0..width).filter(|&j| sums.gram[(j, j)] > 0.0).collect();
    // Every column starts with the same share of the power.
    let start = seen.iter().map(|&j| power / (seen.len() as f64 * sums.gram[(j, j)] / n));
    let mut start: Vec<f64> = start.map(f64::ln).collect();
    let mut bounds: Vec<_> = start.iter().map(|s| (s - REACH, s + REACH)).collect();
    start.push((1e-2 * power).ln());
    bounds.push(((1e-9 * power).ln(), (10.0 * power).ln()));
    let spread = |theta: &[f64]| {
        let mut variances = vec![0.0; width];
        seen.iter().zip(theta).for_each(|(&j, t)| variances[j] = t.exp());
        (variances, theta[seen.len()].exp())
    };
    let mut objective = |theta: &[f64], slope: &mut [f64]| {
        let (variances, noise) = spread(theta);
        let mut all = vec![0.0; width + 1];
        let value = sums.evaluate(&variances, noise, &mut all)?;
        let kept = seen.iter().copied().chain([width]);
        slope.iter_mut().zip(kept).for_each(|(slope, j)| *slope = all[j]);
        Ok(value)
    };
    let watch = |count, best| progress.evaluation(count, best);
    let maximum = maximise(&mut objective, &start, &bounds, ITERATIONS, &watch)?;
    let (variances, noise_variance) = spread(&maximum.at);
    let mean = sums.evidence(noise_variance).posterior(&variances)?.change;
    Ok(RigidBodyKernel { variances, noise_variance, mean })
}

/// Prior variances that maximise the evidence of a linear part, from `start`; zeros stay.
pub(crate) fn prior_by_evidence(
    evidence: &gaussian_process::LinearEvidence,
    start: &[f64],
    watch: &dyn Fn(usize, f64) -> ControlFlow<()>,
) -> Result<Vec<f64>, LearnerError> {
    let free: Vec<usize> = (0..start.len()).filter(|&j| start[j] > 0.0).collect();
    let theta: Vec<f64> = free.iter().map(|&j| start[j].ln()).collect();
    let bounds: Vec<_> = theta.iter().map(|t| (t - REACH, t + REACH)).collect();
    let spread = |theta: &[f64]| {
        let mut variances = vec![0.0; start.len()];
        free.iter().zip(theta).for_each(|(&j, t)| variances[j] = t.exp());
        variances
    };
    let mut objective = |theta: &[f64], slope: &mut [f64]| {
        let mut all = vec![0.0; start.len()];
        let value = evidence.evaluate(&spread(theta), &mut all)?;
        slope.iter_mut().zip(&free).for_each(|(slope, &j)| *slope = all[j]);
        Ok(value)
    };
    let maximum = maximise(&mut objective, &theta, &bounds, ITERATIONS, watch)?;
    Ok(spread(&maximum.at))
}
