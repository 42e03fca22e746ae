use crate::error::{GpError, check};
use crate::kernel::GaussianKernel;
use crate::likelihood::{Likelihood, LikelihoodValue};
use crate::maximise;
use crate::maximise::{Maximum, Objective, SearchEnd, SearchWatch};

/// Bounds of the hyperparameters, as shares of the mean square of the targets and, for length
/// scales, in standard deviations of the inputs. Values beyond the bounds have the same effect as
/// the bounds: an input with a length scale of a hundred standard deviations does not matter, and a
/// noise of a millionth of the signal is below the rounding of an ill-conditioned covariance.
const SIGNAL: (f64, f64) = (1e-4, 1e4);
const LENGTH: (f64, f64) = (0.05, 200.0);
const NOISE: (f64, f64) = (1e-6, 10.0);

/// Length scale, in units of the square root of the number of inputs, and noise share that
/// the searches start from: smooth with some noise, rough with little, very smooth with much.
const STARTS: [(f64, f64); 3] = [(1.0, 1e-2), (0.4, 1e-3), (2.5, 1e-1)];

/// Mean square of the targets below which they count as zero.
const SILENT: f64 = 1e-200;

/// How hyperparameters are searched for.
#[derive(Debug, Clone, PartialEq)]
pub struct KernelSearch {
    /// Starting points, at most three.
    pub starts: usize,
    /// Points on which the starts are compared, thinned evenly.
    pub start_points: usize,
    /// Iterations on all points from the best start.
    pub iterations: usize,
}

impl Default for KernelSearch {
    fn default() -> Self {
        Self { starts: 3, start_points: 600, iterations: 200 }
    }
}

/// Hyperparameters that maximise the marginal likelihood.
#[derive(Debug, Clone, PartialEq)]
pub struct LearnedKernel {
    /// The kernel.
    pub kernel: GaussianKernel,
    /// `sigma_n²`.
    pub noise_variance: f64,
    /// `log p(y | X)`.
    pub log_likelihood: f64,
    /// Evaluations on all points.
    pub evaluations: usize,
    /// Iterations on all points.
    pub iterations: usize,
    /// How the search on all points ended.
    pub end: SearchEnd,
    /// Names of the hyperparameters that ended at a bound.
    pub at_bounds: Vec<String>,
    /// Evaluations whose covariance needed jitter to be positive definite, and the largest jitter
    /// added to its diagonal.
    pub jitter: (usize, f64),
    /// Log likelihood that each start reached on the thinned points.
    pub starts: Vec<f64>,
}

impl KernelSearch {
    /// Searches for the hyperparameters of a zero-mean process behind `targets`, by L-BFGS-B
    /// on their logarithms: first from several starts on a subset, then from the best of
    /// these on all points. Inputs (row-major, `width` a point) should be standardised.
    ///
    /// # Errors
    ///
    /// [`GpError`] for input that cannot be used.
    pub fn run(
        &self,
        inputs: &[f64],
        width: usize,
        targets: &[f64],
        watch: &SearchWatch,
    ) -> Result<LearnedKernel, GpError> {
        check("targets", targets, targets.len())?;
        let subset = thin(inputs, width, targets, self.start_points);
        let power = targets.iter().map(|y| y * y).sum::<f64>() / targets.len().max(1) as f64;
        // Targets that are all zero have no scale of their own.
        let power = if power > SILENT { power } else { 1.0 };
        let bounds = bounds(width, power);
        let mut few = Climb::new(&subset.0, width, &subset.1)?;
        let mut tops: Vec<Maximum> = Vec::new();
        for (length, noise) in STARTS.into_iter().take(self.starts.max(1)) {
            let length = (length * (width as f64).sqrt()).ln();
            let mut theta = vec![length; width + 2];
            theta[0] = bounds[0].0.midpoint(bounds[0].1);
            theta[width + 1] = (noise * power).ln();
            tops.push(few.maximise(&theta, &bounds, self.iterations, watch)?);
        }
        let starts = tops.iter().map(|t| t.value).collect();
        let best = tops.into_iter().max_by(|a, b| a.value.total_cmp(&b.value));
        let Some(best) = best else { return Err(GpError::NoPoints) };
        let mut all = Climb::new(inputs, width, targets)?;
        let top = all.maximise(&best.at, &bounds, self.iterations, watch)?;
        let (kernel, noise_variance) = hyperparameters(&top.at);
        Ok(LearnedKernel {
            kernel,
            noise_variance,
            log_likelihood: top.value,
            evaluations: top.evaluations,
            iterations: top.iterations,
            end: top.end,
            at_bounds: at_bounds(&top.at, &bounds),
            jitter: all.jitter,
            starts,
        })
    }
}

/// The likelihood as a function of the logarithms of the hyperparameters.
struct Climb<'a> {
    likelihood: Likelihood,
    targets: &'a [f64],
    jitter: (usize, f64),
}

impl<'a> Climb<'a> {
    fn new(inputs: &[f64], width: usize, targets: &'a [f64]) -> Result<Self, GpError> {
        check("inputs", inputs, width * targets.len())?;
        Ok(Self { likelihood: Likelihood::new(inputs, width)?, targets, jitter: (0, 0.0) })
    }

    fn maximise(
        &mut self,
        start: &[f64],
        bounds: &[(f64, f64)],
        iterations: usize,
        watch: &SearchWatch,
    ) -> Result<Maximum, GpError> {
        let objective: &mut Objective = &mut |theta, slope| {
            let (kernel, noise) = hyperparameters(theta);
            let LikelihoodValue { log_likelihood, jitter, .. } =
                self.likelihood.evaluate(self.targets, &kernel, noise, slope)?;
            if jitter > 0.0 {
                self.jitter = (self.jitter.0 + 1, self.jitter.1.max(jitter));
            }
            Ok(log_likelihood)
        };
        maximise(objective, start, bounds, iterations, watch)
    }
}

/// Logarithms of signal variance, length scales, noise variance, in this order.
fn hyperparameters(theta: &[f64]) -> (GaussianKernel, f64) {
    let last = theta.len() - 1;
    let length_scales = theta[1..last].iter().map(|t| t.exp()).collect();
    (GaussianKernel { signal_variance: theta[0].exp(), length_scales }, theta[last].exp())
}

fn bounds(width: usize, power: f64) -> Vec<(f64, f64)> {
    let of = |(low, high): (f64, f64), unit: f64| ((low * unit).ln(), (high * unit).ln());
    let lengths = std::iter::repeat_n(of(LENGTH, 1.0), width);
    std::iter::once(of(SIGNAL, power)).chain(lengths).chain([of(NOISE, power)]).collect()
}

/// Names of those of `theta` that lie at one of their bounds.
fn at_bounds(theta: &[f64], bounds: &[(f64, f64)]) -> Vec<String> {
    const NEAR: f64 = 1e-6;
    let last = theta.len() - 1;
    let name = |i: usize, end: &str| match i {
        0 => format!("signal variance at its {end} bound"),
        i if i == last => format!("noise variance at its {end} bound"),
        i => format!("length scale {i} at its {end} bound"),
    };
    let ended = |(i, (t, (low, high))): (usize, (&f64, &(f64, f64)))| match t {
        t if t - low < NEAR => Some(name(i, "lower")),
        t if high - t < NEAR => Some(name(i, "upper")),
        _ => None,
    };
    theta.iter().zip(bounds).enumerate().filter_map(ended).collect()
}

/// At most `points` rows, evenly spread.
fn thin(inputs: &[f64], width: usize, targets: &[f64], points: usize) -> (Vec<f64>, Vec<f64>) {
    let n = targets.len();
    let count = points.clamp(1, n.max(1)).min(n);
    let rows = (0..count).map(|i| i * n / count);
    let kept = rows.clone().filter_map(|i| inputs.get(i * width..(i + 1) * width));
    (kept.flatten().copied().collect(), rows.map(|i| targets[i]).collect())
}
