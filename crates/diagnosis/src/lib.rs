//! From logs to named causes with honest uncertainty, and the robot extended by them.
//!
//! ```text
//! effort - nominal effort = sum over hypotheses of columns weights + structure + noise
//! ```
//!
//! [`diagnose`] decides which hypotheses the logs support, how large the effects are, which other effects would explain
//! the logs as well, and what remains unexplained.
//!
//! A folder is a step, and imports only from earlier ones. [`Thresholds`] holds every number that decides.
//!
//! ```text
//! signals -> columns -> regression -> search -> outcome
//!                       readiness, oscillations
//! ```
//!
//! [`account_for`] is an instrument for whoever knows the truth: how far every true name came, and which test stopped it.

mod account;
mod columns;
mod compare;
mod diagnose;
mod error;
mod find_tones;
mod how_found;
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

pub use account::place_account::{LookedFor, PlaceAccount, SearchFate, Taker};
pub use account::place_test::PlaceTest;
pub use account::search_account::{JointReach, SearchAccount, account_for};
pub use compare::{Comparison, FirstSize, compare};
pub use diagnose::{DiagnosisRun, diagnose};
pub use error::DiagnosisError;
pub use how_found::{HowFound, how_found};
pub use outcome::held_out::{HeldOutPart, Span};
pub use outcome::traces::{JointTraces, RunTraces};
pub use progress::{DiagnosisProgress, Silent};
pub use result::{
    AlsoFitted, DataSummary, Dependence, Diagnosis, EffectAt, Estimate, Finding, FittedParameter,
    FoldGain, Gain, InverseGain, JointReport, Negligible, NoiseFloorSource, NoiseSpectrum,
    RuledOut, RunSummary, SCHEMA, Unexplained, Verdict,
};
pub use settings::Settings;
pub use signals::left_over::{LeftOver, unexplained_torque};
pub use thresholds::Thresholds;
pub use thresholds::blocks::BlockThresholds;
pub use thresholds::limits::LimitThresholds;
pub use thresholds::readiness::ReadinessThresholds;
pub use thresholds::search::SearchThresholds;
pub use thresholds::signals::SignalThresholds;
pub use thresholds::sizes::SizeThresholds;
pub use thresholds::springs::SpringThresholds;
pub use thresholds::tones::ToneThresholds;
pub use thresholds::verdict::VerdictThresholds;
