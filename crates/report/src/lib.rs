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
mod diagnosis;
mod learning;
mod paper;
mod replay;
mod run;
#[cfg(test)]
mod sample;
mod tracking;
mod trials;

pub use crate::diagnosis::estimate::interval;
pub use crate::diagnosis::figure::figure;
pub use crate::diagnosis::json::json;
pub use crate::diagnosis::markdown::markdown;
pub use crate::diagnosis::notebook::notebook;
pub use crate::diagnosis::page::html;
pub use crate::diagnosis::report::Report;
pub use crate::diagnosis::residual::{LengthScale, ResidualJoint, ResidualModel};
pub use crate::diagnosis::tables::sizes;
pub use crate::diagnosis::text::text;
pub use change::page::{change_page, change_sentence, sizes_before};
pub use learning::comparison::{
    ComparedJoint, DataSet, KernelRow, LearningComparison as Comparison, ModelRow,
};
pub use learning::times::{Curve, Maker, PredictionTimes, TimePoint};
pub use pages::{
    FileHash, Provenance, ReportError, pack as packed, percent, push_warnings as warnings,
    quote_argument as quoted, sha256_of, significant, unit, write_folder,
};
pub use paper::{
    LEARNING_FIGURE_SCHEMA, LearningFigureReport, PREDICTION_TIME_FIGURE_SCHEMA,
    PredictionTimeFigureReport,
};
pub use replay::replay_report::{ReplayReport, ReplayedRun, ReplayedTorque, ReplayedWindow};
pub use run::claims::{ClaimRow, ClaimUnit, claim_rows, claim_text, claims_sentence};
pub use run::diagnosis_summary::{DiagnosisSummary as Told, summarise as told};
pub use run::run_report::RunReport;
pub use tracking::comparison::{
    ControllerGains as Gains, ErrorSweep as Sweep, FirstSeconds, SweptModel, TrackedModel,
    TrackingComparison, WallTiming,
};
pub use trials::{panel_page, trials_page};
