use std::collections::BTreeMap;
use std::path::PathBuf;

use motion::MotionSpec;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::scenario::feedforward_kind::FeedforwardKind;

/// A tracking scenario: an arm, a motion, the models whose torque is fed forward, and gains.
///
/// At a prismatic joint `nm` stands for N and `rad` for m.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
#[schemars(title = "Plumbline tracking scenario")]
pub struct TrackingSpec {
    /// The scenario of the arm that is tracked, relative to this file: its robot, effects,
    /// sensors and engine; what is learned is learned from its runs.
    pub plant: PathBuf,
    /// The motion that is tracked.
    pub motion: MotionSpec,
    /// Gains of the feedback.
    pub control: TrackingControlSpec,
    /// How predictions reach the loop.
    #[serde(default)]
    pub prediction: PredictionSpec,
    /// What the models are learned from.
    #[serde(default)]
    pub learn: LearnSpec,
    /// What is fed forward, run by run: none, gravity, or a model of `plumbline learn`.
    pub feedforward: Vec<FeedforwardKind>,
    /// The same over a range of gains.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub sweep: Option<SweepSpec>,
}

/// The feedback: `tau = kp error + kd error_rate`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TrackingControlSpec {
    /// A set of gains of `robot.toml`.
    pub gains: String,
    /// Gains of joints that differ from the set (N m/rad).
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub kp_nm_per_rad: BTreeMap<String, f64>,
    /// Gains of joints that differ from the set (N m s/rad).
    #[serde(default, skip_serializing_if = "BTreeMap::is_empty")]
    pub kd_nm_s_per_rad: BTreeMap<String, f64>,
    /// Where the rate of the error comes from.
    #[serde(default)]
    pub error_rate: ErrorRateSpec,
}

/// Where the rate of the error comes from.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
pub enum ErrorRateSpec {
    /// The velocity that the arm reports.
    Reading,
    /// The difference of the error from one period to the next behind a low pass of first order.
    FilteredDifference {
        /// Cut-off of the low pass (Hz).
        cutoff_hz: f64,
    },
}

impl Default for ErrorRateSpec {
    /// The low pass of libbarrett, 180 rad/s.
    fn default() -> Self {
        Self::FilteredDifference { cutoff_hz: 28.6 }
    }
}

/// How predictions reach the loop.
#[derive(Debug, Clone, PartialEq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct PredictionSpec {
    /// The clock that the loop runs on.
    pub clock: ClockSpec,
    /// How long a prediction takes on the virtual clock: "measured" before the run, or a number
    /// (ms).
    pub time_ms: PredictionTimeSpec,
    /// The moment of the motion that a prediction is for.
    pub ahead: AheadSpec,
    /// When the predictor dies on the virtual clock (s), if it is to.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub stops_at_s: Option<f64>,
}

/// The clock that the loop runs on.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum ClockSpec {
    /// Simulated: the same result every time.
    #[default]
    Virtual,
    /// The clock on the wall, with the predictor in a thread of its own.
    Wall,
}

/// How long a prediction takes on the virtual clock.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(untagged, expecting = "\"measured\" or a number (ms) was expected")]
pub enum PredictionTimeSpec {
    /// This long (ms).
    Given(f64),
    /// As long as it takes here.
    Here(Measured),
}

impl Default for PredictionTimeSpec {
    fn default() -> Self {
        Self::Given(0.1)
    }
}

/// The word for what is measured.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Measured {
    /// Measured before the run.
    Measured,
}

/// The moment of the motion that a prediction is for.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum AheadSpec {
    /// The moment at which it begins.
    #[default]
    Now,
    /// The middle of the time for which it will be used.
    Arrival,
}

/// What the models are learned from.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields, default)]
pub struct LearnSpec {
    /// Runs of the plant's scenario that Gaussian processes learn from.
    pub train: Vec<String>,
    /// Runs for the parameters of the rigid bodies; those of `train` where there are none.
    pub regression: Vec<String>,
    /// Samples that a Gaussian process learns from.
    pub points: usize,
}

impl Default for LearnSpec {
    fn default() -> Self {
        Self { train: Vec::new(), regression: Vec::new(), points: 3000 }
    }
}

/// The same over a range of gains.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SweepSpec {
    /// The set of gains that is scaled.
    pub gains: String,
    /// Factors of `kp`; `kd` goes with their square root, so that the damping ratio stays.
    pub scales: Vec<f64>,
    /// What is fed forward.
    pub feedforward: Vec<FeedforwardKind>,
    /// How much of the motion is tracked (s); all of it where it is left out.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub duration_s: Option<f64>,
}
