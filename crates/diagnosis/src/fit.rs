use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use crate::gram::Information;

/// A ridge regression on some of the columns.
///
/// ```text
/// minimise  sum_j c_j |y_j - X_j w|^2 + sum_k w_k^2 / prior_k^2
/// A = H + diag(1 / prior^2),  A w = g
/// ```
#[derive(Debug, Clone)]
pub(crate) struct Fit {
    /// The columns, in increasing order.
    pub columns: Vec<usize>,
    /// Their weights.
    pub weights: DVector<f64>,
    factor: Cholesky<f64, Dyn>,
    /// Logarithm of the marginal likelihood, up to a constant of the data.
    pub evidence: f64,
}

impl Fit {
    /// The fit of `columns` to `info`; none when the normal equations are not positive definite.
    pub fn new(info: &Information, columns: Vec<usize>, prior: &[f64]) -> Option<Self> {
        let a = regularised(info, &columns, prior);
        let g = pick(&info.g, &columns);
        let factor = Cholesky::new(a)?;
        let weights = factor.solve(&g);
        let spread: f64 = columns.iter().map(|&k| prior[k].ln()).sum();
        let evidence = 0.5 * (g.dot(&weights) - info.yy) - 0.5 * ln_determinant(&factor) - spread;
        Some(Self { columns, weights, factor, evidence })
    }

    /// All weights, zero for columns that take no part.
    pub fn expand(&self, width: usize) -> Vec<f64> {
        let mut all = vec![0.0; width];
        self.columns.iter().zip(self.weights.iter()).for_each(|(&k, &w)| all[k] = w);
        all
    }

    /// Posterior covariance of the weights, `A^-1`.
    pub fn covariance(&self) -> DMatrix<f64> {
        self.factor.inverse()
    }

    /// How a score on the columns of the fit and on `others` looks to `others` once the
    /// fit's own columns have been given their share:
    ///
    /// ```text
    /// project = [-A_KS A_SS^-1, 1],  b = A_KK - A_KS A_SS^-1 A_SK
    /// ```
    pub fn complement(&self, info: &Information, others: &[usize], prior: &[f64]) -> Complement {
        let cross = DMatrix::from_fn(self.columns.len(), others.len(), |i, k| {
            info.h[(self.columns[i], others[k])]
        });
        let share = self.factor.solve(&cross);
        let b = regularised(info, others, prior) - cross.transpose() * &share;
        Complement { own: self.columns.clone(), others: others.to_vec(), share, b }
    }

    /// Gain in evidence from adding `others`, whose weights start at zero.
    pub fn evidence_of(&self, info: &Information, others: &[usize], prior: &[f64]) -> f64 {
        let complement = self.complement(info, others, prior);
        let u = complement.project(&info.g);
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
    /// Information of the others that the fit's own columns cannot take over.
    pub b: DMatrix<f64>,
}

impl Complement {
    /// The part of a score (over all columns) that only the others can explain.
    pub fn project(&self, score: &DVector<f64>) -> DVector<f64> {
        pick(score, &self.others) - self.share.tr_mul(&pick(score, &self.own))
    }
}

/// The entries of `all` at `columns`.
pub(crate) fn pick(all: &DVector<f64>, columns: &[usize]) -> DVector<f64> {
    DVector::from_iterator(columns.len(), columns.iter().map(|&k| all[k]))
}

fn regularised(info: &Information, columns: &[usize], prior: &[f64]) -> DMatrix<f64> {
    DMatrix::from_fn(columns.len(), columns.len(), |i, k| {
        let ridge = if i == k { prior[columns[k]].powi(-2) } else { 0.0 };
        info.h[(columns[i], columns[k])] + ridge
    })
}

fn ln_determinant(factor: &Cholesky<f64, Dyn>) -> f64 {
    2.0 * factor.l_dirty().diagonal().iter().map(|d| d.ln()).sum::<f64>()
}
