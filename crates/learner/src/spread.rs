use gaussian_process::{InducingPosterior, Inverse};

/// The terms of the predictive variance of every joint's process that depend on the data,
///
/// ```text
/// variance = k(x, x) - k_star' M k_star + (phi - Phi' M k_star)' S (phi - Phi' M k_star)
/// ```
///
/// with `M` the inverse covariance of the targets, or what stands for it with inducing points,
/// and `S` the covariance of the weights of the mean.
#[derive(Debug, Clone)]
pub enum Spread {
    /// Of all points.
    Exact {
        /// `M` of every joint.
        inverse: Vec<Inverse>,
        /// `Phi` of every joint, row-major, where the weights of the mean are uncertain.
        features: Vec<Vec<f64>>,
    },
    /// Of inducing points.
    Inducing(Vec<InducingPosterior>),
}

impl Spread {
    /// `k_star' M k_star` of joint `k`; fills `solved` with `M k_star` where weights need it.
    pub(crate) fn explain(&self, k: usize, k_star: &[f64], solved: &mut [f64]) -> f64 {
        match self {
            Self::Exact { inverse, .. } => {
                inverse[k].multiply(k_star, solved);
                k_star.iter().zip(solved.iter()).map(|(k, s)| k * s).sum()
            }
            Self::Inducing(posterior) => posterior[k].explained_variance(k_star),
        }
    }

    /// [`explain`](Self::explain) of several queries, `k_star` with one row each; fills the
    /// rows of `solved` alike. One product of matrices reads `M` once for all of them.
    pub(crate) fn explain_each(&self, k: usize, k_star: &[f64], solved: &mut [f64]) -> Vec<f64> {
        match self {
            Self::Exact { inverse, .. } => {
                let n = inverse[k].len();
                let count = k_star.len() / n;
                let columns = transpose(k_star, n);
                let product = inverse[k].multiply_columns(&columns, count);
                solved.copy_from_slice(&transpose(&product, count));
                let rows = k_star.chunks_exact(n).zip(solved.chunks_exact(n));
                rows.map(|(k, s)| k.iter().zip(s).map(|(k, s)| k * s).sum()).collect()
            }
            Self::Inducing(posterior) => posterior[k].explained_variances(k_star),
        }
    }

    /// Takes `Phi' solved` of joint `k` from `left`.
    pub(crate) fn take_from(&self, k: usize, solved: &[f64], left: &mut [f64]) {
        let Self::Exact { features, .. } = self else { return };
        let Some(features) = features.get(k) else { return };
        for (row, solved) in features.chunks_exact(left.len().max(1)).zip(solved) {
            left.iter_mut().zip(row).for_each(|(left, phi)| *left -= phi * solved);
        }
    }
}

/// The transpose of a row-major matrix with rows of `width`, row-major.
fn transpose(matrix: &[f64], width: usize) -> Vec<f64> {
    (0..width).flat_map(|j| matrix.iter().skip(j).step_by(width).copied()).collect()
}
