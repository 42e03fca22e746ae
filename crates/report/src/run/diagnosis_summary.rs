use serde::{Deserialize, Serialize};

use crate::diagnosis::page::found_sections;
use crate::diagnosis::report::Report;
use crate::diagnosis::sentence::{bottom_line, verdict_sentence};
use crate::diagnosis::tables::{class_of, known_floor};
use pages::ReportError;

/// A diagnosis as the report of a run tells it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DiagnosisSummary {
    /// The verdict in a sentence.
    pub sentence: String,
    /// What the extended model buys on data held out of the diagnosis, in a sentence.
    pub bottom_line: String,
    /// Class of the verdict in the style sheet.
    pub class: String,
    /// Doubts about the logs.
    pub warnings: Vec<String>,
    /// Motions that would tell the findings from their rivals.
    pub motions: Vec<String>,
    /// RMS of the noise joint by joint (N m or N), where the logs tell it.
    #[serde(default)]
    pub noise_floor_nm: Vec<Option<f64>>,
    /// Findings, what is left, figures joint by joint and what was ruled out, as HTML.
    pub sections: String,
}

/// What the report of a run tells of a diagnosis.
///
/// # Errors
///
/// [`ReportError::Format`].
pub fn summarise(report: &Report) -> Result<DiagnosisSummary, ReportError> {
    let diagnosis = report.diagnosis;
    let motions = diagnosis.findings.iter().filter_map(|f| f.told_apart_by);
    let mut motions: Vec<String> = motions.map(str::to_owned).collect();
    motions.sort_unstable();
    motions.dedup();
    Ok(DiagnosisSummary {
        sentence: verdict_sentence(diagnosis),
        bottom_line: bottom_line(report),
        class: class_of(diagnosis.verdict).to_owned(),
        warnings: diagnosis.warnings.clone(),
        motions,
        noise_floor_nm: diagnosis.joints.iter().map(known_floor).collect(),
        sections: found_sections(report)?,
    })
}
