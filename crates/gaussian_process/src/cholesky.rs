use crate::error::GpError;
use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::cholesky::llt::factor;
use faer::{Mat, MatRef, Par};

/// Jitters tried beyond none, each ten times the one before.
const ATTEMPTS: i32 = 7;

/// What rounding leaves uncertain of a pivot of a covariance matrix of `points` points.
pub(crate) fn rounding(points: usize, signal_variance: f64) -> f64 {
    points as f64 * f64::EPSILON * signal_variance
}

/// The lower factor `L` of `A + jitter I = L L'` from the lower triangle of `A`, or `None` when a
/// pivot falls to `floor` or below.
///
/// On one thread, so that the result does not depend on their number.
pub(crate) fn cholesky(a: MatRef<f64>, jitter: f64, floor: f64) -> Option<Mat<f64>> {
    let m = a.nrows();
    let mut l = a.to_owned();
    for i in 0..m {
        l[(i, i)] += jitter;
    }
    let scratch = factor::cholesky_in_place_scratch::<f64>(m, Par::Seq, Default::default());
    let mut memory = MemBuffer::new(scratch);
    let stack = MemStack::new(&mut memory);
    let settings = (Default::default(), Default::default());
    factor::cholesky_in_place(l.as_mut(), settings.0, Par::Seq, stack, settings.1).ok()?;
    let pivots_are_clear = (0..m).all(|i| l[(i, i)] * l[(i, i)] > floor);
    // The factorisation works in the upper triangle, too.
    (0..m).for_each(|j| l.col_mut(j).subrows_mut(0, j).fill(0.0));
    pivots_are_clear.then_some(l)
}

/// The factor with the smallest jitter that keeps the pivots above `floor`, and that jitter: none,
/// or `rounding` times 10, 100, ...
pub(crate) fn cholesky_with_jitter(
    a: MatRef<f64>,
    rounding: f64,
    floor: f64,
) -> Result<(Mat<f64>, f64), GpError> {
    let steps = (1..=ATTEMPTS).map(|power| rounding * 10_f64.powi(power));
    for jitter in std::iter::once(0.0).chain(steps) {
        if let Some(l) = cholesky(a, jitter, floor) {
            return Ok((l, jitter));
        }
    }
    let jitter = rounding * 10_f64.powi(ATTEMPTS);
    Err(GpError::NotPositiveDefinite { points: a.nrows(), jitter })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_singular_matrix_takes_the_first_jitter_and_an_indefinite_one_none() {
        let ones = Mat::from_fn(3, 3, |_, _| 1.0);
        let floor = rounding(3, 1.0);
        let (l, jitter) = cholesky_with_jitter(ones.as_ref(), floor, floor).unwrap();
        assert!((jitter / (30.0 * f64::EPSILON) - 1.0).abs() < 1e-12);
        let rebuilt = &l * l.transpose();
        assert!((0..3).all(|i| (rebuilt[(i, 2)] - 1.0).abs() < 2.0 * jitter));

        let clear = Mat::from_fn(2, 2, |i, j| if i == j { 2.0 } else { 1.0 });
        assert!(
            cholesky_with_jitter(clear.as_ref(), floor, floor).unwrap().1.abs() < f64::MIN_POSITIVE
        );

        let faint = Mat::from_fn(2, 2, |i, j| if i == j { [1.0, 1e-20][i] } else { 0.0 });
        let jitter =
            |floor| cholesky_with_jitter(faint.as_ref(), rounding(2, 1.0), floor).unwrap().1;
        assert!(jitter(1e-19) > 1e-15 && jitter(0.0).abs() < f64::MIN_POSITIVE);

        let indefinite = Mat::from_fn(2, 2, |i, j| if i == j { 1.0 } else { 2.0 });
        let error = cholesky_with_jitter(indefinite.as_ref(), floor, floor).unwrap_err();
        assert!(matches!(error, GpError::NotPositiveDefinite { points: 2, .. }));
        let nan = Mat::from_fn(2, 2, |_, _| f64::NAN);
        assert!(cholesky_with_jitter(nan.as_ref(), floor, floor).is_err());
    }
}
