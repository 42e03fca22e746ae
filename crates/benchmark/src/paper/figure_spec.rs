use std::path::PathBuf;

use document::Document;
use experiment::LearnSpec;
use motion::MotionSpec;
use schemars::JsonSchema;
use serde::de::IgnoredAny;
use serde::{Deserialize, Serialize};

use crate::error::BenchmarkError;

/// A scenario that draws a figure of Nguyen-Tuong & Peters 2010.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "Plumbline figure scenario")]
pub struct FigureScenario {
    /// The figure.
    pub figure: FigureSpec,
}

/// A figure of the paper and what it is drawn from.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum FigureSpec {
    /// Figure 1: the time of one prediction against the number of training points.
    PredictionTime(PredictionTimeFigureSpec),
    /// Figure 2: the errors of learned models where rigid bodies describe the data and where they
    /// do not.
    Learning(Box<LearningFigureSpec>),
}

/// Figure 1: the time of one prediction against the number of training points.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PredictionTimeFigureSpec {
    /// The robot's `robot.toml` or URDF, relative to this file.
    pub robot: PathBuf,
    /// Numbers of training points, rising.
    pub points: Vec<usize>,
    /// Seed of the points, which are made up.
    #[serde(default)]
    pub seed: u64,
}

/// Figure 2: the errors of learned models, and those of the robot with its named effects.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LearningFigureSpec {
    /// Data that rigid bodies describe.
    pub simulated: DataSpec,
    /// Data that they do not.
    pub real: DataSpec,
    /// What the models are learned from: runs of both arms.
    pub learn: LearnSpec,
    /// The runs that the errors are measured on.
    pub test: Vec<String>,
    /// Samples of them that are used, spread evenly.
    #[serde(default = "as_in_the_paper")]
    pub test_points: usize,
    /// A motion outside what was learned from, of the arm with the real data.
    pub outside: MotionSpec,
}

/// Where data come from.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DataSpec {
    /// The scenario of the arm, relative to this file.
    pub plant: PathBuf,
    /// Settings of that scenario, `key=value` as `--set` takes them.
    #[serde(default, skip_serializing_if = "Vec::is_empty")]
    pub settings: Vec<String>,
}

fn as_in_the_paper() -> usize {
    3000
}

impl FigureScenario {
    /// Whether a document is the scenario of a figure.
    ///
    /// # Errors
    ///
    /// [`ExperimentError::Document`](experiment::ExperimentError::Document) for a document that is no table.
    pub fn is_meant(document: &Document) -> Result<bool, BenchmarkError> {
        Ok(document.parse::<Kind>()?.figure.is_some())
    }
}

/// What tells the scenario of a figure from others.
#[derive(Deserialize)]
struct Kind {
    figure: Option<IgnoredAny>,
}
