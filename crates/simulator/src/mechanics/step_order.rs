use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

/// Power of the step with which the error of a simulation falls.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum StepOrder {
    /// The engine is rapier, whose step is of first order.
    #[default]
    First,
    /// The tree of bodies is worked out here, and its step is of second order.
    Second,
}
