use std::array;

use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;

use crate::exp::exp;
use crate::packed::Packed;
use crate::panels::{Panels, ROWS, SQUARE};
use crate::tile::{self, Entry, MatrixProduct};

/// Registers of a panel's column that are summed together.
const REGISTERS: usize = 3;

/// The Gaussian kernel between points: `signal_variance exp(-1/2 |a - b|²)`.
#[derive(Debug, Clone, Copy)]
struct Gaussian {
    signal_variance: f64,
}

impl Entry for Gaussian {
    #[inline(always)]
    fn add<S: Simd>(self, simd: S, a: S::f64s, b: S::f64s, sum: S::f64s) -> S::f64s {
        let difference = simd.sub_f64s(a, b);
        simd.mul_add_e_f64s(difference, difference, sum)
    }

    #[inline(always)]
    fn finish<S: Simd>(self, simd: S, _: S::f64s, sum: S::f64s) -> S::f64s {
        let value = exp(simd, simd.mul_f64s(simd.splat_f64s(-0.5), sum));
        simd.mul_f64s(simd.splat_f64s(self.signal_variance), value)
    }
}

/// What the covariance of the targets is made of:
///
/// ```text
/// K = k(Z, Z) + F F' + diagonal I
/// ```
///
/// with `k` the Gaussian kernel of length 1, `Z` the inputs over their length scales and `F` the
/// features times the square roots of their weights.
#[derive(Debug)]
pub(crate) struct Gram {
    /// `Z`
    pub points: Panels,
    /// `F`
    pub features: Option<Panels>,
    pub signal_variance: f64,
    pub arch: Arch,
}

impl Gram {
    /// Puts `K` into `k`.
    pub fn assemble(&self, diagonal: f64, k: &mut Packed) {
        k.groups_mut(1).into_par_iter().rev().for_each(|mut group| {
            let (gram, p) = (self, group.first);
            self.arch.dispatch(Assemble { gram, p, panel: group.panel(p), diagonal });
        });
        k.fill(1.0);
    }

    /// What the gradient needs of `K^-1` and `alpha = K^-1 y`:
    ///
    /// ```text
    /// sum_ij w_ij,   sum_ij w_ij (Z_id - Z_jd)² for every input d,
    /// w = (K^-1 - alpha alpha') k(Z, Z), entry by entry,
    /// ```
    ///
    /// The kernel is computed again: to keep it would take a second matrix.
    pub fn contract(&self, inverse: &Packed, alpha: &[f64]) -> Vec<f64> {
        let panels: Vec<Vec<f64>> = (0..inverse.panels())
            .into_par_iter()
            .rev()
            .map(|p| self.arch.dispatch(Contract { gram: self, p, inverse, alpha }))
            .collect();
        // In the order of the panels, whichever was done first.
        let mut sums = vec![0.0; 1 + self.points.columns()];
        for panel in panels {
            for (sum, share) in sums.iter_mut().zip(panel) {
                *sum += share;
            }
        }
        sums
    }

    /// The kernel between the points of panels `p` and `j`.
    #[inline(always)]
    fn block<S: Simd>(&self, simd: S, (p, j): (usize, usize), k: &mut [f64]) {
        let entry = Gaussian { signal_variance: self.signal_variance };
        tile::square(simd, self.points.panel(p), self.points.panel(j), k, entry);
    }
}

/// Panel `p` of the covariance.
struct Assemble<'a> {
    gram: &'a Gram,
    p: usize,
    panel: &'a mut [f64],
    diagonal: f64,
}

impl WithSimd for Assemble<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        for (j, k) in self.panel.chunks_exact_mut(SQUARE).enumerate() {
            self.gram.block(simd, (self.p, j), k);
            if let Some(f) = &self.gram.features {
                tile::square(simd, f.panel(self.p), f.panel(j), k, MatrixProduct::ADD);
            }
        }
        for i in 0..ROWS {
            self.panel[self.p * SQUARE + i * ROWS + i] += self.diagonal;
        }
    }
}

/// The share of panel `p` and, by symmetry, of the columns that mirror it.
struct Contract<'a> {
    gram: &'a Gram,
    p: usize,
    inverse: &'a Packed,
    alpha: &'a [f64],
}

impl WithSimd for Contract<'_> {
    type Output = Vec<f64>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> Vec<f64> {
        let Self { gram, p, inverse, alpha } = self;
        // One sum a row, so that the order of the sums is that of no instruction set.
        let mut sums = vec![[0.0; ROWS]; 1 + gram.points.columns()];
        let mut w = [0.0; SQUARE];
        for j in 0..=p {
            gram.block(simd, (p, j), &mut w);
            weigh(simd, (&alpha[p * ROWS..], &alpha[j * ROWS..]), inverse.block(p, j), &mut w);
            if j < p {
                // The mirror image.
                w.iter_mut().for_each(|w| *w *= 2.0);
            }
            let (total, squares) = sums.split_at_mut(1);
            total_of(simd, &w, &mut total[0]);
            let a = gram.points.panel(p).as_chunks::<ROWS>().0;
            let b = gram.points.panel(j).as_chunks::<ROWS>().0;
            for ((a, b), sum) in a.iter().zip(b).zip(squares) {
                weighted_squares(simd, &w, (a, b), sum);
            }
        }
        sums.iter().map(|rows| rows.iter().sum()).collect()
    }
}

/// `w <- (K^-1_ij - alpha_i alpha_j) w` for a square block.
#[inline(always)]
fn weigh<S: Simd>(simd: S, (row, column): (&[f64], &[f64]), inverse: &[f64], w: &mut [f64]) {
    let row = S::as_simd_f64s(&row[..ROWS]).0;
    let blocks = w.chunks_exact_mut(ROWS).zip(inverse.chunks_exact(ROWS));
    for ((w, inverse), &column) in blocks.zip(column) {
        let column = simd.splat_f64s(column);
        let (w, inverse) = (S::as_mut_simd_f64s(w).0, S::as_simd_f64s(inverse).0);
        for ((w, &inverse), &row) in w.iter_mut().zip(inverse).zip(row) {
            *w = simd.mul_f64s(simd.negate_mul_add_e_f64s(row, column, inverse), *w);
        }
    }
}

/// `sum_i <- sum_i + sum_j w_ij`
#[inline(always)]
fn total_of<S: Simd>(simd: S, w: &[f64], sum: &mut [f64; ROWS]) {
    let sum = S::as_mut_simd_f64s(sum).0;
    for w in w.chunks_exact(ROWS) {
        for (sum, &w) in sum.iter_mut().zip(S::as_simd_f64s(w).0) {
            *sum = simd.add_f64s(*sum, w);
        }
    }
}

/// `sum_i <- sum_i + sum_j w_ij (a_i - b_j)²`
#[inline(always)]
fn weighted_squares<S: Simd>(
    simd: S,
    w: &[f64; SQUARE],
    (a, b): (&[f64; ROWS], &[f64; ROWS]),
    sum: &mut [f64; ROWS],
) {
    let a = S::as_simd_f64s(a).0;
    let sum = S::as_mut_simd_f64s(sum).0;
    for (a, (first, sum)) in
        a.chunks_exact(REGISTERS).zip((0..).step_by(REGISTERS).zip(sum.chunks_exact_mut(REGISTERS)))
    {
        let a: [S::f64s; REGISTERS] = array::from_fn(|v| a[v]);
        let mut s: [S::f64s; REGISTERS] = array::from_fn(|v| sum[v]);
        for (w, &b) in w.as_chunks::<ROWS>().0.iter().zip(b) {
            let b = simd.splat_f64s(b);
            let w = &S::as_simd_f64s(w).0[first..first + REGISTERS];
            for ((s, &a), &w) in s.iter_mut().zip(&a).zip(w) {
                let difference = simd.sub_f64s(a, b);
                *s = simd.mul_add_e_f64s(simd.mul_f64s(w, difference), difference, *s);
            }
        }
        sum.copy_from_slice(&s);
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::kernel::GaussianKernel;
    use crate::tile::every_arch;

    const N: usize = 55;
    const SIGNAL: f64 = 1.3;
    const DIAGONAL: f64 = 0.4;

    fn point(i: usize, d: usize) -> f64 {
        (1.7 * i as f64 + 0.9 * d as f64).sin()
    }

    fn feature(i: usize, m: usize) -> f64 {
        (0.6 * i as f64 - 1.1 * m as f64).cos()
    }

    fn kernel(i: usize, j: usize) -> f64 {
        let kernel = GaussianKernel { signal_variance: SIGNAL, length_scales: vec![1.0; 4] };
        let [a, b] = [i, j].map(|i| [0, 1, 2, 3].map(|d| point(i, d)));
        kernel.value(&a, &b)
    }

    #[test]
    fn the_covariance_is_kernel_features_and_diagonal() {
        for arch in every_arch() {
            let points = Panels::new(N, 4, point);
            let features = Some(Panels::new(N, 5, feature));
            let gram = Gram { points, features, signal_variance: SIGNAL, arch };
            let mut k = Packed::new(N);
            gram.assemble(DIAGONAL, &mut k);
            for (i, j) in (0..N).flat_map(|i| (0..=i).map(move |j| (i, j))) {
                let linear: f64 = (0..5).map(|m| feature(i, m) * feature(j, m)).sum();
                let noise = if i == j { DIAGONAL } else { 0.0 };
                let error = k.entry(i, j) - (kernel(i, j) + linear + noise);
                assert!(error.abs() < 1e-14, "{arch:?} ({i}, {j}): {error:e}");
            }
            assert_eq!(k.entry(N, N).to_bits(), 1.0_f64.to_bits());
        }
    }

    #[test]
    fn the_contraction_is_the_double_sum_it_stands_for() {
        let inverse = |i: usize, j: usize| 1.0 / (1.0 + (i + j) as f64);
        let mut matrix = Packed::from_entries(N, inverse);
        matrix.fill(0.0);
        let alpha: Vec<f64> = (0..72).map(|i| if i < N { point(i, 9) } else { 0.0 }).collect();
        let weight = |i: usize, j: usize| (inverse(i, j) - alpha[i] * alpha[j]) * kernel(i, j);
        let sum = |term: &dyn Fn(usize, usize) -> f64| -> f64 {
            (0..N).flat_map(|i| (0..N).map(move |j| (i, j))).map(|(i, j)| term(i, j)).sum()
        };
        let mut expected = vec![sum(&weight)];
        for d in 0..4 {
            let square = |i, j| (point(i, d) - point(j, d)).powi(2);
            expected.push(sum(&|i, j| weight(i, j) * square(i, j)));
        }
        for arch in every_arch() {
            let points = Panels::new(N, 4, point);
            let gram = Gram { points, features: None, signal_variance: SIGNAL, arch };
            for (ours, expected) in gram.contract(&matrix, &alpha).iter().zip(&expected) {
                assert!((ours - expected).abs() < 1e-11, "{arch:?}: {ours} {expected}");
            }
        }
    }
}
