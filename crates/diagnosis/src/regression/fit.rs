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
                return Some(Self { columns, weights, held, factor, answered, evidence });
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
    pub fn evidence_of(&self, info: &Information, others: &[usize], prior: &[f64]) -> f64 {
        let (complement, u) = self.beyond(info, others, prior);
        let Some(factor) = Cholesky::new(complement.b) else { return f64::NEG_INFINITY };
        let spread: f64 = others.iter().map(|&k| prior[k].ln()).sum();
        0.5 * u.dot(&factor.solve(&u)) - 0.5 * ln_determinant(&factor) - spread
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
    let quadratic: f64 = all
        .iter()
        .map(|&(i, a)| a * all.iter().map(|&(k, b)| info.h[(i, k)] * b).sum::<f64>())
        .sum();
    let linear: f64 = all.iter().map(|&(k, w)| info.g[k] * w).sum();
    let ridge: f64 = all.iter().map(|&(k, w)| (w / prior[k]).powi(2)).sum();
    let spread: f64 = columns.iter().map(|&k| prior[k].ln()).sum();
    -0.5 * (info.yy - 2.0 * linear + quadratic + ridge) - 0.5 * ln_determinant(factor) - spread
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
