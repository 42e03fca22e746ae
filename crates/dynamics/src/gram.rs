use faer::linalg::matmul::triangular::{BlockStructure, matmul};
use faer::{Accum, MatMut, MatRef, Par};

/// Adds the products of the columns of `rows` (`N x m`) to the lower triangle of `gram` (`m x m`), on this thread:
///
/// ```text
/// gram += rows' rows
/// ```
///
/// What is above the diagonal stays as it was. Takes `N m²` operations, half of what the full product takes.
///
/// # Panics
///
/// When `gram` is not square with as many columns as `rows`.
pub fn add_gram(gram: MatMut<f64>, rows: MatRef<f64>) {
    matmul(
        gram,
        BlockStructure::TriangularLower,
        Accum::Add,
        rows.transpose(),
        BlockStructure::Rectangular,
        rows,
        BlockStructure::Rectangular,
        1.0,
        Par::Seq,
    );
}
