use pulp::{Arch, Simd, WithSimd};
use rayon::prelude::*;

use crate::packed::Packed;
use crate::panels::{Panels, ROWS, SQUARE, transpose};
use crate::tile::{self, MatrixProduct};

/// Square blocks of the matrix that are multiplied by all columns before the next.
const BLOCKS: usize = 4;

/// `out = A x`, of as many entries as `A` has rows, without allocating.
pub(crate) fn multiply(a: &Packed, x: &[f64], out: &mut [f64], arch: Arch) {
    out.fill(0.0);
    arch.dispatch(Vector { a, x, out });
}

struct Vector<'a> {
    a: &'a Packed,
    x: &'a [f64],
    out: &'a mut [f64],
}

impl WithSimd for Vector<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { a, x, out } = self;
        for p in 0..a.panels() {
            let (left, diagonal) = a.panel(p).split_at(p * SQUARE);
            let (before, rows) = x.split_at(p * ROWS);
            let (above, out) = out.split_at_mut(p * ROWS);
            let mut own = [0.0; ROWS];
            let rows = &rows[..rows.len().min(ROWS)];
            own[..rows.len()].copy_from_slice(rows);
            let mut sum = [0.0; ROWS];
            for ((column, &x), above) in left.chunks_exact(ROWS).zip(before).zip(above) {
                *above += both(simd, column, (x, &own), &mut sum);
            }
            for (column, &x) in diagonal.chunks_exact(ROWS).zip(rows) {
                both(simd, column, (x, &own), &mut sum);
            }
            for (out, sum) in out.iter_mut().zip(sum) {
                *out += sum;
            }
        }
    }
}

/// `sum <- sum + column x`, and `column' own`.
#[inline(always)]
fn both<S: Simd>(
    simd: S,
    column: &[f64],
    (x, own): (f64, &[f64; ROWS]),
    sum: &mut [f64; ROWS],
) -> f64 {
    let x = simd.splat_f64s(x);
    let mut dot = simd.splat_f64s(0.0);
    let sums = S::as_mut_simd_f64s(sum).0.iter_mut();
    let columns = S::as_simd_f64s(column).0.iter().zip(S::as_simd_f64s(own).0);
    for (sum, (&column, &own)) in sums.zip(columns) {
        *sum = simd.mul_add_e_f64s(column, x, *sum);
        dot = simd.mul_add_e_f64s(column, own, dot);
    }
    simd.reduce_sum_f64s(dot)
}

/// `x' A x`, without allocating.
pub(crate) fn quadratic(a: &Packed, x: &[f64], arch: Arch) -> f64 {
    arch.dispatch(Quadratic { a, x })
}

struct Quadratic<'a> {
    a: &'a Packed,
    x: &'a [f64],
}

impl WithSimd for Quadratic<'_> {
    type Output = f64;

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) -> f64 {
        let Self { a, x } = self;
        let mut total = 0.0;
        for (p, rows) in x.chunks(ROWS).enumerate() {
            let (mut left, mut diagonal) = ([0.0; ROWS], [0.0; ROWS]);
            let (beside, own) = a.panel(p).split_at(p * SQUARE);
            accumulate(simd, beside, x, &mut left);
            accumulate(simd, own, rows, &mut diagonal);
            let sums = left.iter().zip(&diagonal);
            total += rows.iter().zip(sums).map(|(x, (l, d))| x * (2.0 * l + d)).sum::<f64>();
        }
        total
    }
}

/// `sum <- sum + A x` for some columns of a panel.
#[inline(always)]
fn accumulate<S: Simd>(simd: S, columns: &[f64], x: &[f64], sum: &mut [f64; ROWS]) {
    let sum = S::as_mut_simd_f64s(sum).0;
    for (column, &x) in columns.chunks_exact(ROWS).zip(x) {
        let x = simd.splat_f64s(x);
        for (sum, &column) in sum.iter_mut().zip(S::as_simd_f64s(column).0) {
            *sum = simd.mul_add_e_f64s(column, x, *sum);
        }
    }
}

/// `A X`, row-major, given `X'` in panels: every column of `X` is a row of `x`.
pub(crate) fn multiply_columns(a: &Packed, x: &Panels, columns: usize, arch: Arch) -> Vec<f64> {
    if columns == 0 {
        return Vec::new();
    }
    let mut out = vec![0.0; a.panels() * ROWS * columns];
    out.par_chunks_exact_mut(ROWS * columns).enumerate().for_each(|(p, out)| {
        arch.dispatch(Columns { a, x, p, columns, out });
    });
    out.truncate(a.rows() * columns);
    out
}

/// Panel `p` of the product.
struct Columns<'a> {
    a: &'a Packed,
    x: &'a Panels,
    p: usize,
    columns: usize,
    out: &'a mut [f64],
}

impl WithSimd for Columns<'_> {
    type Output = ();

    #[inline(always)]
    fn with_simd<S: Simd>(self, simd: S) {
        let Self { a, x, p, columns, out } = self;
        let panels = columns.div_ceil(ROWS);
        let mut sums = vec![0.0; panels * SQUARE];
        let mut mirrored = [0.0; BLOCKS * SQUARE];
        for start in (0..a.panels()).step_by(BLOCKS) {
            let end = (start + BLOCKS).min(a.panels());
            let rows = &mut mirrored[..(end - start) * SQUARE];
            for (j, rows) in (start..end).zip(rows.chunks_exact_mut(SQUARE)) {
                if j <= p {
                    rows.copy_from_slice(a.block(p, j));
                } else {
                    transpose(a.block(j, p), rows);
                }
            }
            for (f, sums) in sums.chunks_exact_mut(SQUARE).enumerate() {
                let x = &x.panel(f)[start * SQUARE..end * SQUARE];
                tile::square(simd, rows, x, sums, MatrixProduct::ADD);
            }
        }
        for (i, out) in out.chunks_exact_mut(columns).enumerate() {
            for (j, out) in out.iter_mut().enumerate() {
                *out = sums[j / ROWS * SQUARE + j % ROWS * ROWS + i];
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tile::every_arch;
    use pulp::Arch;

    const SIZES: [usize; 6] = [1, 23, 24, 25, 97, 150];

    // Small integers: sums are exact, whatever their order.
    fn entry(i: usize, j: usize) -> f64 {
        ((i * i + 3 * j * j + i * j) % 17) as f64 - 8.0
    }

    fn symmetric(i: usize, j: usize) -> f64 {
        entry(i.max(j), i.min(j))
    }

    fn x(i: usize, column: usize) -> f64 {
        ((5 * i + 7 * column) % 23) as f64 - 11.0
    }

    /// `A X` by its definition; row `i` of column `c`.
    fn product(n: usize, i: usize, c: usize) -> f64 {
        (0..n).map(|j| symmetric(i, j) * x(j, c)).sum()
    }

    /// The inverse has zeros where the last panel is filled up.
    fn matrix(n: usize) -> Packed {
        let mut matrix = Packed::from_entries(n, entry);
        matrix.fill(0.0);
        matrix
    }

    #[test]
    fn vector_and_quadratic_form_are_the_sums_they_stand_for() {
        for (n, arch) in
            SIZES.into_iter().flat_map(|n| every_arch().into_iter().map(move |a| (n, a)))
        {
            let vector: Vec<f64> = (0..n).map(|i| x(i, 3)).collect();
            let expected: Vec<f64> = (0..n).map(|i| product(n, i, 3)).collect();
            let mut out = vec![f64::NAN; n];
            multiply(&matrix(n), &vector, &mut out, arch);
            assert_eq!(out, expected, "{arch:?}, n = {n}");
            let form: f64 = vector.iter().zip(&expected).map(|(x, y)| x * y).sum();
            let error = quadratic(&matrix(n), &vector, arch) - form;
            assert_eq!(error.to_bits(), 0.0_f64.to_bits(), "{arch:?}, n = {n}");
        }
    }

    #[test]
    fn columns_are_multiplied_like_vectors() {
        for (n, columns) in SIZES.into_iter().flat_map(|n| [1, 24, 70].map(|c| (n, c))) {
            let rows = n.next_multiple_of(ROWS);
            let transposed = Panels::new(columns, rows, |c, i| if i < n { x(i, c) } else { 0.0 });
            let out = multiply_columns(&matrix(n), &transposed, columns, Arch::new());
            let expected = |at: usize| product(n, at / columns, at % columns);
            assert_eq!(out, (0..n * columns).map(expected).collect::<Vec<_>>(), "{n} {columns}");
        }
        let none = Panels::new(0, 24, |_, _| 0.0);
        assert!(multiply_columns(&matrix(5), &none, 0, Arch::new()).is_empty());
    }
}
