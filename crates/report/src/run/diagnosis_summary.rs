use serde::{Deserialize, Serialize};

use crate::diagnosis::page::found_sections;
use crate::diagnosis::report::Report;
use crate::diagnosis::sentence::{bottom_line, verdict_sentence};
use crate::diagnosis::tables::class_of;
use pages::ReportError;

/// A diagnosis as the report of a run shows it.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct DiagnosisSummary {
    /// The verdict in a sentence.
    pub sentence: String,
    /// The gain of the extended model on held-out data, in a sentence.
    pub bottom_line: String,
    /// Class of the verdict in the style sheet.
    pub class: String,
    /// Doubts about the logs.
    pub warnings: Vec<String>,
    /// Motions that would separate the findings from their rivals.
    pub motions: Vec<String>,
    /// The sections of the diagnosis page that the page of a run shows, as HTML.
    pub sections: String,
}

/// The parts of a diagnosis that the report of a run shows.
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
        sections: found_sections(report)?,
    })
}
