use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;

use crate::error::{GpError, check};
use crate::exp::{exp, exp_each};
use crate::kernel::GaussianKernel;

/// Points in a block: two AVX-512 vectors.
const BLOCK: usize = 16;

/// Outputs summed in one pass over the points: two AVX-512 vectors of each fill half of the
/// registers.
const GROUP: usize = 7;

/// Queries that a thread takes at a time from a batch.
const BATCH: usize = 8;

/// One number for each point of a block.
#[derive(Debug, Clone, Copy)]
#[repr(align(64))]
struct Lanes([f64; BLOCK]);

impl Lanes {
    const ZERO: Self = Self([0.0; BLOCK]);

    /// The sum by halves: the same order, and so the same bits, on every instruction set.
    fn sum(mut self) -> f64 {
        let mut width = BLOCK;
        while width > 1 {
            width /= 2;
            let (low, high) = self.0.split_at_mut(width);
            low.iter_mut().zip(high).for_each(|(low, high)| *low += *high);
        }
        self.0[0]
    }
}

/// The predictive means of several Gaussian processes, one output each: sums over shared points,
/// with a kernel for each output.
///
/// ```text
/// f_c(x) = sum_i alpha_ci k_c(x, x_i),   i = 1 .. n
/// ```
///
/// Rasmussen & Williams 2006, equation 2.27. Distances are formed from `x - x_i` and never from
/// the expanded square, so that near points keep their digits. The order of the additions is
/// fixed: a query gives the same bits alone, in a batch, on any number of threads, and on every
/// instruction set with a fused multiply-add (AVX2, AVX-512, NEON).
///
/// # Examples
///
/// ```
/// use gaussian_process::{GaussianKernel, KernelSum};
///
/// let kernel = GaussianKernel { signal_variance: 4.0, length_scales: vec![0.5] };
/// let sum = KernelSum::new(&[0.0, 1.0], 1, &[kernel], &[vec![1.0, -1.0]])?;
/// let mut f = [0.0];
/// sum.evaluate_into(&[0.0], &mut f);
/// assert!((f[0] - 4.0 * (1.0 - f64::exp(-2.0))).abs() < 1e-15);
/// # Ok::<(), gaussian_process::GpError>(())
/// ```
#[derive(Debug, Clone)]
pub struct KernelSum {
    kernels: Vec<GaussianKernel>,
    len: usize,
    inputs: usize,
    /// `[block][input]`; the last block is filled up with zeros.
    points: Vec<Lanes>,
    groups: Vec<PanelGroup>,
}

/// Up to [`GROUP`] outputs.
#[derive(Debug, Clone)]
struct PanelGroup {
    outputs: usize,
    /// `-1/2 / length_scales²`, `[input][output]`.
    weights: Vec<f64>,
    /// `[block][output]`; zero where there is no point.
    alpha: Vec<Lanes>,
}

impl KernelSum {
    /// The sum over `points`, row-major `n x inputs`, with one kernel and one row of `n` weights
    /// `alpha` for each output.
    ///
    /// # Errors
    ///
    /// [`GpError::NoPoints`], [`GpError::WrongLength`], [`GpError::NotFinite`],
    /// [`GpError::NotPositive`].
    pub fn new(
        points: &[f64],
        inputs: usize,
        kernels: &[GaussianKernel],
        alpha: &[Vec<f64>],
    ) -> Result<Self, GpError> {
        let len = points.len().checked_div(inputs).unwrap_or(0);
        if len == 0 {
            return Err(GpError::NoPoints);
        }
        check("points", points, len * inputs)?;
        if alpha.len() != kernels.len() || kernels.is_empty() {
            let expected = kernels.len().max(1);
            return Err(GpError::WrongLength { vector: "alpha", expected, got: alpha.len() });
        }
        for (kernel, alpha) in kernels.iter().zip(alpha) {
            check("length_scales", &kernel.length_scales, inputs)?;
            kernel.check()?;
            check("alpha", alpha, len)?;
        }
        let groups = kernels.chunks(GROUP).zip(alpha.chunks(GROUP));
        Ok(Self {
            kernels: kernels.to_vec(),
            len,
            inputs,
            points: into_blocks(len, inputs, |i, d| points[i * inputs + d]),
            groups: groups.map(|(kernels, alpha)| PanelGroup::new(kernels, alpha)).collect(),
        })
    }

    /// Number of points `n`.
    #[allow(clippy::len_without_is_empty, reason = "a sum over no points is refused")]
    pub fn len(&self) -> usize {
        self.len
    }

    /// Number of inputs of a point.
    pub fn inputs(&self) -> usize {
        self.inputs
    }

    /// Number of outputs.
    pub fn outputs(&self) -> usize {
        self.kernels.len()
    }

    /// The kernels, one for each output.
    pub fn kernels(&self) -> &[GaussianKernel] {
        &self.kernels
    }

    /// The points as they were given, row-major `n x inputs`.
    pub fn points(&self) -> Vec<f64> {
        let at = |i: usize, d: usize| self.points[i / BLOCK * self.inputs + d].0[i % BLOCK];
        (0..self.len).flat_map(|i| (0..self.inputs).map(move |d| at(i, d))).collect()
    }

    /// The weights of output `c` as they were given.
    ///
    /// # Panics
    ///
    /// When there is no output `c`.
    pub fn alpha(&self, c: usize) -> Vec<f64> {
        let (group, c) = (&self.groups[c / GROUP], c % GROUP);
        let blocks = group.alpha.iter().skip(c).step_by(group.outputs);
        blocks.flat_map(|lanes| lanes.0).take(self.len).collect()
    }

    /// Writes `f_c(x)` for every output to `out`; allocates nothing.
    ///
    /// Far from every point, where `k` is below 1e-307 of its signal variance, the sum is exactly
    /// zero. It is NaN where `x` contains a NaN.
    ///
    /// # Panics
    ///
    /// When `x` does not have [`Self::inputs`] entries or `out` not [`Self::outputs`].
    pub fn evaluate_into(&self, x: &[f64], out: &mut [f64]) {
        assert_eq!(x.len(), self.inputs, "inputs of the query");
        assert_eq!(out.len(), self.outputs(), "outputs of the query");
        for (group, out) in self.groups.iter().zip(out.chunks_mut(GROUP)) {
            match group.outputs {
                1 => self.sum_group::<1>(group, x, out),
                2 => self.sum_group::<2>(group, x, out),
                3 => self.sum_group::<3>(group, x, out),
                4 => self.sum_group::<4>(group, x, out),
                5 => self.sum_group::<5>(group, x, out),
                6 => self.sum_group::<6>(group, x, out),
                _ => self.sum_group::<GROUP>(group, x, out),
            }
        }
        for (f, kernel) in out.iter_mut().zip(&self.kernels) {
            *f *= kernel.signal_variance;
        }
    }

    /// [`Self::evaluate_into`] for many queries in parallel: `xs` is row-major `m x inputs`,
    /// `out` row-major `m x outputs`.
    ///
    /// # Panics
    ///
    /// When the lengths do not fit one another.
    pub fn evaluate_batch(&self, xs: &[f64], out: &mut [f64]) {
        assert_eq!(xs.len() / self.inputs * self.outputs(), out.len(), "outputs of the batch");
        assert_eq!(xs.len() % self.inputs, 0, "inputs of the batch");
        let queries = xs.par_chunks_exact(self.inputs);
        let rows = out.par_chunks_exact_mut(self.outputs());
        let batch = queries.zip(rows).with_min_len(BATCH);
        batch.for_each(|(x, out)| self.evaluate_into(x, out));
    }

    /// Writes `k_c(x, x_i)` for every point to `k_star`; allocates nothing.
    ///
    /// # Panics
    ///
    /// When there is no output `c`, `x` does not have [`Self::inputs`] entries or `k_star` not
    /// [`Self::len`].
    pub fn covariances_into(&self, c: usize, x: &[f64], k_star: &mut [f64]) {
        assert_eq!(x.len(), self.inputs, "inputs of the query");
        assert_eq!(k_star.len(), self.len, "length of k_star");
        let variance = self.kernels[c].signal_variance;
        let group = &self.groups[c / GROUP];
        let (points, output) = (&self.points, c % GROUP);
        Arch::new().dispatch(Covariances { points, x, group, output, variance, k_star });
    }

    fn sum_group<const C: usize>(&self, group: &PanelGroup, x: &[f64], out: &mut [f64]) {
        let sum = GroupSum::<C> { points: &self.points, x, group };
        out.copy_from_slice(&Arch::new().dispatch(sum));
    }
}

impl PanelGroup {
    fn new(kernels: &[GaussianKernel], alpha: &[Vec<f64>]) -> Self {
        // A width whose square underflows has the largest weight: 1 at the point, 0 elsewhere.
        let weight = |l: f64| (-0.5 / (l * l)).max(-f64::MAX);
        let inputs = 0..kernels[0].inputs();
        Self {
            outputs: kernels.len(),
            weights: inputs
                .flat_map(|d| kernels.iter().map(move |k| weight(k.length_scales[d])))
                .collect(),
            alpha: into_blocks(alpha[0].len(), alpha.len(), |i, c| alpha[c][i]),
        }
    }
}

/// The rows `i < len` of `at(i, column)` as `[block][column]`, the last block filled with zeros.
fn into_blocks(len: usize, columns: usize, at: impl Fn(usize, usize) -> f64) -> Vec<Lanes> {
    let mut blocks = vec![Lanes::ZERO; len.div_ceil(BLOCK) * columns];
    for i in 0..len {
        for column in 0..columns {
            blocks[i / BLOCK * columns + column].0[i % BLOCK] = at(i, column);
        }
    }
    blocks
}

/// The vectors of a row of a block, by twos: as many as keep the exponents of [`GROUP`] outputs in
/// the registers of AVX-512, and enough for the other instruction sets.
#[inline(always)]
fn pairs<S: Simd>(lanes: &Lanes) -> &[[S::f64s; 2]] {
    S::as_simd_f64s(&lanes.0).0.as_chunks().0
}

#[inline(always)]
fn pairs_mut<S: Simd>(lanes: &mut Lanes) -> &mut [[S::f64s; 2]] {
    S::as_mut_simd_f64s(&mut lanes.0).0.as_chunks_mut().0
}

/// Exponents of a pair of vectors of points, for `C` outputs:
///
/// ```text
/// s_c = sum_d weights_dc (x_id - x_d)²
/// ```
///
/// `terms` gives, for each input, its row of the block, the query and the weights.
#[inline(always)]
fn exponents<'a, S: Simd, const C: usize>(
    simd: S,
    pair: usize,
    terms: impl Iterator<Item = ((&'a Lanes, &'a f64), [f64; C])>,
) -> [[S::f64s; C]; 2] {
    let mut s = [[simd.splat_f64s(0.0); C]; 2];
    for ((lanes, x), weights) in terms {
        let points = pairs::<S>(lanes)[pair];
        let x = simd.splat_f64s(*x);
        for v in 0..2 {
            let distance = simd.sub_f64s(points[v], x);
            let square = simd.mul_f64s(distance, distance);
            for c in 0..C {
                s[v][c] = simd.mul_add_e_f64s(square, simd.splat_f64s(weights[c]), s[v][c]);
            }
        }
    }
    s
}

/// `sum_i alpha_ci exp(s_ci)` of the `C` outputs of a group.
struct GroupSum<'a, const C: usize> {
    points: &'a [Lanes],
    x: &'a [f64],
    group: &'a PanelGroup,
}

impl<const C: usize> WithSimd for GroupSum<'_, C> {
    type Output = [f64; C];

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> [f64; C] {
        let (weights, _) = self.group.weights.as_chunks::<C>();
        let (alpha, _) = self.group.alpha.as_chunks::<C>();
        let mut sums = [Lanes::ZERO; C];
        for (block, alpha) in self.points.chunks_exact(self.x.len()).zip(alpha) {
            for pair in 0..BLOCK / (2 * S::F64_LANES) {
                let terms = block.iter().zip(self.x).zip(weights.iter().copied());
                let s = exponents::<S, C>(simd, pair, terms);
                let e = [exp_each(simd, s[0]), exp_each(simd, s[1])];
                for c in 0..C {
                    let alpha = pairs::<S>(&alpha[c])[pair];
                    let sum = &mut pairs_mut::<S>(&mut sums[c])[pair];
                    for v in 0..2 {
                        sum[v] = simd.mul_add_e_f64s(e[v][c], alpha[v], sum[v]);
                    }
                }
            }
        }
        sums.map(Lanes::sum)
    }
}

/// `variance exp(s_ci)` for output `output` of a group.
struct Covariances<'a> {
    points: &'a [Lanes],
    x: &'a [f64],
    group: &'a PanelGroup,
    output: usize,
    variance: f64,
    k_star: &'a mut [f64],
}

impl WithSimd for Covariances<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let variance = simd.splat_f64s(self.variance);
        let weights = self.group.weights.iter().skip(self.output).step_by(self.group.outputs);
        let blocks = self.points.chunks_exact(self.x.len());
        for (block, k_star) in blocks.zip(self.k_star.chunks_mut(BLOCK)) {
            let mut k = Lanes::ZERO;
            for (pair, k) in pairs_mut::<S>(&mut k).iter_mut().enumerate() {
                let terms = block.iter().zip(self.x).zip(weights.clone().map(|&w| [w]));
                let s = exponents::<S, 1>(simd, pair, terms);
                for (k, [s]) in k.iter_mut().zip(s) {
                    *k = simd.mul_f64s(variance, exp(simd, s));
                }
            }
            k_star.copy_from_slice(&k.0[..k_star.len()]);
        }
    }
}

#[cfg(test)]
mod tests {
    use pulp::{Arch, Scalar, Simd, WithSimd};
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::{GROUP, GroupSum, KernelSum};
    use crate::error::GpError;
    use crate::kernel::GaussianKernel;

    struct Problem {
        points: Vec<f64>,
        kernels: Vec<GaussianKernel>,
        alpha: Vec<Vec<f64>>,
        x: Vec<f64>,
    }

    impl Problem {
        fn new(n: usize, inputs: usize, outputs: usize) -> Self {
            let mut rng = ChaCha8Rng::seed_from_u64((n + 1000 * inputs + 100_000 * outputs) as u64);
            let mut draw = |count: usize, low: f64, high: f64| -> Vec<f64> {
                (0..count).map(|_| rng.random_range(low..high)).collect()
            };
            let kernel = |numbers: Vec<f64>| GaussianKernel {
                signal_variance: numbers[0],
                length_scales: numbers[1..].to_vec(),
            };
            Self {
                points: draw(n * inputs, -2.0, 2.0),
                kernels: (0..outputs).map(|_| kernel(draw(1 + inputs, 0.5, 4.0))).collect(),
                alpha: (0..outputs).map(|_| draw(n, -1.0, 1.0)).collect(),
                x: draw(inputs, -2.0, 2.0),
            }
        }

        fn sum(&self) -> KernelSum {
            KernelSum::new(&self.points, self.x.len(), &self.kernels, &self.alpha).unwrap()
        }

        fn evaluate(&self, x: &[f64]) -> Vec<f64> {
            let mut out = vec![f64::NAN; self.kernels.len()];
            self.sum().evaluate_into(x, &mut out);
            out
        }

        /// The plain double loop, with the sum of the absolute terms beside it.
        fn oracle(&self, x: &[f64]) -> Vec<(f64, f64)> {
            let terms = |(kernel, alpha): (&GaussianKernel, &Vec<f64>)| {
                let points = self.points.chunks_exact(self.x.len());
                let terms = alpha.iter().zip(points).map(|(a, x_i)| a * kernel.value(x, x_i));
                terms.fold((0.0, 0.0), |(f, size), term| (f + term, size + term.abs()))
            };
            self.kernels.iter().zip(&self.alpha).map(terms).collect()
        }
    }

    #[test]
    fn sum_agrees_with_the_plain_double_loop() {
        for outputs in [1, 2, 3, 4, 5, 6, 7, 8, 9, 14] {
            for inputs in [1, 21, 28] {
                for n in [1, 15, 16, 17, 33, 100] {
                    let problem = Problem::new(n, inputs, outputs);
                    let f = problem.evaluate(&problem.x);
                    for (c, (expected, size)) in problem.oracle(&problem.x).into_iter().enumerate()
                    {
                        let distance = (f[c] - expected).abs();
                        assert!(distance <= 1e-12 * size, "{n} {inputs} {outputs}: {distance:e}");
                    }
                }
            }
        }
    }

    #[test]
    fn every_instruction_set_gives_the_same_sum() {
        let problem = Problem::new(1001, 21, GROUP);
        let (sum, scale) = (problem.sum(), problem.oracle(&problem.x));
        let op = || GroupSum::<GROUP> { points: &sum.points, x: &problem.x, group: &sum.groups[0] };
        let best = Arch::new().dispatch(op());
        let scalar = op().with_simd(Scalar);
        for c in 0..GROUP {
            let size = scale[c].1 / problem.kernels[c].signal_variance;
            assert!((best[c] - scalar[c]).abs() <= 1e-12 * size);
        }
        #[cfg(target_arch = "x86_64")]
        if let Some(simd) = pulp::x86::V3::try_new() {
            assert_eq!(Simd::vectorize(simd, op()).map(f64::to_bits), best.map(f64::to_bits));
        }
    }

    #[test]
    fn batch_has_the_bits_of_the_single_queries_on_any_number_of_threads() {
        let problem = Problem::new(50, 3, 9);
        let (sum, xs) = (problem.sum(), Problem::new(101, 3, 1).points);
        let singly: Vec<f64> = xs.chunks_exact(3).flat_map(|x| problem.evaluate(x)).collect();
        for threads in [1, 2, 5] {
            let mut out = vec![f64::NAN; 101 * 9];
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| sum.evaluate_batch(&xs, &mut out));
            assert!(out.iter().zip(&singly).all(|(a, b)| a.to_bits() == b.to_bits()));
        }
        sum.evaluate_batch(&[], &mut []);
    }

    #[test]
    fn covariances_are_those_of_the_kernel() {
        let problem = Problem::new(37, 21, 9);
        let sum = problem.sum();
        for (c, kernel) in problem.kernels.iter().enumerate() {
            let mut k_star = vec![f64::NAN; 37];
            sum.covariances_into(c, &problem.x, &mut k_star);
            for (k, x_i) in k_star.iter().zip(problem.points.chunks_exact(21)) {
                let expected = kernel.value(&problem.x, x_i);
                assert!((k - expected).abs() <= 1e-12 * expected, "{k:e} {expected:e}");
            }
        }
    }

    #[test]
    fn a_query_allocates_nothing() {
        let problem = Problem::new(100, 21, 9);
        let (sum, mut out, mut k_star) = (problem.sum(), vec![0.0; 9], vec![0.0; 100]);
        let counted = allocation_counter::measure(|| {
            sum.evaluate_into(&problem.x, &mut out);
            sum.covariances_into(8, &problem.x, &mut k_star);
        });
        assert_eq!(counted.count_total, 0);
        // The counter does count.
        assert!(allocation_counter::measure(|| drop(sum.points())).count_total > 0);
    }

    #[test]
    fn sum_is_linear_in_alpha() {
        let [mut a, b] = [Problem::new(60, 4, 3), Problem::new(60, 4, 3)];
        a.alpha.iter_mut().flatten().enumerate().for_each(|(i, v)| *v = (i as f64).sin());
        let (f_a, f_b) = (a.evaluate(&a.x), b.evaluate(&a.x));
        for (a, b) in a.alpha.iter_mut().flatten().zip(b.alpha.iter().flatten()) {
            *a -= 2.0 * b;
        }
        for (c, f) in a.evaluate(&a.x).into_iter().enumerate() {
            let expected = f_a[c] - 2.0 * f_b[c];
            assert!((f - expected).abs() <= 1e-12 * (1.0 + f_b[c].abs()), "{f} {expected}");
        }
    }

    #[test]
    fn far_away_the_sum_is_zero_and_nan_is_passed_on() {
        let problem = Problem::new(20, 2, 2);
        for far in [1e3, -1e200, f64::INFINITY] {
            assert_eq!(problem.evaluate(&[far, 0.0]), [0.0, 0.0]);
        }
        assert!(problem.evaluate(&[0.0, f64::NAN]).iter().all(|f| f.is_nan()));
    }

    #[test]
    fn near_points_far_from_the_origin_keep_their_digits() {
        let kernel = GaussianKernel { signal_variance: 1.0, length_scales: vec![0.125] };
        let sum = KernelSum::new(&[1e6], 1, &[kernel], &[vec![1.0]]).unwrap();
        let mut f = [0.0];
        sum.evaluate_into(&[1e6 + 0.125], &mut f);
        assert!((f[0] - f64::exp(-0.5)).abs() < 1e-15);
    }

    #[test]
    fn a_width_whose_square_underflows_separates_all_points() {
        let kernel = GaussianKernel { signal_variance: 1.0, length_scales: vec![1e-200] };
        let sum = KernelSum::new(&[0.0, 1.0], 1, &[kernel], &[vec![3.0, 4.0]]).unwrap();
        let mut f = [0.0];
        sum.evaluate_into(&[1.0], &mut f);
        assert!((f[0] - 4.0).abs() < 1e-15);
    }

    #[test]
    fn what_the_sum_was_made_of_comes_back() {
        let problem = Problem::new(35, 5, 9);
        let sum = problem.sum();
        assert_eq!((sum.len(), sum.inputs(), sum.outputs()), (35, 5, 9));
        assert_eq!(sum.points(), problem.points);
        assert_eq!(sum.kernels(), problem.kernels);
        let alpha: Vec<Vec<f64>> = (0..9).map(|c| sum.alpha(c)).collect();
        assert_eq!(alpha, problem.alpha);
    }

    #[test]
    fn unusable_input_is_refused() {
        let kernel = |l: &[f64]| GaussianKernel { signal_variance: 1.0, length_scales: l.to_vec() };
        let refusal = |points: &[f64], inputs, kernels: &[GaussianKernel], alpha: &[Vec<f64>]| {
            KernelSum::new(points, inputs, kernels, alpha).unwrap_err()
        };
        let wrong = |vector, expected, got| GpError::WrongLength { vector, expected, got };
        let (one, one_alpha) = ([kernel(&[1.0])], [vec![1.0]]);
        assert_eq!(refusal(&[], 1, &one, &one_alpha), GpError::NoPoints);
        assert_eq!(refusal(&[1.0], 0, &one, &one_alpha), GpError::NoPoints);
        assert_eq!(refusal(&[1.0; 3], 2, &one, &one_alpha), wrong("points", 2, 3));
        assert_eq!(refusal(&[1.0; 2], 2, &one, &one_alpha), wrong("length_scales", 2, 1));
        assert_eq!(refusal(&[1.0], 1, &[], &[]), wrong("alpha", 1, 0));
        assert_eq!(refusal(&[1.0], 1, &one, &[]), wrong("alpha", 1, 0));
        assert_eq!(refusal(&[1.0, 2.0], 1, &one, &one_alpha), wrong("alpha", 2, 1));
        let zero = GpError::NotPositive { name: "length scale", value: 0.0 };
        assert_eq!(refusal(&[1.0], 1, &[kernel(&[0.0])], &one_alpha), zero);
        let infinite = |vector| GpError::NotFinite { vector, index: 0, value: f64::INFINITY };
        assert_eq!(refusal(&[f64::INFINITY], 1, &one, &one_alpha), infinite("points"));
        assert_eq!(refusal(&[1.0], 1, &one, &[vec![f64::INFINITY]]), infinite("alpha"));
    }
}
