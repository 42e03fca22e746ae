use crate::cholesky::{cholesky_with_jitter, rounding};
use crate::covariance::{ScaledPoints, check_points};
use crate::error::{GpError, check};
use crate::inducing_posterior::{Evidence, InducingPosterior};
use crate::kernel::GaussianKernel;
use faer::linalg::matmul::matmul;
use faer::linalg::matmul::triangular::{self, BlockStructure};
use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::{Accum, Mat, MatMut, MatRef, Par};
use rayon::prelude::*;

/// Samples held back until they are worked in together.
const BLOCK: usize = 1024;

/// Samples that one task whitens.
const PANEL: usize = 128;

/// Rows and columns of the Gram matrix that one task updates.
const TILE: usize = 256;

/// Learns a Gaussian process from any number of samples through `m` inducing points, in one pass
/// and with memory for `m²` numbers.
///
/// With `K_mm` the covariance of the points `Z`, `K_mn` that of points and samples, and
/// `L L' = K_mm + jitter I`, each block of samples is whitened before it is summed:
///
/// ```text
/// V = L^-1 K_mn,   G = V V',   r = V y,   A = I + G / sigma_n²
/// mean(x)     = k_m(x)' alpha,   alpha = L^-T A^-1 r / sigma_n²
/// variance(x) = k(x, x) - k_m(x)' L^-T (I - A^-1) L^-1 k_m(x)
/// ```
///
/// These are the subset of regressors' mean (Rasmussen & Williams 2006, equation 8.14) and the
/// projected process' variance (equation 8.27), which returns to `k(x, x)` far from the points.
/// `K_mn K_nm`, which has the square of the condition number of `K_mm` and loses the smaller half
/// of its digits, is never formed.
///
/// The blocks are of a size of their own, so that the result has the same bits however the
/// samples were divided among calls of [`add`](Self::add) and whatever the number of threads. The
/// pass takes `2 n m²` floating-point operations.
///
/// # Examples
///
/// ```
/// use gaussian_process::{GaussianKernel, Inducing, inducing_points};
///
/// let x: Vec<f64> = (0..1000).map(|i| f64::from(i) * 0.01).collect();
/// let y: Vec<f64> = x.iter().map(|x| x.sin()).collect();
/// let kernel = GaussianKernel { signal_variance: 1.0, length_scales: vec![1.0] };
///
/// let chosen = inducing_points(&x, &kernel, 20)?;
/// let points: Vec<f64> = chosen.iter().map(|&i| x[i]).collect();
/// let mut learner = Inducing::new(&points, &kernel, 1e-4)?;
/// learner.add(&x, &y)?;
/// let posterior = learner.finish()?;
///
/// let mean: f64 =
///     points.iter().zip(&posterior.alpha).map(|(z, a)| a * kernel.value(&[2.0], &[*z])).sum();
/// assert!((mean - 2.0_f64.sin()).abs() < 1e-3);
/// # Ok::<(), gaussian_process::GpError>(())
/// ```
pub struct Inducing {
    points: ScaledPoints,
    noise_variance: f64,
    factor: Mat<f64>,
    jitter: f64,
    /// Lower triangle of `[V; y'] [V; y']'`.
    gram: Vec<Tile>,
    inputs: Vec<f64>,
    targets: Vec<f64>,
    /// `[V; y']` of the block at work, one column per sample.
    whitened: Vec<f64>,
    samples: usize,
}

impl Inducing {
    /// Starts with the inducing points (row-major, one row of `kernel.inputs()` numbers each).
    ///
    /// Points that repeat others are allowed: the jitter that their covariance needs is part of
    /// the result.
    ///
    /// # Errors
    ///
    /// [`GpError::NoPoints`], [`GpError::WrongLength`], [`GpError::NotFinite`],
    /// [`GpError::NotPositive`]; [`GpError::NotPositiveDefinite`] when no jitter helps.
    pub fn new(
        points: &[f64],
        kernel: &GaussianKernel,
        noise_variance: f64,
    ) -> Result<Self, GpError> {
        kernel.check()?;
        check("noise_variance", &[noise_variance], 1)?;
        if noise_variance <= 0.0 {
            let name = "noise variance";
            return Err(GpError::NotPositive { name, value: noise_variance });
        }
        let m = check_points("points", points, kernel.inputs())?;
        let scaled = ScaledPoints::new(points, kernel);
        let mut k_mm = vec![0.0; m * m];
        scaled.covariances(points, &mut k_mm, m);
        let k_mm = MatRef::from_column_major_slice(&k_mm, m, m);
        let step = rounding(m, kernel.signal_variance);
        let (factor, jitter) = cholesky_with_jitter(k_mm, step, step)?;
        Ok(Self {
            points: scaled,
            noise_variance,
            factor,
            jitter,
            gram: Tile::lower_triangle(m + 1),
            inputs: Vec::new(),
            targets: Vec::new(),
            whitened: Vec::new(),
            samples: 0,
        })
    }

    /// Adds samples: `inputs` row-major, one target per row.
    ///
    /// # Errors
    ///
    /// [`GpError::WrongLength`], [`GpError::NotFinite`]; nothing has been added then.
    pub fn add(&mut self, inputs: &[f64], targets: &[f64]) -> Result<(), GpError> {
        let d = self.points.kernel().inputs();
        check("inputs", inputs, targets.len() * d)?;
        check("targets", targets, targets.len())?;
        let (mut inputs, mut targets) = (inputs, targets);
        while !targets.is_empty() {
            let count = targets.len().min(BLOCK - self.targets.len());
            let (head, rest) = inputs.split_at(count * d);
            self.inputs.extend_from_slice(head);
            inputs = rest;
            let (head, rest) = targets.split_at(count);
            self.targets.extend_from_slice(head);
            targets = rest;
            if self.targets.len() == BLOCK {
                self.sum_block();
            }
        }
        Ok(())
    }

    /// The posterior of all samples added.
    ///
    /// # Errors
    ///
    /// [`GpError::NotPositiveDefinite`] when the noise variance is so small beside the signal
    /// variance that `A` has no Cholesky factor.
    pub fn finish(mut self) -> Result<InducingPosterior, GpError> {
        self.sum_block();
        let m = self.points.len();
        let mut gram = Mat::zeros(m + 1, m + 1);
        for tile in &self.gram {
            tile.copy_into(&mut gram);
        }
        Evidence {
            gram,
            factor: self.factor,
            jitter: self.jitter,
            signal_variance: self.points.kernel().signal_variance,
            noise_variance: self.noise_variance,
            samples: self.samples,
        }
        .posterior()
    }

    /// Whitens the samples held back and adds them to the sums.
    fn sum_block(&mut self) {
        let Self { points, factor, gram, inputs, targets, whitened, .. } = self;
        let (m, d) = (points.len(), points.kernel().inputs());
        let stride = m + 1;
        whitened.resize(stride * targets.len(), 0.0);
        let panels = whitened.par_chunks_mut(stride * PANEL);
        let samples = inputs.par_chunks(d * PANEL).zip(targets.par_chunks(PANEL));
        panels.zip(samples).for_each(|(panel, (inputs, targets))| {
            points.covariances(inputs, panel, stride);
            let v =
                MatMut::from_column_major_slice_with_stride_mut(panel, m, targets.len(), stride);
            solve_lower_triangular_in_place(factor.as_ref(), v, Par::Seq);
            for (column, &y) in panel.chunks_exact_mut(stride).zip(targets) {
                column[m] = y;
            }
        });
        let v = MatRef::from_column_major_slice(whitened, stride, targets.len());
        gram.par_iter_mut().for_each(|tile| tile.add(v));
        self.samples += targets.len();
        inputs.clear();
        targets.clear();
    }
}

/// A square of the lower triangle of a Gram matrix, which one task at a time updates.
struct Tile {
    row: usize,
    column: usize,
    sum: Mat<f64>,
}

impl Tile {
    fn lower_triangle(size: usize) -> Vec<Self> {
        let edge = |start: usize| TILE.min(size - start);
        let starts = || (0..size).step_by(TILE);
        let pairs = starts().flat_map(|row| starts().map(move |column| (row, column)));
        pairs
            .filter(|(row, column)| column <= row)
            .map(|(row, column)| Self { row, column, sum: Mat::zeros(edge(row), edge(column)) })
            .collect()
    }

    /// `sum += V_rows V_columns'`.
    fn add(&mut self, v: MatRef<f64>) {
        let left = v.subrows(self.row, self.sum.nrows());
        let right = v.subrows(self.column, self.sum.ncols()).transpose();
        if self.row > self.column {
            matmul(self.sum.as_mut(), Accum::Add, left, right, 1.0, Par::Seq);
        } else {
            let (full, lower) = (BlockStructure::Rectangular, BlockStructure::TriangularLower);
            let sum = self.sum.as_mut();
            triangular::matmul(sum, lower, Accum::Add, left, full, right, full, 1.0, Par::Seq);
        }
    }

    fn copy_into(&self, gram: &mut Mat<f64>) {
        let (rows, columns) = (self.sum.nrows(), self.sum.ncols());
        gram.submatrix_mut(self.row, self.column, rows, columns).copy_from(&self.sum);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::pivoted_cholesky::inducing_points;
    use faer::Side;
    use faer::linalg::solvers::Solve;

    const D: usize = 3;

    fn kernel() -> GaussianKernel {
        GaussianKernel { signal_variance: 1.7, length_scales: vec![0.8, 1.1, 2.0] }
    }

    /// Samples along a curve, and a smooth function of them.
    fn samples(n: usize) -> (Vec<f64>, Vec<f64>) {
        let x: Vec<f64> = (0..n)
            .flat_map(|i| {
                let t = i as f64 * 0.37;
                [2.0 * t.sin(), 2.0 * (1.3 * t).cos(), (0.7 * t).sin() + 0.001 * t]
            })
            .collect();
        let y = x.chunks_exact(D).map(|x| x[0].sin() + x[1] * x[2] + 0.1 * (9.0 * x[0]).sin());
        let y = y.collect();
        (x, y)
    }

    fn learn(points: &[f64], (x, y): (&[f64], &[f64]), noise: f64) -> InducingPosterior {
        let mut learner = Inducing::new(points, &kernel(), noise).unwrap();
        learner.add(x, y).unwrap();
        learner.finish().unwrap()
    }

    fn covariances(a: &[f64], b: &[f64], kernel: &GaussianKernel) -> Mat<f64> {
        let d = kernel.inputs();
        Mat::from_fn(a.len() / d, b.len() / d, |i, j| kernel.value(&a[i * d..][..d], &b[j * d..]))
    }

    /// Mean and variance of `f` at `x`.
    fn predict(posterior: &InducingPosterior, points: &[f64], x: &[f64]) -> (f64, f64) {
        let k: Vec<f64> = points.chunks_exact(D).map(|z| kernel().value(z, x)).collect();
        let mean = k.iter().zip(&posterior.alpha).map(|(k, a)| k * a).sum();
        (mean, kernel().signal_variance - posterior.explained_variance(&k))
    }

    fn column(y: &[f64]) -> Mat<f64> {
        Mat::from_fn(y.len(), 1, |i, _| y[i])
    }

    /// `log N(y; 0, c)`.
    fn log_normal(y: &Mat<f64>, c: &Mat<f64>) -> f64 {
        let llt = c.llt(Side::Lower).unwrap();
        let half: f64 = (0..y.nrows()).map(|i| llt.L()[(i, i)].ln()).sum();
        let square = (y.transpose() * llt.solve(y))[(0, 0)];
        -0.5 * (square + y.nrows() as f64 * std::f64::consts::TAU.ln()) - half
    }

    fn plus_diagonal(k: &Mat<f64>, value: f64) -> Mat<f64> {
        Mat::from_fn(k.nrows(), k.ncols(), |i, j| k[(i, j)] + if i == j { value } else { 0.0 })
    }

    #[test]
    fn with_every_sample_an_inducing_point_the_process_is_the_exact_one() {
        let (x, y) = samples(90);
        let noise = 1e-2;
        let posterior = learn(&x, (&x, &y), noise);
        assert!(posterior.jitter.abs() < f64::MIN_POSITIVE);

        let c = plus_diagonal(&covariances(&x, &x, &kernel()), noise);
        let exact = c.llt(Side::Lower).unwrap();
        let alpha = exact.solve(column(&y));
        for query in [&x[..D], &x[60..60 + D], &[0.3, -0.2, 0.4], &[3.0, 1.0, -1.0]] {
            let k = covariances(&x, query, &kernel());
            let (mean, variance) = predict(&posterior, &x, query);
            let exact_mean = (k.transpose() * &alpha)[(0, 0)];
            let exact_variance = 1.7 - (k.transpose() * exact.solve(&k))[(0, 0)];
            assert!((mean - exact_mean).abs() < 1e-9, "{mean} {exact_mean}");
            assert!((variance - exact_variance).abs() < 1e-10, "{variance} {exact_variance}");
        }
        let expected = log_normal(&column(&y), &c);
        assert!((posterior.log_likelihood / expected - 1.0).abs() < 1e-9);
        assert!(posterior.unexpressed_variance.abs() < 1e-12);
    }

    #[test]
    fn mean_variance_and_likelihood_follow_rasmussen_and_williams_8_14_and_8_27() {
        let (x, y) = samples(150);
        let (points, noise) = (&x[..20 * D], 0.03);
        let posterior = learn(points, (&x, &y), noise);
        assert_eq!(posterior.samples, 150);

        let k_mm = covariances(points, points, &kernel());
        let k_mn = covariances(points, &x, &kernel());
        let normal = noise * &k_mm + &k_mn * k_mn.transpose();
        let normal = normal.llt(Side::Lower).unwrap();
        let alpha = normal.solve(&k_mn * column(&y));
        for (i, &a) in posterior.alpha.iter().enumerate() {
            assert!((a - alpha[(i, 0)]).abs() < 1e-9 * alpha.norm_max(), "{a} {}", alpha[(i, 0)]);
        }
        let prior = k_mm.llt(Side::Lower).unwrap();
        for query in [&x[90..90 + D], &[0.3, -0.2, 0.4], &[5.0, 1.0, -1.0]] {
            let k = covariances(points, query, &kernel());
            let reduction = prior.solve(&k) - noise * normal.solve(&k);
            let expected = 1.7 - (k.transpose() * reduction)[(0, 0)];
            let (_, variance) = predict(&posterior, points, query);
            assert!((variance - expected).abs() < 1e-9, "{variance} {expected}");
        }
        let q = k_mn.transpose() * prior.solve(&k_mn);
        let expected = log_normal(&column(&y), &plus_diagonal(&q, noise));
        assert!((posterior.log_likelihood - expected).abs() < 1e-7 * expected.abs());
        let unexpressed = 1.7 - (0..150).map(|i| q[(i, i)]).sum::<f64>() / 150.0;
        assert!((posterior.unexpressed_variance - unexpressed).abs() < 1e-12);
    }

    #[test]
    fn one_point_gives_the_closed_form() {
        let kernel = GaussianKernel { signal_variance: 2.0, length_scales: vec![1.0] };
        let (x, y) = ([0.5, -1.0, 2.0], [1.0, 0.3, -0.4]);
        let mut learner = Inducing::new(&[0.0], &kernel, 0.1).unwrap();
        learner.add(&x, &y).unwrap();
        let posterior = learner.finish().unwrap();
        let k: Vec<f64> = x.iter().map(|x| 2.0 * (-0.5 * x * x).exp()).collect();
        let ky: f64 = k.iter().zip(&y).map(|(k, y)| k * y).sum();
        let kk: f64 = k.iter().map(|k| k * k).sum();
        assert!((posterior.alpha[0] - ky / (0.1 * 2.0 + kk)).abs() < 1e-15);
        let explained = posterior.explained_variance(&[2.0]);
        assert!((explained - (2.0 - 0.1 * 4.0 / (0.1 * 2.0 + kk))).abs() < 1e-14);
    }

    #[test]
    fn smooth_functions_need_few_points_and_lose_no_digits() {
        // Neighbours are so alike here that the covariance of all samples is singular to rounding.
        let kernel = GaussianKernel { signal_variance: 1.0, length_scales: vec![1.0] };
        let x: Vec<f64> = (0..400).map(|i| f64::from(i) * 0.01).collect();
        let y: Vec<f64> = x.iter().map(|x| (2.0 * x).sin()).collect();
        let noise = 1e-8;
        let chosen = inducing_points(&x, &kernel, 400).unwrap();
        assert!((10..30).contains(&chosen.len()), "{}", chosen.len());
        let points: Vec<f64> = chosen.iter().map(|&i| x[i]).collect();
        let mut learner = Inducing::new(&points, &kernel, noise).unwrap();
        learner.add(&x, &y).unwrap();
        let posterior = learner.finish().unwrap();
        assert!(posterior.jitter.abs() < f64::MIN_POSITIVE);

        let k = covariances(&x, &x, &kernel);
        let exact = plus_diagonal(&k, noise).llt(Side::Lower).unwrap();
        let alpha = exact.solve(column(&y));
        for i in [0, 50, 333] {
            let k_m: Vec<f64> = points.iter().map(|z| kernel.value(&[*z], &x[i..=i])).collect();
            let mean: f64 = k_m.iter().zip(&posterior.alpha).map(|(k, a)| k * a).sum();
            let expected = (k.row(i) * &alpha)[0];
            assert!((mean - expected).abs() < 1e-8, "{mean} {expected}");
            let variance = 1.0 - posterior.explained_variance(&k_m);
            let expected = 1.0 - (k.row(i) * exact.solve(k.col(i)));
            assert!((variance - expected).abs() < 1e-11, "{variance:e} {expected:e}");
        }
    }

    #[test]
    fn posterior_agrees_with_60_digit_arithmetic() {
        // mpmath, R&W 8.14, 8.27 and the likelihood by Woodbury's identity and determinants.
        let reference = [
            (0.503, 0.844_618_158_814_509_6, 1.7472735859257114e-8),
            (3.999, 0.989_976_136_918_244_7, 2.478165197097251e-9),
            (4.7, 0.089_578_858_540_725_19, 0.009_096_591_399_026_718),
        ];
        let kernel = GaussianKernel { signal_variance: 1.0, length_scales: vec![1.0] };
        let points: Vec<f64> = (0..11).map(|i| f64::from(i) * 0.4).collect();
        let x: Vec<f64> = (0..400).map(|i| f64::from(i) * 0.01).collect();
        let y: Vec<f64> = x.iter().map(|x| (2.0 * x).sin()).collect();
        let mut learner = Inducing::new(&points, &kernel, 1e-8).unwrap();
        learner.add(&x, &y).unwrap();
        let posterior = learner.finish().unwrap();
        for (query, expected_mean, expected_variance) in reference {
            let k: Vec<f64> = points.iter().map(|z| kernel.value(&[*z], &[query])).collect();
            let mean: f64 = k.iter().zip(&posterior.alpha).map(|(k, a)| k * a).sum();
            let variance = 1.0 - posterior.explained_variance(&k);
            assert!((mean - expected_mean).abs() < 1e-11, "{mean}");
            let tolerance = 2e-14 + 1e-8 * expected_variance;
            assert!((variance - expected_variance).abs() < tolerance, "{variance:e}");
        }
        assert!((posterior.log_likelihood / 3_129.966_856_610_933 - 1.0).abs() < 1e-9);
    }

    #[test]
    fn the_result_has_the_same_bits_for_any_division_into_blocks_and_any_number_of_threads() {
        let (x, y) = samples(2500);
        let points = &x[..300 * D];
        let in_blocks = |rows: usize, threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| {
                let mut learner = Inducing::new(points, &kernel(), 0.01).unwrap();
                for (x, y) in x.chunks(rows * D).zip(y.chunks(rows)) {
                    learner.add(x, y).unwrap();
                }
                learner.finish().unwrap()
            })
        };
        let whole = in_blocks(2500, 1);
        assert_eq!(whole.samples, 2500);
        for (rows, threads) in [(1, 1), (7, 2), (1000, 3), (2500, 4)] {
            assert!(in_blocks(rows, threads) == whole, "{rows} rows, {threads} threads");
        }
    }

    #[test]
    fn variances_of_many_queries_are_those_of_each() {
        let (x, y) = samples(400);
        let posterior = learn(&x[..70 * D], (&x, &y), 0.01);
        let k = covariances(&x[..70 * D], &x, &kernel());
        let k_star: Vec<f64> =
            (0..400).flat_map(|j| (0..70).map(move |i| (i, j))).map(|ij| k[ij]).collect();
        let together = posterior.explained_variances(&k_star);
        for (k_star, value) in k_star.chunks_exact(70).zip(&together) {
            assert!((posterior.explained_variance(k_star) - value).abs() < 1e-12);
        }
        assert_eq!(together.len(), 400);
    }

    #[test]
    fn far_from_the_data_mean_is_zero_and_variance_the_prior_one() {
        let (x, y) = samples(200);
        let posterior = learn(&x[..50 * D], (&x, &y), 0.01);
        assert_eq!(predict(&posterior, &x[..50 * D], &[1e3, 0.0, 0.0]), (0.0, 1.7));
    }

    #[test]
    fn points_that_repeat_others_take_jitter_and_change_nothing_else() {
        let (x, y) = samples(200);
        let once = learn(&x[..30 * D], (&x, &y), 0.01);
        let points = [&x[..30 * D], &x[..10 * D]].concat();
        let twice = learn(&points, (&x, &y), 0.01);
        assert!(twice.jitter > 0.0 && twice.jitter < 1e-9, "{}", twice.jitter);
        for query in x.chunks_exact(D) {
            let (mean, variance) = predict(&once, &x[..30 * D], query);
            let (mean_twice, variance_twice) = predict(&twice, &points, query);
            assert!((mean - mean_twice).abs() < 1e-6, "{mean} {mean_twice}");
            assert!((variance - variance_twice).abs() < 1e-6, "{variance} {variance_twice}");
        }
    }

    #[test]
    fn fewer_samples_than_points_and_none_are_answered() {
        let (x, y) = samples(40);
        let posterior = learn(&x, (&x[..2 * D], &y[..2]), 1e-4);
        let (mean, variance) = predict(&posterior, &x, &x[..D]);
        assert!((mean - y[0]).abs() < 1e-3 && variance > 0.0 && variance < 1.1e-4);

        let nothing = learn(&x, (&[], &[]), 1e-4);
        assert!(nothing.alpha.iter().all(|&a| a == 0.0));
        assert!((predict(&nothing, &x, &x[..D]).1 - 1.7).abs() < 1e-11);
        assert!(nothing.log_likelihood.abs() < f64::MIN_POSITIVE);
    }

    #[test]
    fn constant_targets_are_learnt() {
        let (x, _) = samples(300);
        let posterior = learn(&x, (&x, &[3.0; 300]), 1e-4);
        assert!((predict(&posterior, &x, &x[33..33 + D]).0 - 3.0).abs() < 1e-2);
    }

    #[test]
    fn input_that_cannot_be_used_is_refused_and_leaves_no_trace() {
        let (x, y) = samples(30);
        let refused =
            |points: &[f64], noise| Inducing::new(points, &kernel(), noise).err().unwrap();
        assert_eq!(refused(&[], 0.1), GpError::NoPoints);
        let wrong = GpError::WrongLength { vector: "points", expected: 6, got: 4 };
        assert_eq!(refused(&x[..4], 0.1), wrong);
        assert!(matches!(refused(&x, 0.0), GpError::NotPositive { .. }));
        assert!(matches!(refused(&x, f64::NAN), GpError::NotFinite { .. }));
        let none = GaussianKernel { signal_variance: 1.0, length_scales: vec![] };
        assert_eq!(Inducing::new(&[1.0], &none, 0.1).err(), Some(GpError::NoPoints));

        let mut learner = Inducing::new(&x, &kernel(), 0.1).unwrap();
        let wrong = GpError::WrongLength { vector: "inputs", expected: 3, got: 4 };
        assert_eq!(learner.add(&x[..4], &y[..1]), Err(wrong));
        let nan = learner.add(&x[..2 * D], &[1.0, f64::NAN]);
        assert!(matches!(nan, Err(GpError::NotFinite { vector: "targets", index: 1, .. })));
        let nan = learner.add(&[f64::INFINITY, 0.0, 0.0], &[1.0]);
        assert!(matches!(nan, Err(GpError::NotFinite { vector: "inputs", index: 0, .. })));
        assert_eq!(learner.finish().unwrap().samples, 0);
    }
}
