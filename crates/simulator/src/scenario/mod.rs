//! Scenario files: what they may say, and how they are checked.

pub(crate) mod check;
pub(crate) mod files;
pub(crate) mod spec;

pub(crate) use check::injected;
pub use check::{Scenario, ScenarioRun};
pub use spec::{
    ControlSpec, DropoutSpec, EngineSpec, HiddenSpec, Logged, RunSpec, ScenarioSpec, SensorSpec,
};
