use askama::Template;
use diagnosis::Diagnosis;
use pages::{ReportError, join_names, percent, significant};

use crate::diagnosis::places::JointUnits;
use crate::diagnosis::report::Report;
use crate::diagnosis::residual::{ResidualJointRow, ResidualModel};
use crate::diagnosis::sections::section::Section;

/// What the findings leave without a name.
#[derive(Template)]
#[template(path = "diagnosis/sections/unexplained.html")]
pub(crate) struct UnexplainedStructure<'a> {
    rows: Vec<UnexplainedRow>,
    residual: Option<&'a ResidualModel>,
    residual_rows: Vec<ResidualRow>,
}

impl<'a> Section<'a> for UnexplainedStructure<'a> {
    fn new(report: &Report<'a>) -> Result<Option<Self>, ReportError> {
        Ok(Some(Self {
            rows: unexplained_rows(report.diagnosis),
            residual: report.residual,
            residual_rows: residual_rows(report),
        }))
    }
}

/// Structure left at a joint, as text.
struct UnexplainedRow {
    joint: String,
    share: String,
    depends_on: String,
}

fn unexplained_rows(diagnosis: &Diagnosis) -> Vec<UnexplainedRow> {
    let rows = diagnosis.unexplained.iter().map(|u| {
        let signals: Vec<String> = u
            .depends_on
            .iter()
            .map(|d| format!("{} (predicts {} of it)", d.signal, percent(d.share)))
            .collect();
        UnexplainedRow {
            joint: u.joint.clone(),
            share: percent(u.share),
            depends_on: if signals.is_empty() {
                "none of the signals in the log".to_owned()
            } else {
                join_names(&signals)
            },
        }
    });
    rows.collect()
}

/// What the residual model is worth at a joint, as text.
struct ResidualRow {
    name: String,
    unit: &'static str,
    extended: String,
    with_residual: String,
    share: String,
    better_in: String,
    is_used: bool,
    bends_with: String,
}

fn residual_rows(report: &Report) -> Vec<ResidualRow> {
    let Some(residual) = report.residual else { return Vec::new() };
    let row = |joint: &ResidualJointRow| ResidualRow {
        name: joint.name.clone(),
        unit: JointUnits::of(report.robot, &joint.name).effort,
        extended: significant(joint.extended_rms_nm, 3),
        with_residual: significant(joint.with_residual_rms_nm, 3),
        share: percent(joint.share),
        better_in: format!("{} of {}", joint.better_in, residual.parts),
        is_used: joint.is_used,
        bends_with: joint.bends_with(),
    };
    residual.joints.iter().map(row).collect()
}
