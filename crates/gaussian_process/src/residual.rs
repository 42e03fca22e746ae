use faer::linalg::solvers::{Llt, Solve};
use faer::{ColRef, Mat, MatRef, Side};

use crate::error::{GpError, check};
use crate::inverse::Inverse;
use crate::linear_evidence::{LinearEvidence, LinearPosterior};

/// The linear part of a process for one output.
#[derive(Debug, Clone, Copy)]
pub struct Linear<'a> {
    /// `Phi`, row-major, one row a point; empty where there is no linear part.
    pub features: &'a [f64],
    /// `beta_0`.
    pub mean: &'a [f64],
}

impl Linear<'_> {
    /// No linear part.
    pub const NONE: Linear<'static> = Linear { features: &[], mean: &[] };
}

/// A process conditioned on targets beside a linear part, before the weights of that part are
/// chosen:
///
/// ```text
/// mean(x) = phi' beta_bar + k_star' alpha,   alpha = K^-1 (y - Phi beta_bar)
///         = phi' (beta_0 + change) + k_star' (alpha_0 - H change),   H = K^-1 Phi
/// ```
///
/// with `K` the covariance of the targets about the linear part, noise included. Equations 5
/// and 7 of Nguyen-Tuong & Peters 2010; Rasmussen & Williams 2006, equation 2.41.
#[derive(Debug, Clone)]
pub struct ResidualProcess {
    /// `alpha_0 = K^-1 (y - Phi beta_0)`.
    pub alpha: Vec<f64>,
    /// The likelihood of the weights.
    pub evidence: LinearEvidence,
    /// `H`, n x p.
    solved: Mat<f64>,
}

impl ResidualProcess {
    /// Solves for the targets and for the columns of the linear part.
    ///
    /// # Errors
    ///
    /// [`GpError::WrongLength`], [`GpError::NotFinite`].
    pub fn new(inverse: &Inverse, targets: &[f64], linear: Linear) -> Result<Self, GpError> {
        let (n, p) = (inverse.len(), linear.mean.len());
        check("targets", targets, n)?;
        check("features", linear.features, n * p)?;
        check("beta", linear.mean, p)?;
        let phi = MatRef::from_row_major_slice(linear.features, n, p);
        let expected = phi * ColRef::from_slice(linear.mean);
        let r: Vec<f64> = targets.iter().zip(expected.iter()).map(|(y, e)| y - e).collect();
        let mut alpha = vec![0.0; n];
        inverse.multiply(&r, &mut alpha);
        let solved = inverse.multiply_columns(linear.features, p);
        let solved = MatRef::from_row_major_slice(&solved, n, p).to_owned();
        let score = (phi.transpose() * ColRef::from_slice(&alpha)).iter().copied().collect();
        let information = phi.transpose() * &solved;
        let normalisation = n as f64 * std::f64::consts::TAU.ln();
        let fit: f64 = r.iter().zip(&alpha).map(|(r, a)| r * a).sum();
        let without = -0.5 * (fit + inverse.log_determinant() + normalisation);
        let evidence = LinearEvidence { information, score, without };
        Ok(Self { alpha, evidence, solved })
    }

    /// `alpha` once the weights are `beta_0 + change`.
    ///
    /// # Panics
    ///
    /// When `change` does not have one entry a column.
    pub fn alpha(&self, change: &[f64]) -> Vec<f64> {
        let moved = &self.solved * ColRef::from_slice(change);
        self.alpha.iter().zip(moved.iter()).map(|(a, m)| a - m).collect()
    }

    /// Mean square of the errors on stretches of points, each predicted from all others.
    ///
    /// The targets without the stretch `f` predict it with the error
    ///
    /// ```text
    /// y_f - mean_f = (P_ff)^-1 (P (y - Phi beta_0))_f,   P = (K + Phi B Phi')^-1 = K^-1 - H S H'
    /// ```
    ///
    /// (Rasmussen & Williams 2006, equation 5.12, for blocks), so no stretch is refitted.
    ///
    /// # Errors
    ///
    /// [`GpError::NotPositiveDefinite`] when rounding has made a block indefinite.
    pub fn held_out_square(
        &self,
        inverse: &Inverse,
        weights: &LinearPosterior,
        folds: usize,
    ) -> Result<f64, GpError> {
        let n = inverse.len();
        let pulled = self.alpha(&weights.change);
        let spread = &self.solved * &weights.covariance;
        let mut square = 0.0;
        for fold in 0..folds.min(n) {
            let of = fold * n / folds.min(n)..(fold + 1) * n / folds.min(n);
            let low_rank = spread.subrows(of.start, of.len())
                * self.solved.subrows(of.start, of.len()).transpose();
            let block = Mat::from_fn(of.len(), of.len(), |i, j| {
                inverse.entry(of.start + i, of.start + j) - low_rank[(i, j)]
            });
            let refused = |_| GpError::NotPositiveDefinite { points: of.len(), jitter: 0.0 };
            let factor = Llt::new(block.as_ref(), Side::Lower).map_err(refused)?;
            let errors = factor.solve(ColRef::from_slice(&pulled[of.clone()]));
            square += errors.iter().map(|e| e * e).sum::<f64>();
        }
        Ok(square / n.max(1) as f64)
    }
}
