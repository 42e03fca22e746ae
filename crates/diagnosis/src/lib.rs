//! From logs to named causes with honest uncertainty, and the robot extended by them.

mod result;
mod traces;

pub use result::{
    DataSummary, Dependence, Diagnosis, EffectAt, Estimate, Finding, FoldGain, Gain, InverseGain,
    JointReport, NoiseFloorSource, RuledOut, RunSummary, SCHEMA, Unexplained, Verdict,
};
pub use traces::{JointTraces, RunTraces};
