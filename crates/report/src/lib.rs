//! What was found, for people and for programs: a page, a figure, a text for the terminal, JSON.
//!
//! ```text
//! Report { diagnosis, traces, robot, forward, .. }      -> json(), html(), notebook(), figure(), text(), markdown()
//! Comparison { joints, models, data, .. } of learning  -> json(), page(), figure(), text()
//! PredictionTimes { curves, .. }                       -> json(), figure(), text()
//! TrackingComparison { models, sweep, .. } of runs     -> json(), page(), three figures, text()
//! RunReport { metrics, told, .. } of a run             -> json(), page(), text()
//! ReplayReport { runs, .. } of logs in simulation      -> json(), page()
//! diagnosis::Comparison of two sets of logs            -> change_page()
//! LearningFigureReport, PredictionTimeFigureReport     -> json(), page(), figures, text()
//! evaluation::Merged { counts, tally, power } of trials -> trials_page()
//! evaluation::MergedPanel { counts, tally } of trials   -> panel_page()
//! ```
//!
//! None of them holds a date or a random number: the same input gives the same
//! bytes.

#[cfg(test)]
mod browser;
mod change;
mod claims;
mod estimate;
mod figures;
mod forward;
mod html;
mod json;
mod learning;
mod markdown;
mod notebook;
mod paper;
mod places;
mod poster;
mod replay;
mod residual;
mod run;
#[cfg(test)]
mod sample;
mod sentence;
mod spectra;
mod tables;
mod terminal;
mod tracking;
mod trials;

pub use change::{change_page, change_sentence, sizes_before};
pub use claims::{ClaimRow, Quantity, claim_rows, claim_text, claims_sentence};
pub use estimate::interval;
pub use html::html;
pub use json::json;
pub use learning::{
    ComparedJoint, Comparison, Curve, DataSet, KernelRow, LEARNING_SCHEMA, Maker, ModelRow,
    PredictionTimes, TIMES_SCHEMA, TimePoint,
};
pub use markdown::markdown;
pub use notebook::notebook;
pub use pages::{
    FileHash, Provenance, ReportError, pack as packed, percent, push_warnings as warnings,
    quote_argument as quoted, sha256_of, significant, unit, write_folder,
};
pub use paper::{
    LEARNING_FIGURE_SCHEMA, LearningFigureReport, PREDICTION_TIME_FIGURE_SCHEMA,
    PredictionTimeFigureReport,
};
pub use poster::figure;
pub use replay::{REPLAY_SCHEMA, ReplayReport, ReplayedRun, ReplayedTorque, ReplayedWindow};
pub use residual::{LengthScale, ResidualJoint, ResidualModel};
pub use run::{RUN_SCHEMA, RunReport, Told, told};
pub use sentence::{bottom_line, verdict_sentence};
pub use tables::sizes;
pub use terminal::text;
pub use tracking::{
    FirstSeconds, Gains, Sweep, SweptModel, TRACKING_SCHEMA, TrackedModel, TrackingComparison,
    WallTiming,
};
pub use trials::{panel_page, trials_page};

/// Everything that a report shows.
#[derive(Debug, Clone, Copy)]
pub struct Report<'a> {
    /// The answer.
    pub diagnosis: &'a diagnosis::Diagnosis,
    /// The signals behind it, one entry a run.
    pub traces: &'a [diagnosis::RunTraces],
    /// The robot as it was given, for units and for the joint of a link.
    pub robot: &'a robot::Robot,
    /// The model of what the findings leave, where one was learned.
    pub residual: Option<&'a ResidualModel>,
    /// How far simulations drift from the logs, where that was measured.
    pub forward: Option<&'a evaluation::ForwardGap>,
    /// The extended robot in files of other programs, and what became of every quantity.
    pub descriptions: &'a [(exchange::Format, exchange::Export)],
    /// Where the answer comes from.
    pub provenance: &'a Provenance,
}

impl<'a> Report<'a> {
    /// What a diagnosis of logs of `robot` came to, and no more.
    pub fn new(
        outcome: &'a diagnosis::Outcome,
        robot: &'a robot::Robot,
        provenance: &'a Provenance,
    ) -> Self {
        let diagnosis::Outcome { diagnosis, traces, .. } = outcome;
        Self {
            diagnosis,
            traces,
            robot,
            residual: None,
            forward: None,
            descriptions: &[],
            provenance,
        }
    }
}
