//! What was found, for people and for programs: a page, a figure, a text for the terminal, JSON.
//!
//! ```text
//! Report { diagnosis, traces, robot, forward, .. }      -> json(), html(), notebook(), figure(), text(), markdown()
//! LearningComparison { joints, models, data, .. } of learning  -> json(), page(), figure(), text()
//! TrackingComparison { models, sweep, .. } of runs     -> json(), page(), three figures, text()
//! RunReport { metrics, diagnosis, .. } of a run             -> json(), page(), text()
//! ReplayReport { runs, .. } of logs in simulation      -> json(), page()
//! diagnosis::Comparison of two sets of logs            -> change_page(), change_json()
//! ```
//!
//! None of them holds a date or a random number: the same input gives the same
//! bytes.

#[cfg(test)]
mod browser;
mod change;
mod diagnosis;
mod learning;
mod replay;
mod run;
#[cfg(test)]
mod sample;
mod tracking;

pub use crate::diagnosis::estimate::interval;
pub use crate::diagnosis::figure::figure;
pub use crate::diagnosis::input_options::InputOptions;
pub use crate::diagnosis::json::{diagnosis_schema, json};
pub use crate::diagnosis::markdown::markdown;
pub use crate::diagnosis::notebook::notebook;
pub use crate::diagnosis::page::html;
pub use crate::diagnosis::report::Report;
pub use crate::diagnosis::residual::{LengthScale, ResidualJointRow, ResidualModel};
pub use crate::diagnosis::tables::sizes;
pub use crate::diagnosis::text::text;
pub use change::json::{change_json, change_schema};
pub use change::page::{change_page, change_sentence, sizes_before};
pub use learning::comparison::{ComparedJoint, DataSet, KernelRow, LearningComparison, ModelRow};
pub use pages::{
    FileHash, Provenance, ReportError, TERMINAL_WIDTH, pack, percent, push_warnings,
    quote_argument, sha256_of, significant, unit, wrap, write_folder, written_schema,
};
pub use replay::replay_report::{ReplayReport, ReplayedRun, ReplayedTorque, ReplayedWindow};
pub use run::claims::{ClaimRow, ClaimUnit, claim_rows, claim_text, claims_sentence};
pub use run::diagnosis_summary::{DiagnosisSummary, summarise};
pub use run::run_report::RunReport;
pub use tracking::comparison::{
    ControllerGains, ErrorSweep, FirstSeconds, SweptFeedforward, TrackedModel, TrackingComparison,
    WallTiming,
};
