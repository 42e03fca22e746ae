use pulp::Arch;

use crate::error::{GpError, check};
use crate::gram::Gram;
use crate::inverse::Inverse;
use crate::kernel::GaussianKernel;
use crate::packed::Packed;
use crate::panels::{Panels, ROWS};
use crate::{product, sweep};

/// Jitters that are tried in turn until the matrix is positive definite, in units of the signal
/// variance.
const JITTER: [f64; 8] = [0.0, 1e-10, 1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4];

/// The covariance of targets, noise included:
///
/// ```text
/// K_ij = k(x_i, x_j) + sum_m weights[m] phi_m(x_i) phi_m(x_j) + noise_variance [i = j]
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Covariance<'a> {
    /// `k`
    pub kernel: &'a GaussianKernel,
    /// `sigma_n²`, in squared units of the target.
    pub noise_variance: f64,
    /// One for each feature `phi_m` of [`Likelihood::with_features`]; positive.
    pub weights: &'a [f64],
}

/// The value of the likelihood for some hyperparameters.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LikelihoodValue {
    /// `log p(y | X, theta)`
    pub log_likelihood: f64,
    /// Jitter that was added to the diagonal, in squared units of the target; usually zero.
    pub jitter: f64,
    /// Number of jitters that were tried.
    pub jitter_steps: usize,
}

/// Memory for repeated evaluations of the likelihood of hyperparameters at the same points.
///
/// Takes about `4 n²` bytes, one triangle of a matrix ([`Likelihood::bytes`]).
///
/// # Examples
///
/// One point with variance `1 + 3`: `log N(2 | 0, 4) = -1/2 - log(4) / 2 - log(2 pi) / 2`.
///
/// ```
/// use gaussian_process::{GaussianKernel, Likelihood};
///
/// let kernel = GaussianKernel { signal_variance: 1.0, length_scales: vec![1.0] };
/// let mut likelihood = Likelihood::new(&[0.7], 1)?;
/// let mut gradient = [0.0; 3];
/// let evidence = likelihood.evaluate(&[2.0], &kernel, 3.0, &mut gradient)?;
/// let closed = -0.5 - 0.5 * 4.0_f64.ln() - 0.5 * std::f64::consts::TAU.ln();
/// assert!((evidence.log_likelihood - closed).abs() < 1e-14);
/// # Ok::<(), gaussian_process::GpError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Likelihood {
    /// Row-major.
    inputs: Vec<f64>,
    dimensions: usize,
    /// Row-major.
    features: Vec<f64>,
    feature_count: usize,
    /// The covariance, then its inverse.
    matrix: Packed,
    arch: Arch,
}

/// What the inversion of the covariance gave besides the inverse.
struct Inverted {
    log_determinant: f64,
    jitter: f64,
    jitter_steps: usize,
}

impl Likelihood {
    /// For `inputs`, row-major, `dimensions` numbers a point.
    ///
    /// # Errors
    ///
    /// [`GpError::NoPoints`], [`GpError::WrongLength`] when the last row is not full,
    /// [`GpError::NotFinite`].
    pub fn new(inputs: &[f64], dimensions: usize) -> Result<Self, GpError> {
        if inputs.is_empty() || dimensions == 0 {
            return Err(GpError::NoPoints);
        }
        check("inputs", inputs, inputs.len().next_multiple_of(dimensions))?;
        Ok(Self {
            inputs: inputs.to_vec(),
            dimensions,
            features: Vec::new(),
            feature_count: 0,
            matrix: Packed::new(inputs.len() / dimensions),
            arch: Arch::new(),
        })
    }

    /// With `count` features of every point, row-major.
    ///
    /// # Errors
    ///
    /// [`GpError::WrongLength`], [`GpError::NotFinite`].
    pub fn with_features(mut self, features: &[f64], count: usize) -> Result<Self, GpError> {
        check("features", features, self.points() * count)?;
        self.features = features.to_vec();
        self.feature_count = count;
        Ok(self)
    }

    /// Number of points.
    pub fn points(&self) -> usize {
        self.matrix.rows()
    }

    /// Upper bound of the memory that an evaluation takes for so many points (bytes), to check
    /// before it is tried.
    pub fn bytes(points: usize, dimensions: usize, features: usize) -> usize {
        // Inputs and features as given and scaled, features transposed and multiplied.
        let transposed = features.next_multiple_of(ROWS);
        let columns = 2 * dimensions + 3 * features + transposed + sweep::COLUMNS + 2;
        let rows = points.next_multiple_of(ROWS);
        let pivot_block = 3 * sweep::COLUMNS * sweep::COLUMNS;
        size_of::<f64>() * (Packed::numbers(points) + rows * columns + pivot_block)
    }

    /// The log likelihood without features, and its gradient:
    ///
    /// ```text
    /// log p(y | X) = -1/2 y' K^-1 y - 1/2 log det K - n/2 log(2 pi)
    /// d log p / d log theta = 1/2 tr((alpha alpha' - K^-1) dK / d log theta),   alpha = K^-1 y
    /// ```
    ///
    /// for `theta` = signal variance, length scales, noise variance, in this order.
    ///
    /// # Errors
    ///
    /// As [`Likelihood::evaluate_with_features`].
    ///
    /// # Source
    ///
    /// Rasmussen & Williams 2006, equations 2.30 and 5.9.
    pub fn evaluate(
        &mut self,
        targets: &[f64],
        kernel: &GaussianKernel,
        noise_variance: f64,
        gradient: &mut [f64],
    ) -> Result<LikelihoodValue, GpError> {
        let covariance = Covariance { kernel, noise_variance, weights: &[] };
        self.evaluate_with_features(targets, &covariance, gradient)
    }

    /// The log likelihood and its gradient with respect to the logarithms of signal variance,
    /// length scales, noise variance and weights, in this order.
    ///
    /// # Errors
    ///
    /// - [`GpError::WrongLength`]: targets, gradient, length scales or weights do not fit.
    /// - [`GpError::NotFinite`], [`GpError::NotPositive`]: a target or hyperparameter is no
    ///   number to compute with.
    /// - [`GpError::NotPositiveDefinite`]: not even with jitter.
    pub fn evaluate_with_features(
        &mut self,
        targets: &[f64],
        covariance: &Covariance,
        gradient: &mut [f64],
    ) -> Result<LikelihoodValue, GpError> {
        let n = self.points();
        check("targets", targets, n)?;
        let expected = 2 + self.dimensions + self.feature_count;
        if gradient.len() != expected {
            return Err(GpError::WrongLength { vector: "gradient", expected, got: gradient.len() });
        }
        let gram = self.gram(covariance)?;
        let inverted = invert(&gram, covariance, &mut self.matrix)?;

        let mut alpha = vec![0.0; self.matrix.panels() * ROWS];
        product::multiply(&self.matrix, targets, &mut alpha[..n], self.arch);
        let fit = dot(targets, &alpha[..n]);
        let constant = n as f64 * std::f64::consts::TAU.ln();

        // tr(K^-1 - alpha alpha')
        let trace: f64 = self.matrix.diagonal().zip(&alpha).map(|(k, a)| k - a * a).sum();
        let sums = gram.contract(&self.matrix, &alpha);
        gradient[0] = -0.5 * (sums[0] + inverted.jitter * trace);
        let (lengths, rest) = gradient[1..].split_at_mut(self.dimensions);
        for (slope, sum) in lengths.iter_mut().zip(&sums[1..]) {
            *slope = -0.5 * sum;
        }
        rest[0] = -0.5 * covariance.noise_variance * trace;
        if let Some(features) = &gram.features {
            self.weight_slopes(features, &alpha, &mut rest[1..]);
        }
        Ok(LikelihoodValue {
            log_likelihood: -0.5 * (fit + inverted.log_determinant + constant),
            jitter: inverted.jitter,
            jitter_steps: inverted.jitter_steps,
        })
    }

    /// The inverse covariance without features, to predict with.
    ///
    /// # Errors
    ///
    /// As [`Likelihood::evaluate_with_features`].
    pub fn condition(
        self,
        kernel: &GaussianKernel,
        noise_variance: f64,
    ) -> Result<Inverse, GpError> {
        self.condition_with_features(&Covariance { kernel, noise_variance, weights: &[] })
    }

    /// The inverse covariance, to predict with.
    ///
    /// # Errors
    ///
    /// As [`Likelihood::evaluate_with_features`].
    pub fn condition_with_features(mut self, covariance: &Covariance) -> Result<Inverse, GpError> {
        let gram = self.gram(covariance)?;
        let inverted = invert(&gram, covariance, &mut self.matrix)?;
        Ok(Inverse {
            matrix: self.matrix,
            log_determinant: inverted.log_determinant,
            jitter: inverted.jitter,
            arch: self.arch,
        })
    }

    /// What the covariance is made of, from hyperparameters that can be used.
    fn gram(&self, covariance: &Covariance) -> Result<Gram, GpError> {
        self.check(covariance)?;
        let (n, d, p) = (self.points(), self.dimensions, self.feature_count);
        let scales = &covariance.kernel.length_scales;
        let points = Panels::new(n, d, |i, j| self.inputs[i * d + j] / scales[j]);
        check("inputs / length_scales", points.values(), points.values().len())?;
        let roots: Vec<f64> = covariance.weights.iter().map(|w| w.sqrt()).collect();
        let weighted = || Panels::new(n, p, |i, m| self.features[i * p + m] * roots[m]);
        Ok(Gram {
            points,
            features: (p > 0).then(weighted),
            signal_variance: covariance.kernel.signal_variance,
            arch: self.arch,
        })
    }

    fn check(&self, covariance: &Covariance) -> Result<(), GpError> {
        covariance.kernel.check()?;
        check("length_scales", &covariance.kernel.length_scales, self.dimensions)?;
        check("weights", covariance.weights, self.feature_count)?;
        check("noise_variance", &[covariance.noise_variance], 1)?;
        let weights = covariance.weights.iter().map(|&w| ("weight", w));
        let mut all = weights.chain([("noise variance", covariance.noise_variance)]);
        match all.find(|&(_, value)| value <= 0.0) {
            Some((name, value)) => Err(GpError::NotPositive { name, value }),
            None => Ok(()),
        }
    }

    /// `1/2 ((F_m' alpha)² - F_m' K^-1 F_m)` for every feature times the root of its weight.
    fn weight_slopes(&self, features: &Panels, alpha: &[f64], slopes: &mut [f64]) {
        let p = self.feature_count;
        let entry = |i: usize, m: usize| features.panel(i / ROWS)[m * ROWS + i % ROWS];
        let transposed = Panels::new(p, alpha.len(), |m, i| entry(i, m));
        let product = product::multiply_columns(&self.matrix, &transposed, p, self.arch);
        for (m, slope) in slopes.iter_mut().enumerate() {
            let column = (0..self.points()).map(|i| entry(i, m));
            let along: f64 = column.clone().zip(alpha).map(|(f, a)| f * a).sum();
            let quadratic: f64 = column.zip(product.chunks_exact(p)).map(|(f, k)| f * k[m]).sum();
            *slope = 0.5 * (along * along - quadratic);
        }
    }
}

/// Assembles the covariance and inverts it, with as little jitter as it takes.
fn invert(gram: &Gram, covariance: &Covariance, matrix: &mut Packed) -> Result<Inverted, GpError> {
    let mut jitter = 0.0;
    for (jitter_steps, step) in JITTER.into_iter().enumerate() {
        jitter = step * covariance.kernel.signal_variance;
        gram.assemble(covariance.noise_variance + jitter, matrix);
        if let Ok(log_determinant) = sweep::invert(matrix, gram.arch) {
            matrix.fill(0.0);
            return Ok(Inverted { log_determinant, jitter, jitter_steps });
        }
    }
    Err(GpError::NotPositiveDefinite { points: matrix.rows(), jitter })
}

fn dot(a: &[f64], b: &[f64]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;
    use serde_json::Value;

    fn golden() -> Value {
        let file = concat!(env!("CARGO_MANIFEST_DIR"), "/../../tests/golden/gaussian_process.json");
        serde_json::from_str(&std::fs::read_to_string(file).unwrap()).unwrap()
    }

    fn numbers(value: &Value) -> Vec<f64> {
        let list = value.as_array().unwrap().iter();
        list.flat_map(|v| v.as_f64().map_or_else(|| numbers(v), |v| vec![v])).collect()
    }

    /// A problem of `n` points with three inputs and two features.
    struct Problem {
        inputs: Vec<f64>,
        features: Vec<f64>,
        targets: Vec<f64>,
        kernel: GaussianKernel,
    }

    const NOISE: f64 = 0.02;
    const WEIGHTS: [f64; 2] = [0.7, 2.5];

    impl Problem {
        fn new(n: usize) -> Self {
            let mut rng = ChaCha8Rng::seed_from_u64(n as u64);
            let mut draw = |count| (0..count).map(|_| rng.random_range(-2.0..2.0)).collect();
            let kernel =
                GaussianKernel { signal_variance: 1.7, length_scales: vec![0.8, 1.3, 2.1] };
            Self { inputs: draw(3 * n), features: draw(2 * n), targets: draw(n), kernel }
        }

        fn likelihood(&self) -> Likelihood {
            let likelihood = Likelihood::new(&self.inputs, 3).unwrap();
            likelihood.with_features(&self.features, 2).unwrap()
        }

        fn covariance(&self) -> Covariance<'_> {
            Covariance { kernel: &self.kernel, noise_variance: NOISE, weights: &WEIGHTS }
        }

        /// Entry of the covariance, from its definition.
        fn entry(&self, i: usize, j: usize) -> f64 {
            let x = |i: usize| &self.inputs[3 * i..3 * i + 3];
            let phi = |i: usize, m: usize| self.features[2 * i + m];
            let linear: f64 = (0..2).map(|m| WEIGHTS[m] * phi(i, m) * phi(j, m)).sum();
            let noise = if i == j { NOISE } else { 0.0 };
            self.kernel.value(x(i), x(j)) + linear + noise
        }
    }

    fn relative(a: f64, b: f64) -> f64 {
        (a - b).abs() / b.abs().max(1.0)
    }

    #[test]
    fn likelihood_and_gradient_are_those_of_scikit_learn() {
        let golden = golden();
        let number = |key: &str| golden[key].as_f64().unwrap();
        let kernel = GaussianKernel {
            signal_variance: number("signal_variance"),
            length_scales: numbers(&golden["length_scales"]),
        };
        let mut likelihood = Likelihood::new(&numbers(&golden["X"]), kernel.inputs()).unwrap();
        let mut gradient = vec![0.0; 23];
        let evidence = likelihood
            .evaluate(&numbers(&golden["y"]), &kernel, number("noise_variance"), &mut gradient)
            .unwrap();
        assert!(relative(evidence.log_likelihood, number("log_marginal_likelihood")) < 1e-12);
        assert_eq!((evidence.jitter, evidence.jitter_steps), (0.0, 0));
        for (ours, theirs) in gradient.iter().zip(numbers(&golden["gradient"])) {
            assert!(relative(*ours, theirs) < 1e-11, "{ours} {theirs}");
        }
    }

    #[test]
    fn gradient_is_the_slope_of_the_likelihood() {
        let problem = Problem::new(60);
        let mut likelihood = problem.likelihood();
        // log of signal variance, three lengths, noise variance, two weights.
        let mut evaluate = |theta: &[f64], gradient: &mut [f64]| {
            let theta: Vec<f64> = theta.iter().map(|t| t.exp()).collect();
            let kernel =
                GaussianKernel { signal_variance: theta[0], length_scales: theta[1..4].to_vec() };
            let covariance =
                Covariance { kernel: &kernel, noise_variance: theta[4], weights: &theta[5..] };
            let targets = &problem.targets;
            likelihood
                .evaluate_with_features(targets, &covariance, gradient)
                .unwrap()
                .log_likelihood
        };
        let theta = [1.7, 0.8, 1.3, 2.1, NOISE, 0.7, 2.5].map(f64::ln);
        let mut gradient = [0.0; 7];
        evaluate(&theta, &mut gradient);
        for (at, slope) in gradient.into_iter().enumerate() {
            let mut shifted = |step: f64| {
                let mut theta = theta;
                theta[at] += step;
                evaluate(&theta, &mut [0.0; 7])
            };
            // Central differences, with an error of the fourth order.
            let h = 1e-3;
            let [near, far] = [h, 2.0 * h].map(|h| (shifted(h) - shifted(-h)) / (2.0 * h));
            let difference = (4.0 * near - far) / 3.0;
            assert!(relative(slope, difference) < 1e-8, "{at}: {slope} {difference}");
        }
    }

    #[test]
    fn features_are_a_linear_model_with_uncertain_coefficients() {
        // The determinant lemma and the identity of Woodbury, with the inverse without features:
        // det(K + F F') = det K det(1 + F' K^-1 F).
        let problem = Problem::new(60);
        let plain = Likelihood::new(&problem.inputs, 3).unwrap();
        let plain = plain.condition(&problem.kernel, NOISE).unwrap();
        let full = problem.likelihood().condition_with_features(&problem.covariance()).unwrap();
        let product = plain.multiply_columns(&problem.features, 2);
        let form = |a: usize, b: usize| -> f64 {
            let pairs = problem.features.chunks(2).zip(product.chunks(2));
            (WEIGHTS[a] * WEIGHTS[b]).sqrt() * pairs.map(|(f, k)| f[a] * k[b]).sum::<f64>()
        };
        let determinant = (1.0 + form(0, 0)) * (1.0 + form(1, 1)) - form(0, 1) * form(1, 0);
        let expected = plain.log_determinant() + determinant.ln();
        assert!(relative(full.log_determinant(), expected) < 1e-12);
    }

    #[test]
    fn inverse_times_covariance_is_the_identity() {
        for n in [1, 2, 23, 24, 25, 97, 300] {
            let problem = Problem::new(n);
            let inverse =
                problem.likelihood().condition_with_features(&problem.covariance()).unwrap();
            assert_eq!(inverse.len(), n);
            let k: Vec<f64> = (0..n * n).map(|at| problem.entry(at / n, at % n)).collect();
            let identity = inverse.multiply_columns(&k, n);
            let mut column = vec![0.0; n];
            inverse.multiply(&k[..n], &mut column);
            for i in 0..n {
                for j in 0..n {
                    let error = identity[i * n + j] - f64::from(i == j);
                    assert!(error.abs() < 1e-11, "n = {n} ({i}, {j}): {error:e}");
                }
                assert!((column[i] - f64::from(i == 0)).abs() < 1e-11, "n = {n} ({i})");
            }
            assert!(relative(inverse.quadratic(&k[..n]), k[0]) < 1e-11, "n = {n}");
        }
    }

    #[test]
    fn one_point_is_a_normal_distribution() {
        let problem = Problem::new(1);
        let mut likelihood = Likelihood::new(&problem.inputs, 3).unwrap();
        let mut gradient = [0.0; 5];
        let y = problem.targets[0];
        let evidence = likelihood.evaluate(&[y], &problem.kernel, NOISE, &mut gradient).unwrap();
        let variance = 1.7 + NOISE;
        let closed = -0.5 * (y * y / variance + variance.ln() + std::f64::consts::TAU.ln());
        assert!(relative(evidence.log_likelihood, closed) < 1e-14);
        let slope = 0.5 * (y * y / variance - 1.0) / variance;
        let expected = [1.7 * slope, 0.0, 0.0, 0.0, NOISE * slope];
        for (ours, expected) in gradient.iter().zip(expected) {
            assert!((ours - expected).abs() < 1e-14, "{ours} {expected}");
        }
    }

    #[test]
    fn repeated_points_get_jitter_and_it_is_reported() {
        let mut problem = Problem::new(50);
        problem.inputs = problem.inputs[..3].repeat(50);
        let mut likelihood = Likelihood::new(&problem.inputs, 3).unwrap();
        let mut gradient = [0.0; 5];
        let evidence =
            likelihood.evaluate(&problem.targets, &problem.kernel, 1e-300, &mut gradient).unwrap();
        assert!(evidence.jitter_steps > 0, "{evidence:?}");
        let expected = JITTER[evidence.jitter_steps] * 1.7;
        assert!(relative(evidence.jitter, expected) < 1e-15, "{evidence:?}");
        assert!(evidence.log_likelihood.is_finite());
        let with_jitter = gradient;
        // With the noise that the jitter stands for there is none, and the value is the same.
        let again = likelihood
            .evaluate(&problem.targets, &problem.kernel, evidence.jitter, &mut gradient)
            .unwrap();
        assert_eq!(again.jitter_steps, 0);
        assert!(relative(again.log_likelihood, evidence.log_likelihood) < 1e-12);
        // Jitter grows with the signal variance, noise does not.
        assert!(relative(with_jitter[0], gradient[0] + gradient[4]) < 1e-12, "{with_jitter:?}");
        assert_eq!(with_jitter[1..4], gradient[1..4]);
    }

    #[test]
    fn a_covariance_beyond_jitter_is_refused() {
        let problem = Problem::new(30);
        let covariance = Covariance { weights: &[1.0, f64::MAX], ..problem.covariance() };
        let error = problem.likelihood().condition_with_features(&covariance).unwrap_err();
        assert_eq!(error, GpError::NotPositiveDefinite { points: 30, jitter: 1e-4 * 1.7 });
    }

    #[test]
    fn input_that_cannot_be_used_is_refused() {
        let problem = Problem::new(4);
        assert_eq!(Likelihood::new(&[], 3).unwrap_err(), GpError::NoPoints);
        assert_eq!(Likelihood::new(&[1.0], 0).unwrap_err(), GpError::NoPoints);
        assert_eq!(
            Likelihood::new(&[1.0; 4], 3).unwrap_err(),
            GpError::WrongLength { vector: "inputs", expected: 6, got: 4 }
        );
        let nan = Likelihood::new(&[0.0, f64::NAN], 1).unwrap_err();
        assert!(matches!(nan, GpError::NotFinite { vector: "inputs", index: 1, .. }), "{nan}");

        let mut likelihood = Likelihood::new(&problem.inputs, 3).unwrap();
        let mut evaluate = |targets: &[f64], kernel: &GaussianKernel, noise: f64, slopes: usize| {
            likelihood.evaluate(targets, kernel, noise, &mut vec![0.0; slopes]).unwrap_err()
        };
        let (kernel, targets) = (&problem.kernel, &problem.targets);
        assert_eq!(
            evaluate(&targets[..3], kernel, NOISE, 5),
            GpError::WrongLength { vector: "targets", expected: 4, got: 3 }
        );
        assert_eq!(
            evaluate(targets, kernel, NOISE, 6),
            GpError::WrongLength { vector: "gradient", expected: 5, got: 6 }
        );
        assert_eq!(
            evaluate(targets, kernel, 0.0, 5),
            GpError::NotPositive { name: "noise variance", value: 0.0 }
        );
        let short = GaussianKernel { length_scales: vec![1.0], ..kernel.clone() };
        assert_eq!(
            evaluate(targets, &short, NOISE, 5),
            GpError::WrongLength { vector: "length_scales", expected: 3, got: 1 }
        );
        let narrow = GaussianKernel { length_scales: vec![1e-320; 3], ..kernel.clone() };
        let error = evaluate(targets, &narrow, NOISE, 5);
        assert!(matches!(error, GpError::NotFinite { vector: "inputs / length_scales", .. }));
    }

    #[test]
    fn the_number_of_threads_does_not_matter() {
        let problem = Problem::new(200);
        let evaluate = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let mut gradient = vec![0.0; 7];
            let covariance = problem.covariance();
            let evidence = pool.install(|| {
                let mut likelihood = problem.likelihood();
                likelihood.evaluate_with_features(&problem.targets, &covariance, &mut gradient)
            });
            gradient.push(evidence.unwrap().log_likelihood);
            gradient.into_iter().map(f64::to_bits).collect::<Vec<_>>()
        };
        assert_eq!(evaluate(1), evaluate(3));
    }

    #[test]
    fn memory_is_what_is_said_before() {
        let problem = Problem::new(700);
        let pool = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
        let taken = pool.install(|| {
            allocation_counter::measure(|| {
                let mut likelihood = problem.likelihood();
                let (targets, covariance) = (&problem.targets, problem.covariance());
                let _ = likelihood.evaluate_with_features(targets, &covariance, &mut [0.0; 7]);
            })
        });
        let (said, taken) = (Likelihood::bytes(700, 3, 2), taken.bytes_max as usize);
        assert!((taken..taken + taken / 10).contains(&said), "{said} said, {taken} taken");
    }

    #[test]
    fn products_with_the_inverse_do_not_allocate() {
        let problem = Problem::new(100);
        let inverse = problem.likelihood().condition_with_features(&problem.covariance()).unwrap();
        let mut out = vec![0.0; 100];
        let taken = allocation_counter::measure(|| {
            inverse.multiply(&problem.targets, &mut out);
            std::hint::black_box(inverse.quadratic(&problem.targets));
        });
        assert_eq!(taken.count_total, 0);
    }
}
