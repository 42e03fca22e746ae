//! From logs to named causes with honest uncertainty, and the robot extended by them.
//!
//! ```text
//! effort - nominal effort = sum over hypotheses of columns weights + structure + noise
//! ```
//!
//! [`diagnose`] decides which hypotheses earn their place, how large they are, what they
//! cannot be told apart from and what is left over.
//!
//! A folder is a step, and imports none that comes later:
//!
//! ```text
//! signals -> columns -> regression -> search -> outcome
//!                       readiness, oscillations
//! ```

mod columns;
mod compare;
mod diagnose;
mod diagnosed;
mod error;
mod oscillations;
mod outcome;
mod progress;
mod readiness;
mod regression;
mod result;
mod search;
mod settings;
mod signals;
mod thresholds;

pub use compare::{Comparison, FirstSize, compare};
pub use diagnose::{Outcome, diagnose};
pub use diagnosed::{Diagnosed, diagnosed};
pub use error::DiagnosisError;
pub use outcome::held_out::{HeldOut, Span};
pub use outcome::traces::{JointTraces, RunTraces};
pub use progress::{Progress, Silent};
pub use result::{
    DataSummary, Dependence, Diagnosis, EffectAt, Estimate, Finding, FoldGain, Gain, InverseGain,
    JointReport, Negligible, NoiseFloorSource, NoiseSpectrum, RuledOut, RunSummary, SCHEMA,
    Unexplained, Verdict,
};
pub use settings::Settings;
pub use signals::left_over::{LeftOver, left_over};
