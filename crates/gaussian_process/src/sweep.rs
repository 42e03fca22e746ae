use std::ops::Range;

use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;

use crate::packed::{Packed, PanelGroup};
use crate::panels::{self, Panels, ROWS, SQUARE};
use crate::tile::{self, MatrixProduct};

/// Panels of a pivot block. 96 columns: less reads and writes the matrix more often, more takes
/// longer for the blocks themselves.
const PIVOT: usize = 4;

/// Columns of a pivot block: so many numbers a row are needed beside the matrix.
pub(crate) const COLUMNS: usize = PIVOT * ROWS;

/// Panels that a thread updates together.
const GROUP: usize = 8;

/// Panels of `Q` that a group of panels is updated with before the next: 0.6 MB, which stay in
/// the second cache.
const BLOCK: usize = 32;

/// A pivot that is not a positive number: the matrix is not positive definite.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct BadPivot {
    /// Its row.
    pub row: usize,
    /// Its value.
    pub pivot: f64,
}

/// Puts `K^-1` in the place of a symmetric positive definite `K`, and returns `log det K`.
///
/// The symmetric sweep, a block of pivots at a time. With `D = L L'` the block, `P` its columns
/// and
///
/// ```text
/// Q = P L^-T   outside the block,   Q = L^-T   in the rows of the block,
/// ```
///
/// every other entry becomes `K_ij - Q_i Q_j'` and those of the block's rows and columns
/// `Q_i Q_j'`, in `n³` operations for all blocks. The sign of an entry is turned when the second
/// of its indices has been swept, so that what stands there in the end is `K^-1`. Cholesky's
/// pivots are those of Rasmussen & Williams 2006, algorithm 2.1.
///
/// An entry is computed by one thread in one order: the result does not depend on their number.
pub(crate) fn invert(k: &mut Packed, arch: Arch) -> Result<f64, BadPivot> {
    let mut q = vec![0.0; k.panels() * PIVOT * SQUARE];
    let mut log_determinant = 0.0;
    for first in (0..k.panels()).step_by(PIVOT) {
        let pivot = first..(first + PIVOT).min(k.panels());
        let width = pivot.len() * SQUARE;
        let mut d = diagonal_block(k, &pivot);
        log_determinant += arch
            .dispatch(Factor { d: &mut d, n: pivot.len() * ROWS })
            .map_err(|(row, pivot)| BadPivot { row: first * ROWS + row, pivot })?;
        let q = &mut q[..k.panels() * width];
        outer_factor(k, &pivot, &d, q, arch);
        let q = &*q;
        k.groups_mut(GROUP).into_par_iter().with_max_len(1).rev().for_each(|group| {
            arch.dispatch(Update { pivot: pivot.clone(), q, group });
        });
    }
    Ok(log_determinant)
}

/// The lower triangle of the pivot block, row-major.
fn diagonal_block(k: &Packed, pivot: &Range<usize>) -> Vec<f64> {
    let n = pivot.len() * ROWS;
    let mut d = vec![0.0; n * n];
    for (row, d) in d.chunks_exact_mut(n).enumerate() {
        let panel = &k.panel(pivot.start + row / ROWS)[pivot.start * SQUARE..];
        for (column, d) in d[..=row].iter_mut().enumerate() {
            *d = panel[column * ROWS + row % ROWS];
        }
    }
    d
}

/// Puts `L^-1` in the place of the lower triangle of `D = L L'` (row-major, `n` rows) and
/// returns `log det D`, or the first bad pivot.
///
/// Elimination of `[D, 1]`, of which a row needs `n` places: what has become zero on the left
/// leaves room for what is no longer zero on the right.
struct Factor<'a> {
    d: &'a mut [f64],
    n: usize,
}

impl WithSimd for Factor<'_> {
    type Output = Result<f64, (usize, f64)>;

    #[inline(always)]
    fn with_simd<S: Simd>(self, _: S) -> Self::Output {
        let n = self.n;
        let mut log_determinant = 0.0;
        // Row j of L^-1 up to the diagonal, column j of L below it.
        let mut r = vec![0.0; n];
        for j in 0..n {
            let (above, below) = self.d.split_at_mut(n * (j + 1));
            let row = &mut above[n * j..=n * j + j];
            let pivot = row[j];
            if !(pivot > 0.0 && pivot.is_finite()) {
                return Err((j, pivot));
            }
            log_determinant += pivot.ln();
            let scale = 1.0 / pivot.sqrt();
            row[j] = 1.0;
            for (r, x) in r.iter_mut().zip(row.iter_mut()) {
                *x *= scale;
                *r = *x;
            }
            for (r, row) in r[j + 1..].iter_mut().zip(below.chunks_exact_mut(n)) {
                *r = scale * row[j];
                row[j] = 0.0;
            }
            for (i, row) in (j + 1..n).zip(below.chunks_exact_mut(n)) {
                let l = r[i];
                for (x, &r) in row[..=i].iter_mut().zip(&r[..=i]) {
                    *x -= l * r;
                }
            }
        }
        Ok(log_determinant)
    }
}

/// `Q` in panels, from `L^-1` (row-major).
fn outer_factor(k: &Packed, pivot: &Range<usize>, l_inverse: &[f64], q: &mut [f64], arch: Arch) {
    let n = pivot.len() * ROWS;
    let entry = |row: usize, column: usize| {
        if column <= row { l_inverse[row * n + column] } else { 0.0 }
    };
    let rows = Panels::new(n, n, entry);
    let width = n * ROWS;
    q[pivot.start * width..pivot.end * width]
        .copy_from_slice(Panels::new(n, n, |row, column| entry(column, row)).values());
    q.par_chunks_exact_mut(width).enumerate().filter(|(p, _)| !pivot.contains(p)).for_each(
        |(p, q)| arch.dispatch(Outside { k, pivot: pivot.clone(), p, l_inverse: &rows, q }),
    );
}

/// `Q = P L^-T` of panel `p`, outside the pivot block.
struct Outside<'a> {
    k: &'a Packed,
    pivot: Range<usize>,
    p: usize,
    l_inverse: &'a Panels,
    q: &'a mut [f64],
}

impl WithSimd for Outside<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let width = self.q.len();
        let mut transposed = [0.0; PIVOT * SQUARE];
        let columns = if self.p < self.pivot.start {
            for (r, out) in self.pivot.zip(transposed.chunks_exact_mut(SQUARE)) {
                panels::transpose(self.k.block(r, self.p), out);
            }
            &transposed[..width]
        } else {
            &self.k.panel(self.p)[self.pivot.start * SQUARE..][..width]
        };
        for (c, q) in self.q.chunks_exact_mut(SQUARE).enumerate() {
            // Panel c of the triangle ends with its diagonal block.
            let depth = (c + 1) * SQUARE;
            let l = &self.l_inverse.panel(c)[..depth];
            tile::square(simd, &columns[..depth], l, q, MatrixProduct::SET);
        }
    }
}

/// Every entry of a group of panels, given `Q`.
struct Update<'a> {
    pivot: Range<usize>,
    q: &'a [f64],
    group: PanelGroup<'a>,
}

impl WithSimd for Update<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(mut self, simd: S) {
        let width = self.pivot.len() * SQUARE;
        let q = |p: usize| &self.q[p * width..][..width];
        for start in (0..self.group.end).step_by(BLOCK) {
            for p in self.group.first..self.group.end {
                let panel = self.group.panel(p);
                for j in start..(start + BLOCK).min(p + 1) {
                    let (row, column) = (self.pivot.contains(&p), self.pivot.contains(&j));
                    let keep = if row || column { 0.0 } else { 1.0 };
                    let sign = if p < self.pivot.start || column { 1.0 } else { -1.0 };
                    let c = &mut panel[j * SQUARE..][..SQUARE];
                    tile::square(simd, q(p), q(j), c, MatrixProduct { keep, sign });
                }
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tile::every_arch;
    use faer::linalg::solvers::DenseSolveCore;
    use faer::{Mat, Side};

    /// A covariance over a line, of condition below 1e4, and a hash that breaks its regularity.
    fn entry(i: usize, j: usize) -> f64 {
        let distance = (i as f64 - j as f64) / 7.0;
        let noise = if i == j { 0.02 + ((i * 37) % 11) as f64 / 50.0 } else { 0.0 };
        (-0.5 * distance * distance).exp() + noise
    }

    /// Largest entry of `A K - 1`.
    fn distance_from_inverse(n: usize, a: impl Fn(usize, usize) -> f64) -> f64 {
        let error = |i: usize, j: usize| {
            let sum: f64 = (0..n).map(|t| a(i, t) * entry(t.max(j), t.min(j))).sum();
            (sum - f64::from(i == j)).abs()
        };
        (0..n).flat_map(|i| (0..n).map(move |j| error(i, j))).fold(0.0, f64::max)
    }

    #[test]
    fn sweep_gives_the_inverse_and_the_determinant_of_cholesky() {
        for n in [1, 2, 23, 24, 25, 95, 96, 97, 300] {
            let mut k = Packed::from_entries(n, entry);
            let log_determinant = invert(&mut k, Arch::new()).unwrap();
            let dense = Mat::from_fn(n, n, |i, j| entry(i.max(j), i.min(j)));
            let cholesky = dense.llt(Side::Lower).unwrap();
            let inverse = cholesky.inverse();
            let ours = distance_from_inverse(n, |i, j| k.entry(i, j));
            let theirs = distance_from_inverse(n, |i, j| inverse[(i, j)]);
            assert!(ours <= 3.0 * theirs + 1e-14, "n = {n}: {ours:e}, Cholesky {theirs:e}");
            let expected: f64 = (0..n).map(|i| 2.0 * cholesky.L()[(i, i)].ln()).sum();
            assert!((log_determinant - expected).abs() <= 1e-13 * n as f64, "n = {n}");
        }
    }

    #[test]
    fn instruction_sets_agree() {
        let n = 250;
        let inverse = |arch| {
            let mut k = Packed::from_entries(n, entry);
            (invert(&mut k, arch).unwrap(), k)
        };
        let (expected_log, expected) = inverse(Arch::Scalar);
        let largest = expected.diagonal().fold(0.0, f64::max);
        for arch in every_arch() {
            let (log, k) = inverse(arch);
            assert!((log / expected_log - 1.0).abs() <= 1e-13, "{arch:?}");
            for i in 0..n {
                for j in 0..=i {
                    let error = (k.entry(i, j) - expected.entry(i, j)).abs();
                    assert!(error <= 1e-12 * largest, "{arch:?} ({i}, {j}): {error:e}");
                }
            }
        }
    }

    #[test]
    fn the_number_of_threads_does_not_matter() {
        let inverse = |threads| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            let mut k = Packed::from_entries(500, entry);
            let log = pool.install(|| invert(&mut k, Arch::new())).unwrap();
            let panels: Vec<f64> = (0..k.panels()).flat_map(|p| k.panel(p).to_vec()).collect();
            (log.to_bits(), panels.into_iter().map(f64::to_bits).collect::<Vec<_>>())
        };
        let one = inverse(1);
        assert!(one == inverse(2) && one == inverse(3));
    }

    #[test]
    fn a_bad_pivot_is_named() {
        // 1 on the diagonal but for one entry: its pivot is that entry.
        let bad = |row: usize, value: f64| {
            let diagonal = move |i| if i == row { value } else { 1.0 };
            let entry = |i, j| if i == j { diagonal(i) } else { 0.0 };
            invert(&mut Packed::from_entries(120, entry), Arch::new())
        };
        assert_eq!(bad(100, -2.0), Err(BadPivot { row: 100, pivot: -2.0 }));
        assert_eq!(bad(3, 0.0), Err(BadPivot { row: 3, pivot: 0.0 }));
        assert_eq!(bad(97, f64::INFINITY), Err(BadPivot { row: 97, pivot: f64::INFINITY }));
        assert!(bad(24, f64::NAN).is_err_and(|bad| bad.row == 24 && bad.pivot.is_nan()));
        assert!(bad(24, 1.0).is_ok());
    }
}
