use crate::error::{GpError, check};

/// The Gaussian kernel with one width per input:
///
/// ```text
/// k(x, x') = signal_variance exp(-1/2 sum_d ((x_d - x'_d) / length_scales[d])²)
/// ```
///
/// Rasmussen & Williams 2006, equation 5.1; Nguyen-Tuong & Peters 2010, appendix, with
/// `W = diag(1 / length_scales²)`.
#[derive(Debug, Clone, PartialEq)]
pub struct GaussianKernel {
    /// `sigma_f²`, in squared units of the target.
    pub signal_variance: f64,
    /// `l_d`, in the unit of input `d`.
    pub length_scales: Vec<f64>,
}

impl GaussianKernel {
    /// Number of inputs.
    pub fn inputs(&self) -> usize {
        self.length_scales.len()
    }

    /// `k(a, b)`, the plain form that the loops of this crate are tested against.
    ///
    /// # Panics
    ///
    /// When a point has fewer entries than the kernel has inputs.
    pub fn value(&self, a: &[f64], b: &[f64]) -> f64 {
        let scaled = |d: usize| (a[d] - b[d]) / self.length_scales[d];
        let square: f64 = (0..self.inputs()).map(|d| scaled(d) * scaled(d)).sum();
        self.signal_variance * (-0.5 * square).exp()
    }

    /// Refuses hyperparameters that are not positive and finite.
    ///
    /// # Errors
    ///
    /// [`GpError::NotFinite`], [`GpError::NotPositive`].
    pub fn check(&self) -> Result<(), GpError> {
        check("length_scales", &self.length_scales, self.inputs())?;
        check("signal_variance", &[self.signal_variance], 1)?;
        let scales = self.length_scales.iter().map(|&l| ("length scale", l));
        let all = scales.chain([("signal variance", self.signal_variance)]);
        for (name, value) in all {
            if value <= 0.0 {
                return Err(GpError::NotPositive { name, value });
            }
        }
        Ok(())
    }
}
