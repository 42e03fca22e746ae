//! Weights of a model from normal equations by block: evidence, prediction of held-out blocks, physically possible
//! sizes about the robot with the findings, and their uncertainty.

pub(crate) mod blocks;
pub(crate) mod body_errors;
pub(crate) mod extend_robot;
pub(crate) mod fit;
pub(crate) mod fitted_model;
pub(crate) mod fitted_springs;
pub(crate) mod gram;
pub(crate) mod linear_fit;
pub(crate) mod noise;
pub(crate) mod physical_inertias;
pub(crate) mod problem;
pub(crate) mod uncertainty;
