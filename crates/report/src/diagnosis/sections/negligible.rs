use askama::Template;
use diagnosis::Negligible;
use pages::{ReportError, significant};

use crate::diagnosis::places::JointUnits;
use crate::diagnosis::report::Report;
use crate::diagnosis::sections::section::Section;
use crate::diagnosis::tables::place_of;

/// Effects that the log shows and that do not matter.
#[derive(Template)]
#[template(path = "diagnosis/sections/negligible.html")]
pub(crate) struct NegligibleEffects {
    rows: Vec<NegligibleRow>,
}

impl<'a> Section<'a> for NegligibleEffects {
    fn new(report: &Report<'a>) -> Result<Option<Self>, ReportError> {
        let row = |seen: &Negligible| {
            let effort = JointUnits::of(report.robot, &seen.most_at).effort;
            NegligibleRow {
                effect: seen.at.effect.label(),
                place: place_of(&seen.at),
                joint: seen.most_at.clone(),
                size: format!("{} {effort}", significant(seen.rms_nm, 2)),
                least: format!("{} {effort}", significant(seen.least_nm, 2)),
            }
        };
        let rows: Vec<NegligibleRow> = report.diagnosis.negligible.iter().map(row).collect();
        Ok((!rows.is_empty()).then_some(Self { rows }))
    }
}

/// An effect that is seen and does not matter, as text.
struct NegligibleRow {
    effect: String,
    place: String,
    /// The joint at which it matters most, with its size there and the size that would matter.
    joint: String,
    size: String,
    least: String,
}
