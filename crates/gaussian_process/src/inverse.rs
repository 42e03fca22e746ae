use pulp::Arch;

use crate::packed::Packed;
use crate::panels::{Panels, ROWS};
use crate::product;

/// The inverse of a covariance matrix `K` of `n` targets.
#[derive(Debug, Clone)]
pub struct Inverse {
    pub(crate) matrix: Packed,
    pub(crate) log_determinant: f64,
    pub(crate) jitter: f64,
    pub(crate) arch: Arch,
}

impl Inverse {
    /// `n`
    #[expect(clippy::len_without_is_empty, reason = "there is at least one target")]
    pub fn len(&self) -> usize {
        self.matrix.rows()
    }

    /// `log det K`
    pub fn log_determinant(&self) -> f64 {
        self.log_determinant
    }

    /// What had to be added to the diagonal of `K` to make it positive definite.
    pub fn jitter(&self) -> f64 {
        self.jitter
    }

    /// `out = K^-1 x`, without allocating: as fast as the `4 n²` bytes of the matrix are read.
    ///
    /// # Panics
    ///
    /// When `x` or `out` does not have `n` entries.
    pub fn multiply(&self, x: &[f64], out: &mut [f64]) {
        assert!(x.len() == self.len() && out.len() == self.len(), "a vector of another length");
        product::multiply(&self.matrix, x, out, self.arch);
    }

    /// `x' K^-1 x`, without allocating.
    ///
    /// # Panics
    ///
    /// When `x` does not have `n` entries.
    pub fn quadratic(&self, x: &[f64]) -> f64 {
        assert!(x.len() == self.len(), "a vector of another length");
        product::quadratic(&self.matrix, x, self.arch)
    }

    /// `K^-1 X` of `X` with so many columns; both row-major.
    ///
    /// # Panics
    ///
    /// When `x` does not have `n` rows.
    pub fn multiply_columns(&self, x: &[f64], columns: usize) -> Vec<f64> {
        let n = self.len();
        assert!(x.len() == n * columns, "a matrix of another size");
        let entry = |j: usize, i: usize| if i < n { x[i * columns + j] } else { 0.0 };
        let transposed = Panels::new(columns, n.next_multiple_of(ROWS), entry);
        product::multiply_columns(&self.matrix, &transposed, columns, self.arch)
    }

    /// Entry `(i, j)` of `K^-1`.
    ///
    /// # Panics
    ///
    /// When there is no such entry.
    pub fn entry(&self, i: usize, j: usize) -> f64 {
        let (i, j) = (i.max(j), i.min(j));
        assert!(i < self.len(), "an entry of a larger matrix");
        self.matrix.panel(i / ROWS)[j * ROWS + i % ROWS]
    }
}
