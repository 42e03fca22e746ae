//! Scenarios put to work: an arm with effects, what is learned of it, and what that gains.
//!
//! ```text
//! TrackingScenario --simulate--> logs --diagnose, learn--> Learned --track--> TrackedRun, Sweep
//! logs, diagnosis --learn--> Residual: a process of what the findings leave
//! logs, diagnosis --replay--> a recording of the measured arm beside the simulated one
//! Experiment --simulate, diagnose, learn, track--> Metrics: found, torque, drift, tracking
//! LearningFigure --simulate, diagnose, learn--> LearningErrors --judge--> Claims
//! Trial --simulate, diagnose blind--> Score --many--> Tally
//! Campaign --plan--> CampaignFolder --work--> shards of Records --> Merged: tally, power
//! Sheet, Answers --> Judgement --many--> PanelTally; two results of the same trials --> Comparison
//! ```
//!
//! The one place where the simulated arm and the models of it meet; what is learned is learned
//! from the arm's logs alone.

mod baselines;
mod error;
mod experiment;
mod feedforward_kind;
mod forward_gap;
mod gain;
mod learned;
mod median_time;
mod metrics;
mod panel;
mod paper;
mod predictions;
mod progress;
mod record_diagnosis;
mod relevance;
mod replayed;
mod residual;
mod sealed;
mod stage;
mod stream;
mod sweep;
mod torque_error;
mod track;
mod tracked_error;
mod tracking_scenario;
mod tracking_spec;
mod trials;
mod turning_error;
mod words;

pub use baselines::{Baseline, least_squares, robot_error, two_questions};
pub use error::EvaluationError;
pub use experiment::Experiment;
pub use feedforward_kind::FeedforwardKind;
pub use forward_gap::{Drift, ForwardGap, ForwardWindow, forward_gap, forward_gap_of_logs};
pub use gain::{Gain, Gains};
pub use learned::Learned;
pub use median_time::median_time_s;
pub use metrics::Metrics;
pub use panel::{
    Answers, BaselineClaim, Comparison, Costs, Fraction, HeldOut, JudgedCause, JudgedFinding,
    Judgement, KindRow, Measure, MergedPanel, Naming, PANEL_SCHEMA, PairedMean, PairedShare,
    PanelRow, PanelTally, Prediction, Quantity, Rate, Ratios, RelativeError, Side, SlowDiagnosis,
    StrangerRow, Turned,
};
pub use paper::{
    Claim, ClaimCase, DataSpec, FigureScenario, FigureSpec, LearningErrors, LearningFigure,
    LearningFigureSpec, ModelErrors, ModelTime, PAPER_MODELS, PaperData, PaperPlant,
    PredictionTimeFigure, PredictionTimeFigureSpec, Scope, Verdict, learning_claims, time_claims,
    tracking_claims,
};
pub use progress::Progress;
pub use record_diagnosis::{Diagnosed, record_diagnosis};
pub use relevance::Relevance;
pub use residual::{Residual, ResidualJoint, learn_residual};
pub use sealed::Sealed;
pub use stage::{Inputs, Product, Stage, Staged};
pub use stream::Written;
pub use sweep::{GainSweep, SweptModel, sweep};
pub use torque_error::{TorqueError, torque_errors};
pub use track::{Outputs, TrackedRun, simulated_logs, track_all};
pub use tracked_error::TrackedError;
pub use tracking_scenario::TrackingScenario;
pub use tracking_spec::{
    AheadSpec, ClockSpec, ErrorRateSpec, LearnSpec, Measured, PredictionSpec, PredictionTimeSpec,
    SweepSpec, TrackingControlSpec, TrackingSpec,
};
pub use trials::{
    BrokenShard, Campaign, CampaignFolder, CampaignSpec, Confusion, Crew, Estimated, Failure,
    Gained, Group, Hidden, KindCount, Lessened, MERGED_SCHEMA, Made, Merged, Named, NoPart, Part,
    PopulationCampaign, Power, PutIn, Record, Row, ScenarioCampaign, Score, Scored, Share, Size,
    SizeClass, SizeTally, Tally, TextTable, Trial, TrialLogs, WorkProgress, finished, judge, work,
};
