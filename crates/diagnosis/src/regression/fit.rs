use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use crate::columns::prior::Prior;
use crate::regression::gram::Information;

/// A ridge regression on some of the columns, within bounds.
///
/// ```text
/// minimise  sum_j c_j |y_j - X_j w|^2 + sum_k w_k^2 / prior_k^2   within the bounds
/// A = H + diag(1 / prior^2),  A w = g
/// ```
///
/// Weights that leave their bounds are held there, and the others are fitted again until all stay inside.
#[derive(Debug, Clone)]
pub(crate) struct Fit {
    /// The free columns, in increasing order.
    pub columns: Vec<usize>,
    /// The weights of the free columns.
    pub weights: DVector<f64>,
    /// Columns held at a bound, with the bound.
    pub held: Vec<(usize, f64)>,
    factor: Cholesky<f64, Dyn>,
    /// `g - H w` of the held columns, the right-hand side for the free ones.
    answered: DVector<f64>,
    /// Logarithm of the marginal likelihood, up to a constant that depends on the data only.
    pub evidence: f64,
}

impl Fit {
    /// The fit of `columns` to `info`; `None` when the normal equations are not positive definite.
    pub fn new(info: &Information, mut columns: Vec<usize>, prior: Prior) -> Option<Self> {
        let mut held: Vec<(usize, f64)> = Vec::new();
        let mut answered = info.g.clone();
        loop {
            let factor = Cholesky::new(regularise(info, &columns, prior.sd))?;
            let weights = factor.solve(&pick(&answered, &columns));
            let outside = |(&k, &w): (&usize, &f64)| {
                let (low, high) = prior.bounds[k];
                (w < low || w > high).then(|| (k, w.clamp(low, high)))
            };
            let leaving: Vec<_> = columns.iter().zip(weights.iter()).filter_map(outside).collect();
            if leaving.is_empty() {
                let evidence = evidence(info, &columns, (&weights, &held), &factor, prior.sd);
                let mut fit = Self { columns, weights, held, factor, answered, evidence };
                let scales = prior.of_any_scale.iter();
                fit.evidence += scales.map(|own| fit.evidence_of_scales(own, prior)).sum::<f64>();
                return Some(fit);
            }
            for &(k, bound) in &leaving {
                answered -= info.h.column(k) * bound;
                columns.retain(|&c| c != k);
            }
            held.extend(leaving);
        }
    }

    /// All weights, zero for columns outside the fit.
    pub fn expand(&self, width: usize) -> Vec<f64> {
        let mut all = vec![0.0; width];
        self.columns.iter().zip(self.weights.iter()).for_each(|(&k, &w)| all[k] = w);
        self.held.iter().for_each(|&(k, w)| all[k] = w);
        all
    }

    /// The part of `others`, and of a score on them, that the columns of the fit cannot explain:
    ///
    /// ```text
    /// project = [-A_KS A_SS^-1, 1],  b = A_KK - A_KS A_SS^-1 A_SK
    /// ```
    pub fn complement(&self, info: &Information, others: &[usize], prior: &[f64]) -> Complement {
        let cross = DMatrix::from_fn(self.columns.len(), others.len(), |i, k| {
            info.h[(self.columns[i], others[k])]
        });
        let share = self.factor.solve(&cross);
        let b = regularise(info, others, prior) - cross.transpose() * &share;
        Complement { own: self.columns.clone(), others: others.to_vec(), share, b }
    }

    /// Information and score of `others` beyond the fit: `b` and the projected score.
    pub fn beyond(
        &self,
        info: &Information,
        others: &[usize],
        prior: &[f64],
    ) -> (Complement, DVector<f64>) {
        let complement = self.complement(info, others, prior);
        let score = complement.project(&self.answered);
        (complement, score)
    }

    /// Gain in evidence from adding `others`, which start at zero weight.
    pub fn evidence_of(&self, info: &Information, others: &[usize], prior: Prior) -> f64 {
        let (Complement { b, .. }, u) = self.beyond(info, others, prior.sd);
        let Some(factor) = Cholesky::new(b.clone()) else { return f64::NEG_INFINITY };
        let spread: f64 = others.iter().map(|&k| prior.sd[k].ln()).sum();
        let weights = factor.solve(&u);
        let gain = 0.5 * u.dot(&weights) - 0.5 * ln_determinant(&factor) - spread;
        let is_of_any_scale = prior.of_any_scale.iter().any(|own| own == others);
        let of_scales = || {
            let sd = pick(&DVector::from_column_slice(prior.sd), others);
            evidence_of_scales(&b, &weights, &sd, prior.scales)
        };
        gain + if is_of_any_scale { of_scales() } else { 0.0 }
    }

    /// See [`evidence_of_scales`]; 0 where a weight of `own` is not free.
    fn evidence_of_scales(&self, own: &[usize], prior: Prior) -> f64 {
        let place = |k: &usize| self.columns.iter().position(|c| c == k);
        let Some(places) = own.iter().map(place).collect::<Option<Vec<usize>>>() else {
            return 0.0;
        };
        let unit = DMatrix::from_fn(self.columns.len(), own.len(), |i, k| {
            f64::from(u8::from(i == places[k]))
        });
        let covariance = self.factor.solve(&unit).select_rows(&places);
        let Some(precision) = Cholesky::new(covariance).map(|c| c.inverse()) else { return 0.0 };
        let sd = pick(&DVector::from_column_slice(prior.sd), own);
        evidence_of_scales(&precision, &self.weights.select_rows(&places), &sd, prior.scales)
    }
}

/// See [`Fit::complement`].
#[derive(Debug, Clone)]
pub(crate) struct Complement {
    own: Vec<usize>,
    others: Vec<usize>,
    share: DMatrix<f64>,
    /// Information on the others that the columns of the fit cannot explain.
    pub b: DMatrix<f64>,
}

impl Complement {
    /// Covariance of the fit's own weights that comes from one of the others: `share covariance share'`.
    pub fn propagate(&self, covariance: &DMatrix<f64>) -> DMatrix<f64> {
        &self.share * covariance * self.share.transpose()
    }

    /// The part of a score (over all columns) that only the others can explain.
    pub fn project(&self, score: &DVector<f64>) -> DVector<f64> {
        pick(score, &self.others) - self.share.tr_mul(&pick(score, &self.own))
    }
}

/// What the log evidence gains where the prior of some weights has an unknown scale `s`, one of `scales`. With the
/// posterior `N(w, Q^-1)` under the prior standard deviations `sd`, in units of these,
///
/// ```text
/// ln mean_s s^-k |Q|^1/2 |Q + d|^-1/2 exp((w' Q (Q + d)^-1 Q w - w' Q w) / 2),  d = (s^-2 - 1) 1
/// ```
fn evidence_of_scales(
    precision: &DMatrix<f64>,
    weights: &DVector<f64>,
    sd: &DVector<f64>,
    scales: &[f64],
) -> f64 {
    let count = sd.len();
    let q = DMatrix::from_fn(count, count, |i, k| sd[i] * precision[(i, k)] * sd[k]);
    let w = weights.component_div(sd);
    let score = &q * &w;
    let Some(whole) = Cholesky::new(q.clone()) else { return 0.0 };
    let of_scale = |s: &f64| {
        let narrow = Cholesky::new(&q + DMatrix::identity(count, count) * (s.powi(-2) - 1.0))?;
        let determinants = 0.5 * (ln_determinant(&whole) - ln_determinant(&narrow));
        let squares = 0.5 * (score.dot(&narrow.solve(&score)) - score.dot(&w));
        Some(determinants + squares - count as f64 * s.ln())
    };
    let gains: Vec<f64> = scales.iter().filter_map(of_scale).collect();
    let most = gains.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let sum: f64 = gains.iter().map(|gain| (gain - most).exp()).sum();
    most + (sum / scales.len() as f64).ln()
}

/// `log integral of likelihood times prior` over the free weights, with the held ones fixed.
fn evidence(
    info: &Information,
    columns: &[usize],
    (weights, held): (&DVector<f64>, &[(usize, f64)]),
    factor: &Cholesky<f64, Dyn>,
    prior: &[f64],
) -> f64 {
    let all: Vec<(usize, f64)> =
        columns.iter().copied().zip(weights.iter().copied()).chain(held.iter().copied()).collect();
    // Of the free weights A w = g - H w_held, so that only the rows of the held ones are left of w' (H + 1 / prior^2) w.
    let linear: f64 = all.iter().map(|&(k, w)| info.g[k] * w).sum();
    let of_held = |&(i, a): &(usize, f64)| {
        let row = all.iter().map(|&(k, b)| info.h[(i, k)] * b).sum::<f64>();
        a * (row + a * prior[i].powi(-2) - info.g[i])
    };
    let quadratic = linear + held.iter().map(of_held).sum::<f64>();
    let spread: f64 = columns.iter().map(|&k| prior[k].ln()).sum();
    -0.5 * (info.yy - 2.0 * linear + quadratic) - 0.5 * ln_determinant(factor) - spread
}

/// Posterior covariance of the weights of `columns`, `A^-1`; infinite where there is none.
pub(crate) fn covariance(info: &Information, columns: &[usize], prior: &[f64]) -> DMatrix<f64> {
    Cholesky::new(regularise(info, columns, prior)).map_or_else(
        || DMatrix::from_element(columns.len(), columns.len(), f64::INFINITY),
        |factor| factor.inverse(),
    )
}

/// The entries of `all` at `columns`.
pub(crate) fn pick(all: &DVector<f64>, columns: &[usize]) -> DVector<f64> {
    DVector::from_iterator(columns.len(), columns.iter().map(|&k| all[k]))
}

fn regularise(info: &Information, columns: &[usize], prior: &[f64]) -> DMatrix<f64> {
    DMatrix::from_fn(columns.len(), columns.len(), |i, k| {
        let ridge = if i == k { prior[columns[k]].powi(-2) } else { 0.0 };
        info.h[(columns[i], columns[k])] + ridge
    })
}

fn ln_determinant(factor: &Cholesky<f64, Dyn>) -> f64 {
    2.0 * factor.l_dirty().diagonal().iter().map(|d| d.ln()).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    const SCALES: [f64; 3] = [1.0, 0.2, 0.01];

    /// `ln mean_s integral N(y; w, 1 / h) N(w; 0, (s sd)²) dw`, where `y` has the variance `1 / h + (s sd)²`, less that of
    /// the largest scale.
    fn expected(y: f64, h: f64, sd: f64) -> f64 {
        let density = |s: f64| {
            let variance = h.recip() + (s * sd).powi(2);
            (-0.5 * y * y / variance).exp() / variance.sqrt()
        };
        let mean = SCALES.iter().map(|s| density(*s)).sum::<f64>() / SCALES.len() as f64;
        (mean / density(1.0)).ln()
    }

    #[test]
    fn a_size_that_is_unknown_by_decades_has_the_evidence_of_all_its_scales() {
        let (h, sd) = (400.0, 2.0);
        for y in [0.02, 0.1, 0.5, 3.0] {
            let info = Information {
                h: DMatrix::from_element(1, 1, h),
                g: DVector::from_element(1, h * y),
                yy: h * y * y,
            };
            let (sds, bounds) = ([sd], [(f64::NEG_INFINITY, f64::INFINITY)]);
            let (own, columns) = ([vec![0]], vec![0]);
            let prior = Prior { sd: &sds, bounds: &bounds, of_any_scale: &own, scales: &SCALES };
            let of_one = Prior { of_any_scale: &[], ..prior };
            let gain = |of| Fit::new(&info, columns.clone(), of).unwrap().evidence;
            let of_fit = gain(prior) - gain(of_one);
            let none = Fit::new(&info, Vec::new(), prior).unwrap();
            let entry = |of| none.evidence_of(&info, &columns, of);
            let of_entry = entry(prior) - entry(of_one);
            for found in [of_fit, of_entry] {
                assert!((found - expected(y, h, sd)).abs() < 1e-9, "{y}: {found}");
            }
        }
    }
}
