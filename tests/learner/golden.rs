//! The values of scikit-learn, and of NumPy for the closed forms of the paper.

use checks::arms::workspace_root;
use serde::Deserialize;

/// A regression problem of 60 points with 21 inputs, and what other programs make of it.
#[derive(Deserialize)]
pub struct Golden {
    #[serde(rename = "X")]
    pub points: Vec<Vec<f64>>,
    #[serde(rename = "y")]
    pub targets: Vec<f64>,
    #[serde(rename = "X_test")]
    pub queries: Vec<Vec<f64>>,
    pub length_scales: Vec<f64>,
    pub signal_variance: f64,
    pub noise_variance: f64,
    pub mean: Vec<f64>,
    pub latent_plus_noise_std: Vec<f64>,
    pub semiparametric: Semiparametric,
}

/// The same with five more columns as the linear part.
#[derive(Deserialize)]
pub struct Semiparametric {
    #[serde(rename = "Phi")]
    pub features: Vec<Vec<f64>>,
    #[serde(rename = "Phi_test")]
    pub query_features: Vec<Vec<f64>>,
    pub beta0: Vec<f64>,
    #[serde(rename = "B_diagonal")]
    pub prior_variances: Vec<f64>,
    pub mean_fixed_beta: Vec<f64>,
    pub beta_bar: Vec<f64>,
    pub mean_prior_beta: Vec<f64>,
    #[serde(rename = "rbd_kernel_W_diagonal")]
    pub kernel_variances: Vec<f64>,
    pub lambda: f64,
    pub mean_rbd_kernel: Vec<f64>,
}

pub fn golden() -> Golden {
    let path = workspace_root().join("tests/golden/gaussian_process.json");
    serde_json::from_str(&std::fs::read_to_string(path).unwrap()).unwrap()
}
