use crate::diagnosis::places::JointUnits;
use crate::diagnosis::report::Report;
use crate::diagnosis::sentence::{bottom_line, verdict_sentence};
use crate::diagnosis::tables::sizes;
use pages::{percent, significant};

/// The verdict as Markdown, short enough to stand beside a moving picture: the verdict, what it
/// buys, the held-out errors of the joints and the causes with their sizes.
pub fn markdown(report: &Report) -> String {
    let diagnosis = report.diagnosis;
    let mut text = format!("**{}.**\n\n{}.\n\n", verdict_sentence(diagnosis), bottom_line(report));
    text.push_str("| joint | error | verdict |\n|---|---:|---|\n");
    let gain = &diagnosis.gain.inverse;
    let at = |values: &[f64], j: usize| significant(values.get(j).copied().unwrap_or(f64::NAN), 3);
    for (j, joint) in diagnosis.joints.iter().enumerate() {
        let (before, after) = (at(&gain.rms_before_nm, j), at(&gain.rms_after_nm, j));
        let unit = JointUnits::of(report.robot, &joint.name).effort;
        let verdict = joint.verdict.words();
        text.push_str(&format!("| {} | {before} → {after} {unit} | {verdict} |\n", joint.name));
    }
    text.push('\n');
    for finding in &diagnosis.findings {
        let share = percent(finding.share_explained);
        let sizes = sizes(finding).join("; ");
        let sizes = if sizes.is_empty() { sizes } else { format!(": {sizes}") };
        text.push_str(&format!("- **{}**{sizes} ({share} of the gap)\n", finding.at.words()));
    }
    text
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;

    #[test]
    fn the_markdown_has_the_verdict_the_causes_and_a_row_a_joint() {
        let sample = sample::arm();
        let text = markdown(&sample.report());
        assert!(text.starts_with("**Partly explained: 2 named effects found"), "{text}");
        assert!(text.contains("\n- **FR02 Coulomb friction at shoulder**: "), "{text}");
        let rows: Vec<&str> = text.lines().filter(|line| line.starts_with("| ")).collect();
        assert_eq!(rows.len(), 3, "{text}");
        assert!(rows[2].starts_with("| elbow | ") && rows[2].ends_with("| partly explained |"));
    }
}
