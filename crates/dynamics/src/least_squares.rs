use faer::{Mat, MatRef};
use nalgebra::DVector;

use crate::error::DynamicsError;
use crate::gram::add_gram;

/// Share of a column's square below which what is left of it is rounding.
const ROUNDING: f64 = 1e-13;

/// Least squares over any number of rows, with the memory of one Gram matrix:
///
/// ```text
/// gram = sum y y',  rhs = sum y tau   over the rows y' of the regressor
/// ```
///
/// Squares the condition number: choose base columns ([`crate::base_parameters`]) before
/// solving, and use QR when their condition exceeds 1e6.
#[derive(Debug, Clone)]
pub struct NormalEquations {
    /// Lower triangle; what is above it is not kept.
    gram: Mat<f64>,
    rhs: Mat<f64>,
}

impl NormalEquations {
    /// No rows yet, `width` columns.
    pub fn new(width: usize) -> Self {
        Self { gram: Mat::zeros(width, width), rhs: Mat::zeros(width, 1) }
    }

    /// Adds a block of rows, row-major, with one torque each. Some hundred rows at a time
    /// keep the processor busy and the block in its cache.
    ///
    /// # Errors
    ///
    /// [`DynamicsError::WrongLength`] when the rows do not have one torque each.
    pub fn add(&mut self, rows: &[f64], tau: &[f64]) -> Result<(), DynamicsError> {
        let width = self.gram.nrows();
        let expected = width * tau.len();
        if rows.len() != expected {
            return Err(DynamicsError::WrongLength { vector: "rows", expected, got: rows.len() });
        }
        let y = MatRef::from_row_major_slice(rows, tau.len(), width);
        let tau = MatRef::from_column_major_slice(tau, tau.len(), 1);
        add_gram(self.gram.as_mut(), y);
        self.rhs += y.transpose() * tau;
        Ok(())
    }

    /// Adds the rows of another accumulator, such as that of another thread.
    ///
    /// # Errors
    ///
    /// [`DynamicsError::WrongLength`] when `other` has another number of columns.
    pub fn merge(&mut self, other: &Self) -> Result<(), DynamicsError> {
        let (expected, got) = (self.gram.nrows(), other.gram.nrows());
        if expected != got {
            return Err(DynamicsError::WrongLength { vector: "normal equations", expected, got });
        }
        self.gram += &other.gram;
        self.rhs += &other.rhs;
        Ok(())
    }

    /// Least-squares weights of the columns `chosen` alone, in their order.
    ///
    /// # Errors
    ///
    /// [`DynamicsError::NotPositiveDefinite`] when the rows do not determine them: less
    /// than 1e-13 of a column's square is left beside the columns before it.
    ///
    /// # Panics
    ///
    /// When an index is not that of a column.
    pub fn solve(&self, chosen: &[usize]) -> Result<DVector<f64>, DynamicsError> {
        let mut gram: Vec<f64> = chosen
            .iter()
            .flat_map(|&i| chosen.iter().map(move |&j| self.gram[(i.max(j), i.min(j))]))
            .collect();
        let mut weights =
            DVector::from_iterator(chosen.len(), chosen.iter().map(|&i| self.rhs[(i, 0)]));
        let width = chosen.len();
        let squares: Vec<f64> = gram.iter().copied().step_by(width + 1).collect();
        let refused =
            |(row, pivot)| DynamicsError::NotPositiveDefinite { matrix: "gram", row, pivot };
        crate::cholesky::factor(&mut gram, width).map_err(refused)?;
        let pivots = gram.iter().step_by(width + 1).map(|l| l * l);
        let vanishing =
            pivots.zip(squares).enumerate().find(|(_, (p, square))| *p < ROUNDING * square);
        if let Some((row, (pivot, _))) = vanishing {
            return Err(refused((row, pivot)));
        }
        crate::cholesky::solve_factored(&gram, weights.as_mut_slice());
        Ok(weights)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_line_is_fitted_in_two_blocks_and_a_third_column_is_left_out() {
        let (mut first, mut second) = (NormalEquations::new(3), NormalEquations::new(3));
        first.add(&[1.0, 9.0, 0.0, 1.0, 7.0, 1.0], &[1.0, 3.0]).unwrap();
        second.add(&[1.0, 8.0, 2.0], &[5.0]).unwrap();
        first.merge(&second).unwrap();
        let weights = first.solve(&[2, 0]).unwrap();
        assert!((weights - DVector::from_vec(vec![2.0, 1.0])).amax() < 1e-14);
    }

    #[test]
    fn columns_that_depend_on_each_other_are_refused() {
        let mut equations = NormalEquations::new(2);
        equations.add(&[0.1, 0.3, 0.7, 2.1], &[1.0, 2.0]).unwrap();
        let error = equations.solve(&[0, 1]).unwrap_err();
        assert!(matches!(error, DynamicsError::NotPositiveDefinite { row: 1, .. }), "{error}");
        assert!(equations.solve(&[1]).is_ok());
    }
}
