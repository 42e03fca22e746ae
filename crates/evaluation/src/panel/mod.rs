//! Trials of a population: what is said of each, by a diagnosis and by baselines, beside what is true, and
//! two results over the same trials side by side.

mod answers;
mod comparison;
mod comparison_text;
mod dry_friction;
mod judged_cause;
mod judged_finding;
mod judgement;
mod kind_row;
mod measures;
mod merged_panel;
mod paired_mean;
mod paired_share;
mod panel_row;
mod panel_tally;
mod panel_text;
mod peak_memory;
mod prediction;
mod rate;
mod side;
mod slow_diagnosis;
mod stranger_row;
mod trial;
mod turned;

pub use answers::{Answers, Costs, HeldOut};
pub use comparison::Comparison;
pub use judged_cause::JudgedCause;
pub use judged_finding::{BaselineClaim, JudgedFinding};
pub use judgement::Judgement;
pub use kind_row::KindRow;
pub use measures::{Measure, Quantity};
pub use merged_panel::{MergedPanel, PANEL_SCHEMA};
pub use paired_mean::PairedMean;
pub use paired_share::PairedShare;
pub use panel_row::{Naming, PanelRow, Ratios};
pub use panel_tally::PanelTally;
pub use prediction::{Prediction, RelativeError};
pub use rate::{Fraction, Rate};
pub use side::Side;
pub use slow_diagnosis::SlowDiagnosis;
pub use stranger_row::StrangerRow;
pub(crate) use trial::run;
pub use turned::Turned;
