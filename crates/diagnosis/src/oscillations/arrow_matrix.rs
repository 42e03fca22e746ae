use nalgebra::DVector;

/// A symmetric matrix of blocks of two on the diagonal and a border of one row and column: what one beat and an amplitude a
/// run make of least squares.
///
/// ```text
/// B_0           b_0
///       ...
///           B_n b_n
/// b_0ᵀ ... b_nᵀ  c
/// ```
#[derive(Debug, Clone)]
pub(crate) struct ArrowMatrix {
    blocks: Vec<Block>,
    corner: f64,
}

/// A block and its part of the border, of which the lower triangle is kept.
#[derive(Debug, Clone, Copy, Default)]
struct Block {
    first: f64,
    below: f64,
    second: f64,
    border: [f64; 2],
}

/// The Cholesky factor `L`, `A = L Lᵀ`, of the same form.
#[derive(Debug)]
pub(crate) struct ArrowFactor(ArrowMatrix);

impl ArrowMatrix {
    pub fn zeros(blocks: usize) -> Self {
        Self { blocks: vec![Block::default(); blocks], corner: 0.0 }
    }

    /// Adds `row rowᵀ`, where the row has entries in one block and in the border.
    pub fn add(&mut self, block: usize, [first, second, border]: [f64; 3]) {
        let to = &mut self.blocks[block];
        to.first += first * first;
        to.below += second * first;
        to.second += second * second;
        to.border[0] += border * first;
        to.border[1] += border * second;
        self.corner += border * border;
    }

    pub fn corner_mut(&mut self) -> &mut f64 {
        &mut self.corner
    }

    /// `None` where the matrix is not positive definite.
    pub fn factor(mut self) -> Option<ArrowFactor> {
        let root = |pivot: f64| (pivot > 0.0).then(|| pivot.sqrt());
        for Block { first, below, second, border: [b, c] } in &mut self.blocks {
            *first = root(*first)?;
            *below /= *first;
            *b /= *first;
            *second = root(*second - *below * *below)?;
            *c = (*c - *below * *b) / *second;
            self.corner = self.corner - *b * *b - *c * *c;
        }
        self.corner = root(self.corner)?;
        Some(ArrowFactor(self))
    }
}

impl ArrowFactor {
    /// `A⁻¹ b` in place of `b`.
    pub fn solve(&self, b: &mut DVector<f64>) {
        let Self(ArrowMatrix { blocks, corner }) = self;
        let last = 2 * blocks.len();
        for (s, block) in blocks.iter().enumerate() {
            b[2 * s] /= block.first;
            b[2 * s + 1] = (b[2 * s + 1] - b[2 * s] * block.below) / block.second;
            b[last] = b[last] - b[2 * s] * block.border[0] - b[2 * s + 1] * block.border[1];
        }
        b[last] /= *corner;
        b[last] /= *corner;
        for (s, block) in blocks.iter().enumerate() {
            b[2 * s + 1] = (b[2 * s + 1] - block.border[1] * b[last]) / block.second;
            let left = block.below * b[2 * s + 1] + block.border[0] * b[last];
            b[2 * s] = (b[2 * s] - left) / block.first;
        }
    }

    /// `A⁻¹ g` of several `g`, summed column by column of `A⁻¹`.
    pub fn inverse_times<const N: usize>(&self, g: &[DVector<f64>; N]) -> [DVector<f64>; N] {
        let size = 2 * self.0.blocks.len() + 1;
        let mut products = [(); N].map(|()| DVector::zeros(size));
        for k in 0..size {
            if g.iter().all(|g| g[k] == 0.0) {
                continue;
            }
            let mut column = DVector::zeros(size);
            column[k] = 1.0;
            self.solve(&mut column);
            products.iter_mut().zip(g).for_each(|(product, g)| product.axpy(g[k], &column, 1.0));
        }
        products
    }
}

#[cfg(test)]
mod tests {
    use nalgebra::DMatrix;
    use rand::{RngExt, SeedableRng};
    use rand_chacha::ChaCha8Rng;

    use super::*;

    /// To the bit: what is zero in the dense matrix adds nothing to a sum.
    #[test]
    fn oracle_a_dense_matrix_has_the_same_factor_and_inverse() {
        let mut random = ChaCha8Rng::seed_from_u64(7);
        for blocks in [1, 2, 7, 30] {
            let size = 2 * blocks + 1;
            let (mut arrow, mut dense) = (ArrowMatrix::zeros(blocks), DMatrix::zeros(size, size));
            for k in 0..9 * blocks {
                let row: [f64; 3] = std::array::from_fn(|_| random.random::<f64>() - 0.4);
                arrow.add(k % blocks, row);
                let places = [2 * (k % blocks), 2 * (k % blocks) + 1, size - 1];
                for (i, a) in places.into_iter().zip(row) {
                    places.into_iter().zip(row).for_each(|(k, b)| dense[(i, k)] += a * b);
                }
            }
            let (arrow, dense) = (arrow.factor().unwrap(), dense.cholesky().unwrap());
            let g: [DVector<f64>; 2] = std::array::from_fn(|_| {
                DVector::from_fn(size, |_, _| random.random::<f64>() - 0.5)
            });
            let mut solved = g[0].clone();
            arrow.solve(&mut solved);
            assert_eq!(solved, dense.solve(&g[0]));
            let inverse = dense.inverse();
            assert_eq!(arrow.inverse_times(&g), g.map(|g| &inverse * &g));
        }
    }

    #[test]
    fn what_is_not_positive_definite_has_no_factor() {
        let mut matrix = ArrowMatrix::zeros(2);
        matrix.add(0, [1.0, 0.0, 0.0]);
        matrix.add(0, [0.0, 1.0, 1.0]);
        matrix.add(1, [1.0, 1.0, 1.0]);
        assert!(matrix.clone().factor().is_none(), "one row does not determine two");
        matrix.add(1, [1.0, -1.0, 0.5]);
        matrix.add(1, [1.0, -2.0, 0.3]);
        assert!(matrix.clone().factor().is_some());
        *matrix.corner_mut() = f64::NAN;
        assert!(matrix.factor().is_none());
    }
}
