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
//! benchmark::Merged { counts, tally, power } of trials -> trials_page()
//! benchmark::MergedPanel { counts, tally } of trials   -> panel_page()
//! ```
//!
//! None of them holds a date or a random number: the same input gives the same
//! bytes.

#[cfg(test)]
mod browser;
mod change;
mod chart;
mod decimate;
mod dots;
mod error;
mod figures;
mod files;
mod forward;
mod grid;
mod html;
mod html_grid;
mod inks;
mod json;
mod learning;
mod linear_axis;
mod log_axis;
mod markdown;
mod notebook;
mod numbers;
mod page;
mod paper;
mod places;
mod plot;
mod poster;
mod provenance;
mod replay;
mod residual;
mod run;
#[cfg(test)]
mod sample;
mod script;
mod sentence;
mod sheet;
mod spectra;
mod tables;
mod terminal;
mod tracking;
mod trials;
mod wrap;

pub use change::{change_page, change_sentence, sizes_before};
pub use error::ReportError;
pub use files::{sha256_of, write_folder};
pub use html::html;
pub use json::json;
pub use learning::{
    ComparedJoint, Comparison, Curve, DataSet, KernelRow, LEARNING_SCHEMA, Maker, ModelRow,
    PredictionTimes, TIMES_SCHEMA, TimePoint,
};
pub use markdown::markdown;
pub use notebook::notebook;
pub use numbers::{interval, percent, significant, unit};
pub use paper::{
    LEARNING_FIGURE_SCHEMA, LearningFigureReport, PREDICTION_TIME_FIGURE_SCHEMA,
    PredictionTimeFigureReport,
};
pub use poster::figure;
pub use provenance::{FileHash, Provenance, quoted};
pub use replay::{REPLAY_SCHEMA, ReplayReport, ReplayedRun, ReplayedTorque, ReplayedWindow};
pub use residual::{LengthScale, ResidualJoint, ResidualModel};
pub use run::{RUN_SCHEMA, RunReport, Told, told};
pub use sentence::{bottom_line, verdict_sentence};
pub use tables::sizes;
pub use terminal::{text, warnings};
pub use tracking::{
    FirstSeconds, Gains, Sweep, SweptModel, TRACKING_SCHEMA, TrackedModel, TrackingComparison,
    WallTiming,
};
pub use trials::{panel_page, trials_page};
pub use wrap::packed;

use chart::{Axis, Chart, Series, Shape};

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
    pub forward: Option<&'a experiment::ForwardGap>,
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
