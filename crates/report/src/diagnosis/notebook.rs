use askama::Template;

use crate::diagnosis::report::Report;
use crate::diagnosis::sentence::{bottom_line, verdict_sentence};
use crate::diagnosis::tables::{Cause, JointRow, cause, joint_rows};
use pages::{ReportError, render_html};

/// The first screen of the report for the cell of a notebook: the verdict, the error of every joint
/// before and after, and the findings. It brings no style sheet, so that it looks as the notebook does.
///
/// # Errors
///
/// [`ReportError::Format`].
pub fn notebook(report: &Report) -> Result<String, ReportError> {
    let diagnosis = report.diagnosis;
    render_html(&Cell {
        sentence: verdict_sentence(diagnosis),
        bottom_line: bottom_line(report),
        warnings: &diagnosis.warnings,
        joints: joint_rows(report),
        causes: diagnosis.findings.iter().map(|finding| cause(report, finding)).collect(),
    })
}

#[derive(Template)]
#[template(path = "diagnosis/notebook.html")]
struct Cell<'a> {
    sentence: String,
    bottom_line: String,
    warnings: &'a [String],
    joints: Vec<JointRow>,
    causes: Vec<Cause>,
}

#[cfg(test)]
mod tests {
    use crate::sample;

    #[test]
    fn the_cell_holds_verdict_joints_and_findings_and_nothing_that_is_fetched() {
        let sample = sample::arm();
        let cell = super::notebook(&sample.report()).unwrap();
        for expected in
            ["Partly explained:", "shoulder", "FR02 Coulomb friction", "2.00 N·m (1.80 to 2.20)"]
        {
            assert!(cell.contains(expected), "{expected} is missing in\n{cell}");
        }
        assert!(!cell.contains("http") && !cell.contains("<script") && !cell.contains("<style"));
    }
}
