//! The loop that the products of matrices here are made of.

use std::array;

use pulp::Simd;

use crate::panels::ROWS;

/// What an entry of a tile becomes, given a row of `A` and a row of `B`.
pub(crate) trait Entry: Copy {
    /// `sum` and the share of one entry of each row.
    fn add<S: Simd>(self, simd: S, a: S::f64s, b: S::f64s, sum: S::f64s) -> S::f64s;

    /// The new entry of `C`, given the old one and the sum over the rows.
    fn finish<S: Simd>(self, simd: S, c: S::f64s, sum: S::f64s) -> S::f64s;
}

/// The product of matrices: `keep C + sign A B'`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct MatrixProduct {
    pub keep: f64,
    pub sign: f64,
}

impl MatrixProduct {
    /// `A B'`
    pub const SET: Self = Self { keep: 0.0, sign: 1.0 };
    /// `C + A B'`
    pub const ADD: Self = Self { keep: 1.0, sign: 1.0 };
}

impl Entry for MatrixProduct {
    #[inline(always)]
    fn add<S: Simd>(self, simd: S, a: S::f64s, b: S::f64s, sum: S::f64s) -> S::f64s {
        simd.mul_add_e_f64s(a, b, sum)
    }

    #[inline(always)]
    fn finish<S: Simd>(self, simd: S, c: S::f64s, sum: S::f64s) -> S::f64s {
        let kept = simd.mul_f64s(simd.splat_f64s(self.keep), c);
        simd.mul_add_e_f64s(simd.splat_f64s(self.sign), sum, kept)
    }
}

/// Every entry of the square block `c` from the panels `a` and `b` of as many columns: its rows
/// are those of `a`, its columns the rows of `b`.
#[inline(always)]
pub(crate) fn square<S: Simd, E: Entry>(simd: S, a: &[f64], b: &[f64], c: &mut [f64], entry: E) {
    // 24 sums and 3 registers of A leave 5 of 32 for B; 12 and 2 leave 2 of 16.
    if S::REGISTER_COUNT >= 32 {
        tiles::<S, E, 3, 8>(simd, a, b, c, entry);
    } else {
        tiles::<S, E, 2, 6>(simd, a, b, c, entry);
    }
}

/// Tiles of so many registers by so many columns.
#[inline(always)]
fn tiles<S: Simd, E: Entry, const REGISTERS: usize, const COLUMNS: usize>(
    simd: S,
    a: &[f64],
    b: &[f64],
    c: &mut [f64],
    entry: E,
) {
    for (tile, c) in c.chunks_exact_mut(ROWS * COLUMNS).enumerate() {
        for first in (0..ROWS / S::F64_LANES).step_by(REGISTERS) {
            let at = (first, tile * COLUMNS);
            let sums = sums::<S, E, REGISTERS, COLUMNS>(simd, (a, b), at, entry);
            for (column, sums) in c.as_chunks_mut::<ROWS>().0.iter_mut().zip(&sums) {
                let column = &mut S::as_mut_simd_f64s(column).0[first..];
                for (c, &sum) in column.iter_mut().zip(sums) {
                    *c = entry.finish(simd, *c, sum);
                }
            }
        }
    }
}

/// The sums of the registers from `first` of the rows of `a` and the rows from `second` of `b`.
#[inline(always)]
fn sums<S: Simd, E: Entry, const REGISTERS: usize, const COLUMNS: usize>(
    simd: S,
    (a, b): (&[f64], &[f64]),
    (first, second): (usize, usize),
    entry: E,
) -> [[S::f64s; REGISTERS]; COLUMNS] {
    assert!(second + COLUMNS <= ROWS && (first + REGISTERS) * S::F64_LANES <= ROWS);
    let mut sums = [[simd.splat_f64s(0.0); REGISTERS]; COLUMNS];
    for (a, b) in a.as_chunks::<ROWS>().0.iter().zip(b.as_chunks::<ROWS>().0) {
        let a = S::as_simd_f64s(a).0;
        let a: [S::f64s; REGISTERS] = array::from_fn(|v| a[first + v]);
        for (j, sums) in sums.iter_mut().enumerate() {
            let b = simd.splat_f64s(b[second + j]);
            for (sum, &a) in sums.iter_mut().zip(&a) {
                *sum = entry.add(simd, a, b, *sum);
            }
        }
    }
    sums
}

/// Every instruction set of this machine that the loops are compiled for.
#[cfg(test)]
pub(crate) fn every_arch() -> Vec<pulp::Arch> {
    let mut all = vec![pulp::Arch::Scalar, pulp::Arch::new()];
    #[cfg(target_arch = "x86_64")]
    all.extend(pulp::x86::V3::try_new().map(pulp::Arch::V3));
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::panels::{Panels, SQUARE};
    use pulp::WithSimd;

    struct Square<'a>(&'a Panels, &'a Panels, &'a mut [f64], MatrixProduct);

    impl WithSimd for Square<'_> {
        type Output = ();

        #[inline(always)]
        fn with_simd<S: Simd>(self, simd: S) {
            square(simd, self.0.panel(1), self.1.panel(0), self.2, self.3);
        }
    }

    #[test]
    fn square_is_the_product_of_two_panels() {
        // Small integers: sums are exact, whatever their order.
        let a = |i: usize, k: usize| ((3 * i + 5 * k) % 11) as f64 - 4.0;
        let b = |i: usize, k: usize| ((7 * i + 2 * k) % 13) as f64 - 6.0;
        let (left, right) = (Panels::new(2 * ROWS, 9, a), Panels::new(ROWS, 9, b));
        for arch in every_arch() {
            for product in
                [MatrixProduct::SET, MatrixProduct::ADD, MatrixProduct { keep: 1.0, sign: -1.0 }]
            {
                let mut c: Vec<f64> = (0..SQUARE).map(|i| i as f64).collect();
                arch.dispatch(Square(&left, &right, &mut c, product));
                for (at, &value) in c.iter().enumerate() {
                    let (row, column) = (at % ROWS, at / ROWS);
                    let sum: f64 = (0..9).map(|k| a(ROWS + row, k) * b(column, k)).sum();
                    let expected = product.keep * at as f64 + product.sign * sum;
                    assert_eq!(value.to_bits(), expected.to_bits(), "{arch:?} {row} {column}");
                }
            }
        }
    }
}
