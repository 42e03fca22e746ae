use askama::Template;
use diagnosis::{Comparison, Estimate, Finding};

use crate::diagnosis::json::json;
use crate::diagnosis::report::Report;
use crate::diagnosis::tables::{Cause, cause, class_of, sizes};
use pages::{Provenance, ReportError, escape_json, render_page};

#[derive(Template)]
#[template(path = "change/change.html")]
struct Page<'a> {
    robot: &'a str,
    class: &'static str,
    sentence: String,
    warnings: Vec<&'a String>,
    causes: Vec<Cause>,
    /// The changes with their size in the first logs.
    first: Vec<[String; 2]>,
    /// What is no change, each with what it is.
    unchanged: Vec<(&'static str, Vec<[String; 2]>)>,
    sides: [Side; 2],
    provenance: &'a Provenance,
    json: String,
}

/// The diagnosis of one set of logs, a page of its own.
struct Side {
    name: &'static str,
    words: &'static str,
    class: &'static str,
    verdict: &'static str,
}

/// `report.html` of a comparison: what changed from the first logs to the others, with its size in
/// both, and what is wrong in both; in one file that opens offline, and without scripts too.
///
/// `after` is the report of [`Comparison::after`], about the robot that the first logs extend.
///
/// # Errors
///
/// [`ReportError::Format`].
pub fn change_page(comparison: &Comparison, after: &Report) -> Result<String, ReportError> {
    let provenance = after.provenance.without_folders();
    let report = Report { provenance: &provenance, input: None, ..*after };
    let [before, changed] = [&comparison.before, &comparison.after].map(|side| &side.diagnosis);
    let side = |name, words, of: &diagnosis::Diagnosis| Side {
        name,
        words,
        class: class_of(of.verdict),
        verdict: of.verdict.words(),
    };
    render_page(&Page {
        robot: &changed.robot,
        class: if changed.findings.is_empty() { "good" } else { "part" },
        sentence: change_sentence(comparison),
        warnings: before.warnings.iter().chain(&changed.warnings).collect(),
        causes: changed
            .findings
            .iter()
            .map(|finding| without_link(cause(&report, finding)))
            .collect(),
        first: changed.findings.iter().filter_map(|finding| first(comparison, finding)).collect(),
        unchanged: unchanged_findings(comparison),
        sides: [
            side("before", "what the first logs say of the robot", before),
            side("after", "what the others say of the robot as the first found it", changed),
        ],
        provenance: &provenance,
        json: escape_json(&json(&report)?),
    })
}

/// What changed, in a sentence.
pub fn change_sentence(comparison: &Comparison) -> String {
    let changed = &comparison.after.diagnosis;
    match changed.findings.len() {
        0 => format!("Nothing that these logs could show has changed in {}", changed.robot),
        1 => format!("Changed: 1 named effect of {}", changed.robot),
        n => format!("Changed: {n} named effects of {}", changed.robot),
    }
}

/// Findings that are no change: oscillations of both logs, and what the first show.
fn unchanged_findings(comparison: &Comparison) -> Vec<(&'static str, Vec<[String; 2]>)> {
    let rows = |findings: &[Finding]| findings.iter().map(row).collect::<Vec<_>>();
    let alike =
        ("Oscillations of the same amplitude before, and so no change", rows(&comparison.alike));
    let held = rows(&comparison.before.diagnosis.findings);
    let held = ("Found before, and held where nothing above is said of it", held);
    [alike, held].into_iter().filter(|(_, rows)| !rows.is_empty()).collect()
}

/// A finding and its sizes.
fn row(finding: &Finding) -> [String; 2] {
    [finding.at.words(), sizes(finding).join("; ")]
}

/// A change and its size in the first logs, where they tell it.
fn first(comparison: &Comparison, finding: &Finding) -> Option<[String; 2]> {
    Some([finding.at.words(), sizes_before(comparison, finding)?.join("; ")])
}

/// The sizes of a changed effect in the first logs alone, where these determine them.
pub fn sizes_before(comparison: &Comparison, finding: &Finding) -> Option<Vec<String>> {
    let size = comparison.first.iter().find(|size| size.at == finding.at)?;
    // It was what these logs say: there is nothing before them.
    let alone = |p: &Estimate| Estimate { nominal: 0.0, ..p.clone() };
    let parameters = size.parameters.iter().map(alone).collect();
    Some(sizes(&Finding { parameters, ..finding.clone() }))
}

/// A finding on a page that has no figures of its joint.
fn without_link(cause: Cause) -> Cause {
    Cause { anchor: None, ..cause }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;

    #[test]
    fn the_page_tells_the_changes_and_leads_to_both_diagnoses() {
        let sample = sample::arm();
        let outcome = diagnosis::DiagnosisRun {
            diagnosis: sample.diagnosis.clone(),
            traces: Vec::new(),
            extended: sample.robot.clone(),
            read: None,
            prepared: logs::Prepared {
                runs: Vec::new(),
                cutoff_hz: 10.0,
                cutoff_reason: String::new(),
                motion_hz: 1.0,
                noise: Vec::new(),
                warnings: Vec::new(),
            },
            held_out: Vec::new(),
        };
        let mut comparison = Comparison {
            before: outcome.clone(),
            after: outcome,
            first: Vec::new(),
            alike: Vec::new(),
        };
        comparison.before.diagnosis.findings.truncate(1);
        let page = change_page(&comparison, &sample.report()).unwrap();
        for expected in [
            "Changed: 2 named effects of arm",
            "href=\"before/report.html\"",
            "<code>FR02</code> Coulomb friction",
            "Found before, and held",
        ] {
            assert!(page.contains(expected), "{expected} is missing");
        }
        assert!(!page.contains("href=\"#joint"), "no figures to lead to");
        comparison.after.diagnosis.findings.clear();
        let page = change_page(&comparison, &sample.report()).unwrap();
        assert!(page.contains("Nothing that these logs could show has changed"));
    }
}
