use faer::linalg::solvers::{Llt, Solve};
use faer::{Mat, Side};

use crate::error::{GpError, check};

/// The likelihood of the weights of a linear part, before a prior on them is chosen.
///
/// With `r = y - Phi beta_0` and `C` the covariance of everything else (noise, and the
/// Gaussian process where there is one),
///
/// ```text
/// information = Phi' C^-1 Phi,   score = Phi' C^-1 r,   without = log N(r; 0, C)
/// ```
///
/// A prior `beta ~ N(beta_0, B)`, `B = diag(variances)`, then gives
///
/// ```text
/// S = (B^-1 + information)^-1,   beta_bar = beta_0 + S score
/// log p(y) = without + 1/2 score' S score - 1/2 log det(I + B information)
/// ```
///
/// Rasmussen & Williams 2006, section 2.7; equation 7 of Nguyen-Tuong & Peters 2010. A variance of
/// zero fixes its weight.
#[derive(Debug, Clone)]
pub struct LinearEvidence {
    /// `Phi' C^-1 Phi`, p x p.
    pub information: Mat<f64>,
    /// `Phi' C^-1 r`, p entries.
    pub score: Vec<f64>,
    /// `log N(r; 0, C)`.
    pub without: f64,
}

/// The posterior of the weights of a linear part.
#[derive(Debug, Clone)]
pub struct LinearPosterior {
    /// `S score`: what the data add to the prior's mean.
    pub change: Vec<f64>,
    /// `S`, p x p.
    pub covariance: Mat<f64>,
    /// `log p(y)`.
    pub log_likelihood: f64,
}

impl LinearEvidence {
    /// The posterior of the weights under the prior variances `variances`.
    ///
    /// # Errors
    ///
    /// [`GpError::WrongLength`], [`GpError::NotFinite`], [`GpError::NotPositive`] for a
    /// negative variance, [`GpError::NotPositiveDefinite`].
    pub fn posterior(&self, variances: &[f64]) -> Result<LinearPosterior, GpError> {
        let p = self.score.len();
        check("variances", variances, p)?;
        if let Some(&value) = variances.iter().find(|v| **v < 0.0) {
            return Err(GpError::NotPositive { name: "prior variance", value });
        }
        // S = D (I + D A D)^-1 D with D = B^1/2, which holds for D singular too.
        let d: Vec<f64> = variances.iter().map(|v| v.sqrt()).collect();
        let scaled = |i: usize, j: usize| d[i] * self.information[(i, j)] * d[j];
        let whitened = Mat::from_fn(p, p, |i, j| f64::from(u8::from(i == j)) + scaled(i, j));
        let refused = |_| GpError::NotPositiveDefinite { points: p, jitter: 0.0 };
        let factor = Llt::new(whitened.as_ref(), Side::Lower).map_err(refused)?;
        let inverse = factor.solve(Mat::<f64>::identity(p, p));
        let covariance =
            Mat::from_fn(p, p, |i, j| 0.5 * d[i] * (inverse[(i, j)] + inverse[(j, i)]) * d[j]);
        let change: Vec<f64> =
            (0..p).map(|i| (0..p).map(|j| covariance[(i, j)] * self.score[j]).sum()).collect();
        // score' S score as the largest value of 2 beta' score - beta' (A + B^-1) beta: errors of
        // the weights enter squared, and can only lower it.
        let explained = &self.information * faer::ColRef::from_slice(&change);
        let terms = change.iter().zip(&self.score).zip(explained.iter()).zip(variances);
        let fit: f64 = terms
            .filter(|(_, variance)| **variance > 0.0)
            .map(|(((c, s), e), variance)| c * (2.0 * s - e - c / variance))
            .sum();
        let l = factor.L();
        let log_determinant: f64 = (0..p).map(|i| 2.0 * l[(i, i)].ln()).sum();
        let log_likelihood = self.without + 0.5 * fit - 0.5 * log_determinant;
        Ok(LinearPosterior { change, covariance, log_likelihood })
    }

    /// `log p(y)` and its gradient with respect to the logarithm of every variance:
    ///
    /// ```text
    /// d/d log b_j = b_j / 2 [ (phi_j' alpha)² - phi_j' K^-1 phi_j ],   K = C + Phi B Phi'
    /// phi_j' alpha = (score - A S score)_j,   phi_j' K^-1 phi_j = (A - A S A)_jj
    /// ```
    ///
    /// # Errors
    ///
    /// As [`posterior`](Self::posterior), and [`GpError::WrongLength`] for the gradient.
    pub fn evaluate(&self, variances: &[f64], gradient: &mut [f64]) -> Result<f64, GpError> {
        let posterior = self.posterior(variances)?;
        let p = variances.len();
        check("gradient", &vec![0.0; gradient.len()], p)?;
        let (a, s) = (&self.information, &posterior.covariance);
        let explained = a * s;
        for (j, slope) in gradient.iter_mut().enumerate() {
            let pulled: f64 = (0..p).map(|i| a[(j, i)] * posterior.change[i]).sum();
            let seen: f64 = (0..p).map(|i| explained[(j, i)] * a[(i, j)]).sum();
            let pull = self.score[j] - pulled;
            *slope = 0.5 * variances[j] * (pull * pull - (a[(j, j)] - seen));
        }
        Ok(posterior.log_likelihood)
    }
}

/// Sums over samples that determine a linear model under white noise.
#[derive(Debug, Clone)]
pub struct WhiteSums {
    /// `Phi' Phi`, p x p.
    pub gram: Mat<f64>,
    /// `Phi' y`.
    pub moment: Vec<f64>,
    /// `y' y`.
    pub square: f64,
    /// Number of samples.
    pub count: usize,
}

impl WhiteSums {
    /// The sums over rows of `width` features with one target each.
    ///
    /// # Errors
    ///
    /// [`GpError::WrongLength`], [`GpError::NotFinite`].
    pub fn new(features: &[f64], width: usize, targets: &[f64]) -> Result<Self, GpError> {
        check("features", features, width * targets.len())?;
        check("targets", targets, targets.len())?;
        let phi = faer::MatRef::from_row_major_slice(features, targets.len(), width);
        let y = faer::ColRef::from_slice(targets);
        let gram = phi.transpose() * phi;
        let moment = (phi.transpose() * y).iter().copied().collect();
        let square = targets.iter().map(|y| y * y).sum();
        Ok(Self { gram, moment, square, count: targets.len() })
    }

    /// The evidence under noise of variance `noise_variance`.
    pub fn evidence(&self, noise_variance: f64) -> LinearEvidence {
        let n = self.count as f64;
        let log = (2.0 * std::f64::consts::PI * noise_variance).ln();
        LinearEvidence {
            information: faer::Scale(1.0 / noise_variance) * &self.gram,
            score: self.moment.iter().map(|m| m / noise_variance).collect(),
            without: -0.5 * (n * log + self.square / noise_variance),
        }
    }

    /// `log p(y)` of the rigid-body kernel `phi' diag(variances) phi' + noise_variance
    /// delta` (equation 8 of Nguyen-Tuong & Peters 2010), and its gradient with respect to
    /// the logarithms of the variances, then of the noise variance:
    ///
    /// ```text
    /// d/d log sigma² = sigma² / 2 [ alpha' alpha - trace K^-1 ],   alpha = (y - Phi beta_bar) / sigma²
    /// trace K^-1 = (n - trace(S information)) / sigma²
    /// ```
    ///
    /// # Errors
    ///
    /// As [`LinearEvidence::posterior`].
    pub fn evaluate(
        &self,
        variances: &[f64],
        noise_variance: f64,
        gradient: &mut [f64],
    ) -> Result<f64, GpError> {
        let p = variances.len();
        check("gradient", &vec![0.0; gradient.len()], p + 1)?;
        let evidence = self.evidence(noise_variance);
        let value = evidence.evaluate(variances, &mut gradient[..p])?;
        let posterior = evidence.posterior(variances)?;
        let beta = faer::ColRef::from_slice(&posterior.change);
        let fitted = &self.gram * beta;
        let cross: f64 = beta.iter().zip(&self.moment).map(|(b, m)| b * m).sum();
        let quadratic: f64 = beta.iter().zip(fitted.iter()).map(|(b, f)| b * f).sum();
        let remaining = self.square - 2.0 * cross + quadratic;
        let used: f64 = (0..p)
            .flat_map(|i| (0..p).map(move |j| (i, j)))
            .map(|(i, j)| posterior.covariance[(i, j)] * evidence.information[(j, i)])
            .sum();
        gradient[p] = 0.5 * (remaining / noise_variance - (self.count as f64 - used));
        Ok(value)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// `log N(y; 0, K)` by a dense Cholesky factor.
    fn dense(k: &Mat<f64>, y: &[f64]) -> f64 {
        let n = y.len();
        let factor = Llt::new(k.as_ref(), Side::Lower).unwrap();
        let alpha = factor.solve(faer::ColRef::from_slice(y));
        let fit: f64 = alpha.iter().zip(y).map(|(a, y)| a * y).sum();
        let log: f64 = (0..n).map(|i| factor.L()[(i, i)].ln()).sum();
        -0.5 * fit - log - 0.5 * n as f64 * (2.0 * std::f64::consts::PI).ln()
    }

    const FEATURES: [f64; 12] = [1.0, 0.3, -0.4, 1.2, 0.8, 0.1, 2.0, -0.7, 0.2, 0.5, -1.1, 0.9];
    const TARGETS: [f64; 6] = [0.7, -0.2, 1.4, 0.9, 0.1, -0.8];

    fn covariance(variances: [f64; 2], noise: f64) -> Mat<f64> {
        let phi = |i: usize, j: usize| FEATURES[2 * i + j];
        Mat::from_fn(6, 6, |a, b| {
            let linear: f64 = (0..2).map(|j| phi(a, j) * variances[j] * phi(b, j)).sum();
            linear + if a == b { noise } else { 0.0 }
        })
    }

    #[test]
    fn the_evidence_is_the_density_of_the_full_covariance() {
        let sums = WhiteSums::new(&FEATURES, 2, &TARGETS).unwrap();
        for variances in [[1.3, 0.4], [0.0, 2.0], [1e6, 1e-6]] {
            let value = sums.evaluate(&variances, 0.2, &mut [0.0; 3]).unwrap();
            let expected = dense(&covariance(variances, 0.2), &TARGETS);
            assert!((value - expected).abs() < 1e-8, "{value} {expected}");
        }
    }

    #[test]
    fn the_gradient_is_that_of_the_density() {
        let sums = WhiteSums::new(&FEATURES, 2, &TARGETS).unwrap();
        let mut gradient = [0.0; 3];
        sums.evaluate(&[1.3, 0.4], 0.2, &mut gradient).unwrap();
        let step = 1e-5_f64;
        for (j, found) in gradient.into_iter().enumerate() {
            let at = |sign: f64| {
                let mut theta = [1.3_f64.ln(), 0.4_f64.ln(), 0.2_f64.ln()];
                theta[j] += sign * step;
                dense(&covariance([theta[0].exp(), theta[1].exp()], theta[2].exp()), &TARGETS)
            };
            let expected = (at(1.0) - at(-1.0)) / (2.0 * step);
            assert!((found - expected).abs() < 1e-7, "{j}: {found} {expected}");
        }
    }

    #[test]
    fn a_wide_prior_gives_least_squares_and_a_narrow_one_its_mean() {
        let evidence = WhiteSums::new(&FEATURES, 2, &TARGETS).unwrap().evidence(0.2);
        let wide = evidence.posterior(&[1e9, 1e9]).unwrap().change;
        let narrow = evidence.posterior(&[0.0, 0.0]).unwrap().change;
        // Normal equations of the two columns, solved by hand.
        let sum = |f: &dyn Fn(usize) -> f64| -> f64 { (0..6).map(f).sum() };
        let (aa, ab) =
            (sum(&|i| FEATURES[2 * i].powi(2)), sum(&|i| FEATURES[2 * i] * FEATURES[2 * i + 1]));
        let bb = sum(&|i| FEATURES[2 * i + 1].powi(2));
        let (ay, by) =
            (sum(&|i| FEATURES[2 * i] * TARGETS[i]), sum(&|i| FEATURES[2 * i + 1] * TARGETS[i]));
        let det = aa * bb - ab * ab;
        assert!((wide[0] - (bb * ay - ab * by) / det).abs() < 1e-7);
        assert!((wide[1] - (aa * by - ab * ay) / det).abs() < 1e-7);
        assert!(narrow.iter().all(|c| c.abs() < 1e-300));
    }

    #[test]
    fn rounding_never_makes_a_bad_model_look_good() {
        // Columns that all but repeat each other, wide priors, next to no noise: the value is
        // off, but below that of the single column that they are, in closed form.
        let column = [1.0, -0.4, 0.8, 2.0, 0.2, -1.1];
        let features: Vec<f64> = column
            .iter()
            .enumerate()
            .flat_map(|(i, phi)| (0..4).map(move |j| phi * (1.0 + 1e-13 * (i * j) as f64)))
            .collect();
        let sums = WhiteSums::new(&features, 4, &TARGETS).unwrap();
        let dot = |a: &[f64], b: &[f64]| -> f64 { a.iter().zip(b).map(|(a, b)| a * b).sum() };
        for (wide, noise) in [(1e3, 1e-6), (1e4, 1e-8), (1e5, 1e-9)] {
            let value = sums.evaluate(&[wide; 4], noise, &mut [0.0; 5]).unwrap();
            let (pp, py) = (dot(&column, &column), dot(&column, &TARGETS));
            let left = dot(&TARGETS, &TARGETS) - 4.0 * wide * py * py / (noise + 4.0 * wide * pp);
            let determinant = 6.0 * noise.ln() + (1.0 + 4.0 * wide * pp / noise).ln();
            let expected = -0.5 * (left / noise + determinant + 6.0 * std::f64::consts::TAU.ln());
            assert!(value < expected + 1e-6 * expected.abs(), "{wide}: {value} {expected}");
        }
    }

    #[test]
    fn bad_input_is_refused_by_name() {
        let nan = WhiteSums::new(&[1.0, f64::NAN], 1, &[0.0, 0.0]).unwrap_err();
        assert!(matches!(nan, GpError::NotFinite { vector: "features", index: 1, .. }));
        let evidence = WhiteSums::new(&FEATURES, 2, &TARGETS).unwrap().evidence(0.2);
        let negative = evidence.posterior(&[1.0, -1.0]).unwrap_err();
        assert!(matches!(negative, GpError::NotPositive { name: "prior variance", .. }));
    }
}
