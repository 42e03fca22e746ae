use dynamics::DynamicsError;

use crate::error::LearnerError;

/// The prior on the parameters: independent Gaussian distributions.
#[derive(Debug, Clone, PartialEq)]
pub struct GaussianPrior {
    /// Expected values, in the order and units of the columns.
    pub mean: Vec<f64>,
    /// Standard deviations; infinite for a parameter without a prior.
    pub standard_deviations: Vec<f64>,
}

impl GaussianPrior {
    /// Checks the prior of `expected` parameters.
    pub(crate) fn check(&self, expected: usize) -> Result<(), LearnerError> {
        let lengths = [
            ("mean of the prior", self.mean.len()),
            ("standard deviations of the prior", self.standard_deviations.len()),
        ];
        if let Some(&(vector, got)) = lengths.iter().find(|(_, got)| *got != expected) {
            return Err(DynamicsError::WrongLength { vector, expected, got }.into());
        }
        if let Some(index) = self.mean.iter().position(|m| !m.is_finite()) {
            let (vector, value) = (lengths[0].0, self.mean[index]);
            return Err(DynamicsError::NotFinite { vector, index, value }.into());
        }
        match self.standard_deviations.iter().find(|&&sd| sd.is_nan() || sd <= 0.0) {
            Some(&value) => {
                let name = "standard deviation of the prior";
                Err(DynamicsError::NotPositive { name, value }.into())
            }
            None => Ok(()),
        }
    }
}
