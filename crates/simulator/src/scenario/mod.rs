//! Scenario files: what they may say, and how they are checked.

pub(crate) mod check;
pub(crate) mod resolved;
pub(crate) mod spec;

pub use check::{Scenario, ScenarioRun};
pub use spec::{
    ControlSpec, DropoutSpec, EngineSpec, HiddenSpec, Logged, RunSpec, ScenarioSpec, SensorSpec,
    ServoSpec,
};
