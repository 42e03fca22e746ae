//! From logs to named causes with honest uncertainty, and the robot extended by them.
//!
//! ```text
//! effort - nominal effort = sum over hypotheses of columns weights + structure + noise
//! ```
//!
//! [`diagnose`] decides which hypotheses earn their place, how large they are, what they
//! cannot be told apart from and what is left over.

mod at_limits;
mod between;
mod blocks;
mod compare;
mod constancy;
mod contest;
mod design;
mod diagnose;
mod diagnosed;
mod error;
mod evaluate;
mod extend;
mod extent;
mod failed;
mod findings;
mod fit;
mod gain;
mod gram;
mod heard;
mod held_out;
mod idle;
mod inspected;
mod left_over;
mod limits;
mod log;
mod noise;
mod problem;
mod progress;
mod repeats;
mod report;
mod result;
mod rivals;
mod ruled_out;
mod search;
mod second_encoders;
mod select;
mod settings;
mod settle;
mod settled;
mod shapes;
mod spectrum;
mod structure;
mod study;
mod tone;
mod tone_finding;
mod tone_fit;
mod tones;
mod torque_noise;
mod traces;
mod uncertainty;
mod verdict;
mod worse;

pub use compare::{Comparison, FirstSize, compare};
pub use diagnose::{Outcome, diagnose};
pub use diagnosed::{Diagnosed, diagnosed};
pub use error::DiagnosisError;
pub use held_out::{HeldOut, Span};
pub use left_over::{LeftOver, left_over};
pub use progress::{Progress, Silent};
pub use result::{
    DataSummary, Dependence, Diagnosis, EffectAt, Estimate, Finding, FoldGain, Gain, InverseGain,
    JointReport, Negligible, NoiseFloorSource, NoiseSpectrum, RuledOut, RunSummary, SCHEMA,
    Unexplained, Verdict,
};
pub use settings::Settings;
pub use traces::{JointTraces, RunTraces};
