use gaussian_process::KernelSearch;

use crate::error::LearnerError;

/// Where the prior variances `B` of the rigid-body parameters come from (equation 6 of
/// Nguyen-Tuong & Peters 2010).
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum PriorSpread {
    /// Squares of the standard errors of the regression.
    StandardErrors,
    /// Expert knowledge: each parameter is known to this share of itself, or of the typical
    /// size of its kind in the robot where that is larger.
    Share(f64),
    /// The marginal likelihood, joint by joint; started from the standard errors.
    Evidence,
}

/// How models are trained.
#[derive(Debug, Clone, PartialEq)]
pub struct TrainSettings {
    /// Samples that exact processes are trained on, thinned evenly.
    pub points: usize,
    /// Inducing points.
    pub inducing_points: usize,
    /// Search for hyperparameters.
    pub search: KernelSearch,
    /// Prior of the rigid-body parameters.
    pub prior: PriorSpread,
    /// Weights of the Gaussian kernel beside the rigid-body kernel that are compared by
    /// cross-validation (equation 9): 0.5 to 5 in steps of 0.5 in the paper.
    pub lambdas: Vec<f64>,
    /// Stretches of time that the cross-validation leaves out in turn.
    pub folds: usize,
    /// Speed below which each joint counts as at rest (rad/s or m/s), where the directions of
    /// motion are to be inputs of the processes; else empty.
    pub direction_speeds: Vec<f64>,
}

impl Default for TrainSettings {
    fn default() -> Self {
        Self {
            points: 3000,
            inducing_points: 1000,
            search: KernelSearch::default(),
            prior: PriorSpread::StandardErrors,
            lambdas: (1..=10).map(|step| 0.5 * f64::from(step)).collect(),
            folds: 5,
            direction_speeds: Vec::new(),
        }
    }
}

impl TrainSettings {
    /// Refuses settings that are out of their ranges.
    ///
    /// # Errors
    ///
    /// [`LearnerError::Setting`].
    pub fn check(&self) -> Result<(), LearnerError> {
        let refuse =
            |name, found: String, expected| Err(LearnerError::Setting { name, found, expected });
        let positive = |x: f64| x.is_finite() && x > 0.0;
        if self.points == 0 {
            return refuse("points", "0".into(), "at least one");
        }
        if self.inducing_points == 0 {
            return refuse("inducing points", "0".into(), "at least one");
        }
        if self.folds < 2 {
            return refuse("folds", self.folds.to_string(), "at least two");
        }
        if self.lambdas.is_empty() || !self.lambdas.iter().all(|&l| positive(l)) {
            return refuse("lambdas", format!("{:?}", self.lambdas), "positive numbers");
        }
        match self.prior {
            PriorSpread::Share(share) if !positive(share) => {
                refuse("prior share", share.to_string(), "a positive number")
            }
            _ => Ok(()),
        }
    }
}
