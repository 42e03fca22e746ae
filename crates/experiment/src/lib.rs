//! From plant to gain: an arm with effects, the models learned of it, and their gain.
//!
//! ```text
//! TrackingScenario --simulate--> logs --diagnose, learn--> Learned --track--> TrackedRun, Sweep
//! logs, diagnosis --learn--> Residual: a process of what the findings leave
//! logs, diagnosis --replay--> a recording of the measured arm beside the simulated one
//! Experiment --simulate, diagnose, learn, track--> Metrics: found, torque, drift, tracking
//! ```
//!
//! The simulated arm and the models of it meet here; models learn from the arm's logs alone.
//!
//! - `scenario` states the motion, the gains and the feedforward of a tracking run;
//! - `models` learns from logs: models of the torque, and a process of what the findings leave;
//! - `tracking` tracks a motion with each model fed forward, and writes the runs;
//! - `torque` measures errors of predicted torque, `replay` the drift of a simulation;
//! - `gain` compares those errors before and after;
//! - `scoring` compares a diagnosis with the truth, `claims` the numbers with the paper.

mod claims;
mod error;
mod experiment;
mod gain;
mod metrics;
mod models;
mod progress;
mod replay;
mod scenario;
mod scoring;
mod stage;
mod torque;
mod tracking;

pub use claims::claim::{Claim, ClaimCase, ClaimVerdict, Scope};
pub use claims::paper_models::{PAPER_MODELS, PROCESSES, SEMIPARAMETRIC};
pub use claims::tracking_claims::tracking_claims;
pub use error::ExperimentError;
pub use experiment::{Experiment, with_seed};
pub use gain::PredictionGain;
pub use metrics::Metrics;
pub use models::learned::{Learned, Lesson};
pub use models::median_time::median_time_s;
pub use models::relevance::Relevance;
pub use models::residual::{Residual, ResidualJoint, learn_residual};
pub use progress::Progress;
pub use replay::forward_gap::{
    Drift, ForwardGap, ForwardWindow, forward_gap, forward_gap_of_logs, tip_drift_rms_m,
};
pub use replay::record_diagnosis::{DiagnosedLogs, record_diagnosis};
pub use scenario::feedforward_kind::FeedforwardKind;
pub use scenario::tracking_scenario::{TrackingScenario, document_at, known_runs, motion_at};
pub use scenario::tracking_spec::{
    AheadSpec, ClockSpec, ErrorRateSpec, LearnSpec, Measured, PredictionSpec, PredictionTimeSpec,
    SweepSpec, TrackingControlSpec, TrackingSpec,
};
pub use scoring::blinded::Blinded;
pub use scoring::score::{Injected, Named, Score};
pub use scoring::size::{Estimated, Size};
pub use scoring::stored;
pub use stage::{Product, Stage, StageInputs, Staged, sha256};
pub use torque::band::Band;
pub use torque::torque_error::{TorqueError, robot_error, torque_errors};
pub use torque::turning_error::TurningError;
pub use tracking::outputs::Outputs;
pub use tracking::sweep::{GainSweep, SweptModel, sweep};
pub use tracking::track::{simulated_logs, track_all};
pub use tracking::tracked_error::TrackedError;
pub use tracking::tracked_run::{TrackedRun, Written};
