use crate::cholesky::rounding;
use crate::covariance::{ScaledPoints, check_points, dot};
use crate::error::{GpError, check};
use crate::kernel::GaussianKernel;
use faer::linalg::matmul::matmul;
use faer::linalg::triangular_solve::solve_lower_triangular_in_place;
use faer::{Accum, MatMut, MatRef, Par};
use rayon::prelude::*;

/// Candidates of the largest variance, among which the next points are sought. Of 128, 256,
/// 512 and 1024 it is the fastest for 4000 as for 10,000 candidates and 2000 points.
const FRONT: usize = 128;

/// Candidates that one task works on.
const PANEL: usize = 128;

/// Variances are taken as zero below this many times the rounding of a pivot, so that the points
/// chosen need no jitter.
const FLOOR: f64 = 4.0;

/// Indices of at most `m` of the candidates (row-major, `kernel.inputs()` numbers each), each the
/// one whose value the points chosen before it leave most uncertain:
///
/// ```text
/// variance(x) = k(x, x) - k_j(x)' K_jj^-1 k_j(x)
/// ```
///
/// which is the pivoted Cholesky decomposition of the candidates' covariance matrix (Fine &
/// Scheinberg 2001). There are fewer than `m` where the largest variance left is within rounding:
/// more points would add nothing.
///
/// The candidates stand for the samples: every k-th sample, so that 2 to 5 candidates come on
/// each point asked for. The memory is `8 m` bytes and the work `m²` operations per candidate: 2000
/// points of 10,000 candidates took 0.7 s of one core, a fourteenth of the time of the form that
/// brings every candidate up to date after every point.
///
/// # Errors
///
/// [`GpError::NoPoints`], [`GpError::WrongLength`], [`GpError::NotFinite`],
/// [`GpError::NotPositive`].
pub fn inducing_points(
    candidates: &[f64],
    kernel: &GaussianKernel,
    m: usize,
) -> Result<Vec<usize>, GpError> {
    kernel.check()?;
    let n = check_points("candidates", candidates, kernel.inputs())?;
    let m = m.min(n);
    let mut search = Search {
        candidates,
        kernel,
        rows: m,
        floor: FLOOR * rounding(m, kernel.signal_variance),
        variances: vec![kernel.signal_variance; n],
        whitened: vec![0.0; n * m],
        chosen: Vec::with_capacity(m),
    };
    while search.chosen.len() < m && search.advance() {}
    Ok(search.chosen)
}

/// One kernel to choose points that several outputs share: the geometric means of the length scales
/// and of the signal variances.
///
/// # Errors
///
/// [`GpError::NoPoints`] without kernels, [`GpError::WrongLength`] when they differ in their number
/// of inputs, [`GpError::NotFinite`], [`GpError::NotPositive`].
pub fn shared_kernel(kernels: &[GaussianKernel]) -> Result<GaussianKernel, GpError> {
    let first = kernels.first().ok_or(GpError::NoPoints)?;
    for kernel in kernels {
        check("length_scales", &kernel.length_scales, first.inputs())?;
        kernel.check()?;
    }
    let mean = |part: &dyn Fn(&GaussianKernel) -> f64| {
        (kernels.iter().map(|k| part(k).ln()).sum::<f64>() / kernels.len() as f64).exp()
    };
    Ok(GaussianKernel {
        signal_variance: mean(&|k| k.signal_variance),
        length_scales: (0..first.inputs()).map(|d| mean(&|k| k.length_scales[d])).collect(),
    })
}

struct Search<'a> {
    candidates: &'a [f64],
    kernel: &'a GaussianKernel,
    rows: usize,
    floor: f64,
    /// What the points chosen leave uncertain of each candidate.
    variances: Vec<f64>,
    /// `L^-1 K`, one column per candidate, one row per point chosen.
    whitened: Vec<f64>,
    chosen: Vec<usize>,
}

impl Search<'_> {
    /// Chooses one or more points, or none because no variance is left.
    ///
    /// Variances never grow. So the largest of the front remains the largest of all while it is
    /// above those that the others had before: only then do the others have to be brought up to
    /// date, for all the new points at once.
    fn advance(&mut self) -> bool {
        let mut order: Vec<usize> = (0..self.variances.len()).collect();
        let mut bound = self.floor;
        if order.len() > FRONT {
            let larger = |a: &usize, b: &usize| {
                self.variances[*b].total_cmp(&self.variances[*a]).then(a.cmp(b))
            };
            let (_, &mut first_outside, _) = order.select_nth_unstable_by(FRONT, larger);
            bound = bound.max(self.variances[first_outside]);
            order.truncate(FRONT);
            order.sort_unstable();
        }
        let mut front = Front::new(self, order);
        let known = self.chosen.len();
        while self.chosen.len() < self.rows {
            let Some((place, variance)) = front.largest() else { break };
            let is_first = self.chosen.len() == known;
            if variance <= self.floor || (variance < bound && !is_first) {
                break;
            }
            front.choose(place, self.chosen.len());
            self.chosen.push(front.members[place]);
            front.pivots.push(place);
        }
        if self.chosen.len() > known {
            self.update(known, &front);
        }
        self.chosen.len() > known
    }

    /// Rows `known..` of the whitened covariances of all candidates,
    /// `V_new = L_new^-1 (K_new - L_old V_old)`.
    fn update(&mut self, known: usize, front: &Front) {
        let (d, rows, all) = (self.kernel.inputs(), self.rows, self.chosen.len());
        let new = all - known;
        let l: Vec<f64> = front
            .pivots
            .iter()
            .flat_map(|&p| &front.whitened[p * rows..][..all])
            .copied()
            .collect();
        let l = MatRef::from_row_major_slice(&l, new, all);
        let (l_old, l_new) = l.split_at_col(known);
        let points: Vec<f64> = self.chosen[known..]
            .iter()
            .flat_map(|&i| &self.candidates[i * d..][..d])
            .copied()
            .collect();
        let points = ScaledPoints::new(&points, self.kernel);
        let panels = self.whitened.par_chunks_mut(rows * PANEL);
        let inputs = self.candidates.par_chunks(d * PANEL);
        panels.zip(inputs).zip(self.variances.par_chunks_mut(PANEL)).for_each(
            |((panel, inputs), variances)| {
                points.covariances(inputs, &mut panel[known..], rows);
                let count = variances.len();
                let v = MatMut::from_column_major_slice_mut(panel, rows, count);
                let (v_old, v_new) = v.get_mut(..all, ..).split_at_row_mut(known);
                let mut v_new = v_new;
                matmul(v_new.as_mut(), Accum::Add, l_old, v_old.as_ref(), -1.0, Par::Seq);
                solve_lower_triangular_in_place(l_new, v_new.as_mut(), Par::Seq);
                for (variance, column) in variances.iter_mut().zip(v_new.col_iter()) {
                    *variance -= column.squared_norm_l2();
                }
            },
        );
        for &i in &self.chosen[known..] {
            self.variances[i] = 0.0;
        }
    }
}

/// The candidates of the largest variance, always up to date.
struct Front {
    members: Vec<usize>,
    points: ScaledPoints,
    inputs: Vec<f64>,
    variances: Vec<f64>,
    /// One row of `rows` numbers per member.
    whitened: Vec<f64>,
    rows: usize,
    /// Places of the members chosen.
    pivots: Vec<usize>,
}

impl Front {
    fn new(search: &Search, members: Vec<usize>) -> Self {
        let (d, rows) = (search.kernel.inputs(), search.rows);
        let inputs: Vec<f64> =
            members.iter().flat_map(|&i| &search.candidates[i * d..][..d]).copied().collect();
        let known = search.chosen.len();
        let mut whitened = vec![0.0; members.len() * rows];
        for (row, &i) in whitened.chunks_exact_mut(rows).zip(&members) {
            row[..known].copy_from_slice(&search.whitened[i * rows..][..known]);
        }
        Self {
            points: ScaledPoints::new(&inputs, search.kernel),
            variances: members.iter().map(|&i| search.variances[i]).collect(),
            pivots: Vec::new(),
            members,
            inputs,
            whitened,
            rows,
        }
    }

    /// Place and value of the largest variance, the first of equals.
    fn largest(&self) -> Option<(usize, f64)> {
        let variances = self.variances.iter().copied().enumerate();
        variances.reduce(|best, next| if next.1 > best.1 { next } else { best })
    }

    /// Makes the member at `place` the point of number `row`.
    fn choose(&mut self, place: usize, row: usize) {
        let d = self.points.kernel().inputs();
        let pivot = self.whitened[place * self.rows..][..row].to_vec();
        let scale = self.variances[place].sqrt();
        let mut covariances = vec![0.0; self.members.len()];
        let input = &self.inputs[place * d..][..d];
        self.points.covariances(input, &mut covariances, self.members.len());
        let members = self.whitened.chunks_exact_mut(self.rows).zip(&mut self.variances);
        for ((member, variance), k) in members.zip(covariances) {
            let v = (k - dot(&member[..row], &pivot)) / scale;
            member[row] = v;
            *variance -= v * v;
        }
        self.variances[place] = 0.0;
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    const D: usize = 4;

    fn kernel() -> GaussianKernel {
        GaussianKernel { signal_variance: 2.0, length_scales: vec![0.5, 0.7, 1.0, 3.0] }
    }

    fn candidates(n: usize) -> Vec<f64> {
        let mut random = ChaCha8Rng::seed_from_u64(3);
        (0..n * D).map(|_| random.random_range(-1.0..1.0)).collect()
    }

    /// The textbook form: one column of the factor after the other.
    fn one_by_one(x: &[f64], kernel: &GaussianKernel, m: usize) -> Vec<usize> {
        let n = x.len() / D;
        let row = |i: usize| &x[i * D..][..D];
        let mut variances: Vec<f64> = (0..n).map(|i| kernel.value(row(i), row(i))).collect();
        let mut columns: Vec<Vec<f64>> = Vec::new();
        let mut chosen = Vec::new();
        for _ in 0..m {
            let best = (1..n).fold(0, |b, i| if variances[i] > variances[b] { i } else { b });
            let root = variances[best].sqrt();
            let entry = |i: usize| {
                let known: f64 = columns.iter().map(|c| c[i] * c[best]).sum();
                (kernel.value(row(i), row(best)) - known) / root
            };
            let column: Vec<f64> = (0..n).map(entry).collect();
            (0..n).for_each(|i| variances[i] -= column[i].powi(2));
            columns.push(column);
            chosen.push(best);
        }
        chosen
    }

    #[test]
    fn points_are_those_of_the_pivoted_cholesky_decomposition_column_by_column() {
        for (n, m) in [(50, 20), (FRONT, 30), (3000, 300)] {
            let x = candidates(n);
            let expected = one_by_one(&x, &kernel(), m);
            assert_eq!(inducing_points(&x, &kernel(), m).unwrap(), expected, "{n} {m}");
        }
    }

    #[test]
    fn threads_do_not_change_the_choice() {
        let x = candidates(3000);
        let with = |threads: usize| {
            let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
            pool.install(|| inducing_points(&x, &kernel(), 200).unwrap())
        };
        assert_eq!(with(1), with(3));
    }

    #[test]
    fn candidates_that_repeat_others_are_not_chosen() {
        let few = candidates(5);
        assert_eq!(inducing_points(&few.repeat(600), &kernel(), 50).unwrap().len(), 5);
        assert_eq!(inducing_points(&[0.25; 40 * D], &kernel(), 7).unwrap(), [0]);
    }

    #[test]
    fn numbers_of_points_at_the_limits_are_served() {
        let x = candidates(6);
        assert!(inducing_points(&x, &kernel(), 0).unwrap().is_empty());
        let mut all = inducing_points(&x, &kernel(), 100).unwrap();
        all.sort_unstable();
        assert_eq!(all, [0, 1, 2, 3, 4, 5]);
    }

    #[test]
    fn input_that_cannot_be_used_is_refused() {
        assert_eq!(inducing_points(&[], &kernel(), 3), Err(GpError::NoPoints));
        let wrong = GpError::WrongLength { vector: "candidates", expected: 8, got: 7 };
        assert_eq!(inducing_points(&[0.0; 7], &kernel(), 3), Err(wrong));
        let nan = inducing_points(&[0.0, f64::NAN, 0.0, 0.0], &kernel(), 3);
        assert!(matches!(nan, Err(GpError::NotFinite { index: 1, .. })));
    }

    #[test]
    fn shared_kernel_has_the_geometric_means() {
        let other =
            GaussianKernel { signal_variance: 8.0, length_scales: vec![2.0, 0.7, 4.0, 3.0] };
        let shared = shared_kernel(&[kernel(), other]).unwrap();
        let expected = [1.0, 0.7, 2.0, 3.0];
        let close = |(a, b): (&f64, &f64)| (a - b).abs() < 1e-15;
        assert!(shared.length_scales.iter().zip(&expected).all(close));
        assert!((shared.signal_variance - 4.0).abs() < 1e-14);
        assert_eq!(shared_kernel(&[]), Err(GpError::NoPoints));
        let short = GaussianKernel { signal_variance: 1.0, length_scales: vec![1.0] };
        let wrong = GpError::WrongLength { vector: "length_scales", expected: 4, got: 1 };
        assert_eq!(shared_kernel(&[kernel(), short]), Err(wrong));
    }
}
