use nalgebra::{Cholesky, DMatrix, DVector, Dyn};

use crate::columns::design::Design;

/// The linear effects at one joint, and the residual effort after them.
pub(crate) struct LinearRest {
    /// Columns of those effects over all runs.
    pub x: DMatrix<f64>,
    /// Normal matrix including the priors.
    pub normal: Cholesky<f64, Dyn>,
    /// Measured minus nominal effort over all runs (N·m or N).
    pub y: DVector<f64>,
    /// Inverse prior variance of each weight, in units of the power of `y`.
    pub ridge: DVector<f64>,
    pub residual: DVector<f64>,
    /// Inverse mean square of the residual.
    pub weight: f64,
    /// One where a sample is informative, else zero. The other rows of `x` and `y` are zero too.
    pub is_informative: DVector<f64>,
}

impl LinearRest {
    pub fn new(design: &Design, j: usize) -> Option<Self> {
        let runs = || design.runs.iter().map(|r| &r.joints[j]);
        let samples = runs().map(|run| run.measured.len()).sum();
        let mut x = DMatrix::zeros(samples, design.local[j].len());
        let mut first = 0;
        for run in runs() {
            x.rows_mut(first, run.x.nrows()).copy_from(&run.x);
            first += run.x.nrows();
        }
        let is_informative =
            runs().flat_map(|run| &run.is_informative).map(|is| f64::from(u8::from(*is)));
        let is_informative = DVector::from_iterator(samples, is_informative);
        x.column_iter_mut().for_each(|mut column| column.component_mul_assign(&is_informative));
        let y = DVector::from_iterator(samples, runs().flat_map(|run| run.residual()));
        let y = y.component_mul(&is_informative);
        let power = y.norm_squared() / samples.max(1) as f64;
        let ridge = design.local[j].iter().map(|&column| power / design.prior[column].powi(2));
        let ridge = DVector::from_iterator(x.ncols(), ridge);
        let normal = (x.tr_mul(&x) + DMatrix::from_diagonal(&ridge)).cholesky()?;
        let residual = &y - &x * normal.solve(&x.tr_mul(&y));
        let mean = residual.norm_squared() / samples.max(1) as f64;
        (mean > 0.0).then(|| Self {
            x,
            normal,
            y,
            ridge,
            residual,
            weight: mean.recip(),
            is_informative,
        })
    }
}
