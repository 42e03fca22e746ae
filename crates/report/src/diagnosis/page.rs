use askama::Template;
use diagnosis::{DataSummary, Diagnosis, FoldGain, Verdict};

use crate::diagnosis::forward::{ForwardTable, drift_in_page, forward_table};
use crate::diagnosis::joint_charts::figures_of;
use crate::diagnosis::json::json;
use crate::diagnosis::places::{joint_anchor, joint_of};
use crate::diagnosis::report::Report;
use crate::diagnosis::residual::ResidualModel;
use crate::diagnosis::residual::{ResidualRow, residual_rows};
use crate::diagnosis::sentence::{bottom_line, verdict_sentence};
use crate::diagnosis::spectra::spectra;
use crate::diagnosis::tables::{
    Cause, JointRow, NegligibleRow, RuledOutRow, cause, class_of, joint_rows, name_beside_joint,
    negligible, ruled_out,
};
use pages::{
    Chart, Provenance, ReportError, escape_json, join_names, percent, render_html, render_page,
    significant,
};

/// `report.html`: one file that opens offline, and without scripts too.
///
/// # Errors
///
/// [`ReportError::Format`].
pub fn html(report: &Report) -> Result<String, ReportError> {
    let provenance = report.provenance.without_folders();
    render_page(&Page::new(&Report { provenance: &provenance, ..*report })?)
}

/// The sections of the page that say what was found, what is left, what every joint shows and what
/// was ruled out.
///
/// # Errors
///
/// [`ReportError::Format`].
pub(crate) fn sections_of(report: &Report) -> Result<String, ReportError> {
    let page = Page::new(report)?;
    render_html(&page.as_sections())
}

#[derive(Template)]
#[template(path = "diagnosis/report.html", blocks = ["sections"])]
struct Page<'a> {
    robot: &'a str,
    class: &'static str,
    sentence: String,
    bottom_line: String,
    warnings: &'a [String],
    joints: Vec<JointRow>,
    spectra: Vec<String>,
    folds: Vec<Fold<'a>>,
    forward: Option<ForwardTable>,
    drift: String,
    causes: Vec<Cause>,
    negligible: Vec<NegligibleRow>,
    figures: Vec<JointSection>,
    left: Vec<Left>,
    residual: Option<&'a ResidualModel>,
    residual_rows: Vec<ResidualRow>,
    ruled_out: Vec<(String, Vec<RuledOutRow>)>,
    descriptions: &'a [(exchange::Format, exchange::Export)],
    data: &'a DataSummary,
    held_out: &'a str,
    provenance: &'a Provenance,
    json: String,
}

/// The figures of one joint.
struct JointSection {
    name: String,
    anchor: String,
    verdict: &'static str,
    class: &'static str,
    /// The effects that were found at it, for which its figures are shown without a click.
    findings: Vec<String>,
    is_open: bool,
    time: Vec<Figure>,
    residual: Vec<Figure>,
}

/// A figure that is already drawn.
struct Figure {
    title: String,
    svg: String,
}

impl Figure {
    fn new(chart: Chart) -> Result<Self, ReportError> {
        Ok(Self { svg: chart.in_page()?, title: chart.title })
    }
}

/// The gain on one held-out part.
struct Fold<'a>(&'a FoldGain);

impl Fold<'_> {
    fn name(&self) -> &str {
        &self.0.name
    }

    /// Error before and after, joint by joint.
    fn errors(&self) -> Vec<(String, String)> {
        let pairs = self.0.rms_before_nm.iter().zip(&self.0.rms_after_nm);
        pairs.map(|(&before, &after)| (significant(before, 3), significant(after, 3))).collect()
    }
}

/// Structure left at a joint, as text.
struct Left {
    joint: String,
    share: String,
    depends_on: String,
}

impl<'a> Page<'a> {
    fn new(report: &Report<'a>) -> Result<Self, ReportError> {
        let diagnosis = report.diagnosis;
        Ok(Self {
            robot: &diagnosis.robot,
            class: class_of(diagnosis.verdict),
            sentence: verdict_sentence(diagnosis),
            bottom_line: bottom_line(report),
            warnings: &diagnosis.warnings,
            joints: joint_rows(report),
            spectra: spectra(report)?,
            folds: diagnosis.gain.inverse.folds.iter().map(Fold).collect(),
            forward: forward_table(report),
            drift: drift_in_page(report.forward)?,
            causes: diagnosis.findings.iter().map(|f| cause(report, f)).collect(),
            negligible: negligible(report),
            figures: sections(report)?,
            left: left(diagnosis),
            residual: report.residual,
            residual_rows: residual_rows(report),
            ruled_out: ruled_out(report),
            descriptions: report.descriptions,
            data: &diagnosis.data,
            held_out: &diagnosis.gain.inverse.held_out,
            provenance: report.provenance,
            json: escape_json(&json(report)?),
        })
    }
}

/// The joints with adequate data first.
fn sections(report: &Report) -> Result<Vec<JointSection>, ReportError> {
    let joints = report.diagnosis.joints.iter().enumerate();
    let (adequate, inadequate): (Vec<_>, Vec<_>) =
        joints.partition(|(_, joint)| joint.verdict != Verdict::DataInadequate);
    let sections = adequate.into_iter().chain(inadequate).map(|(i, joint)| {
        let figures = figures_of(report, i);
        let at_it = report.diagnosis.findings.iter().filter(|f| joint_of(report, &f.at) == Some(i));
        let findings: Vec<String> = at_it.map(|f| name_beside_joint(&f.at)).collect();
        Ok(JointSection {
            name: joint.name.clone(),
            anchor: joint_anchor(i),
            verdict: joint.verdict.words(),
            class: class_of(joint.verdict),
            is_open: !findings.is_empty(),
            findings,
            time: figures.time.into_iter().map(over_time).collect::<Result<_, _>>()?,
            residual: drawn(figures.residual)?,
        })
    });
    sections.collect()
}

/// Torque over time and what is left of it below, on one axis of time.
fn over_time([torque, left]: [Chart; 2]) -> Result<Figure, ReportError> {
    let title = torque.title.clone();
    Ok(Figure { svg: torque.in_page()? + &left.in_page()?, title })
}

fn drawn(charts: Vec<Chart>) -> Result<Vec<Figure>, ReportError> {
    charts.into_iter().map(Figure::new).collect()
}

fn left(diagnosis: &Diagnosis) -> Vec<Left> {
    let rows = diagnosis.unexplained.iter().map(|u| {
        let signals: Vec<String> = u
            .depends_on
            .iter()
            .map(|d| format!("{} (predicts {} of it)", d.signal, percent(d.share)))
            .collect();
        Left {
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

/// Filters of the template.
mod filters {
    use super::significant;

    /// Three significant digits.
    #[askama::filter_fn]
    pub fn short(value: &f64, _: &dyn askama::Values) -> askama::Result<String> {
        Ok(significant(*value, 3))
    }
}

#[cfg(test)]
mod tests {
    use crate::sample;

    #[test]
    fn the_page_is_self_contained_and_holds_the_answer() {
        let sample = sample::arm();
        let page = super::html(&sample.report()).unwrap();
        assert!(!page.contains("http://") && !page.contains("https://"));
        assert!(page.contains("default-src 'none'") && page.matches("<script>").count() == 1);
        for expected in [
            "Partly explained:",
            "<code>FR02</code> Coulomb friction",
            "<b>FR01 viscous friction at shoulder</b>",
            ">EN02 cable spring<",
            "2.00 N·m (1.80 to 2.20)",
            "0.020",
        ] {
            assert!(page.contains(expected), "{expected} is missing");
        }
        assert!(
            page.contains("&lt;at&gt;") || page.contains("&#60;at&#62;"),
            "evidence is not escaped"
        );
        assert_eq!(page.matches("<svg class=\"plot\"").count(), 2 * (3 + 2 * 3));
    }

    #[test]
    fn a_joint_that_the_log_does_not_show_is_grey_and_comes_last() {
        let mut sample = sample::arm();
        sample.diagnosis.joints[0].verdict = diagnosis::Verdict::DataInadequate;
        let page = super::html(&sample.report()).unwrap();
        assert!(page.contains(r#"<tr class="open"><th scope="row">shoulder"#));
        let sections: Vec<&str> = page.split(r#"<details class="joint""#).skip(1).collect();
        assert!(sections[0].contains("<summary id=\"joint-2\">elbow"));
        assert!(sections[1].contains("<summary id=\"joint-1\">shoulder"));
    }

    #[test]
    fn joints_with_findings_are_open_and_the_others_folded() {
        let mut sample = sample::arm();
        let open = |sample: &sample::Sample| -> Vec<bool> {
            let page = super::html(&sample.report()).unwrap();
            let sections = page.split(r#"<details class="joint""#).skip(1);
            sections.map(|section| section.starts_with(" open>")).collect()
        };
        assert_eq!(open(&sample), [true, true], "friction at one, the link of the other");
        sample.diagnosis.findings.remove(0);
        assert_eq!(open(&sample), [false, true]);
        sample.diagnosis.findings.clear();
        assert_eq!(open(&sample), [false, false]);
    }

    #[test]
    fn the_contents_lead_to_every_section_and_every_link_has_its_place() {
        let page = super::html(&sample::arm().report()).unwrap();
        let links: Vec<&str> =
            page.split("href=\"#").skip(1).filter_map(|link| link.split('"').next()).collect();
        assert!(links.contains(&"joint-by-joint") && links.contains(&"joint-1"), "{links:?}");
        for link in links {
            assert_eq!(page.matches(&format!("id=\"{link}\"")).count(), 1, "{link}");
        }
    }

    #[test]
    fn no_folder_of_the_machine_is_told() {
        let mut sample = sample::arm();
        sample.provenance.files[0].path = "/home/me/x/../arm.urdf".into();
        sample.provenance.command.push("/home/me/x/../arm.urdf".into());
        let page = super::html(&sample.report()).unwrap();
        assert!(page.contains(">arm.urdf<") && !page.contains("/home"));
    }

    #[test]
    fn the_residual_model_has_a_table_where_there_is_one() {
        let sample = sample::arm();
        let without = super::html(&sample.report()).unwrap();
        assert!(!without.contains("residual model"));
        let residual = sample::residual();
        let report =
            crate::diagnosis::report::Report { residual: Some(&residual), ..sample.report() };
        let page = super::html(&report).unwrap();
        for expected in [
            "<p>Of what is left a Gaussian process predicts 59 % at elbow",
            "<code>models/named-gp.parquet</code>",
            "position of elbow (21 % of its range)",
            "<li>one thing to know</li>",
        ] {
            assert!(page.contains(expected), "{expected} is missing");
        }
    }

    #[test]
    fn spectra_and_what_is_negligible_are_shown_where_there_are_some() {
        let mut sample = sample::arm();
        let without = super::html(&sample.report()).unwrap();
        assert!(!without.contains("over frequency</summary>") && !without.contains("negligible<"));
        let spectrum = &mut sample.diagnosis.joints[1].spectrum;
        spectrum.hz = vec![0.1, 1.0];
        (spectrum.left_nm2_per_hz, spectrum.noise_nm2_per_hz) = (vec![1.0; 2], vec![0.1; 2]);
        sample.diagnosis.negligible = vec![diagnosis::Negligible {
            at: sample.diagnosis.findings[1].at.clone(),
            most_at: "elbow".into(),
            rms_nm: 0.0123,
            least_nm: 0.05,
        }];
        let page = super::html(&sample.report()).unwrap();
        assert_eq!(page.matches("<svg").count(), without.matches("<svg").count() + 1);
        for expected in [
            "What is left beside the noise, over frequency</summary>",
            r#"aria-label="elbow: what is left 1.0 to 1.0 (N·m)²/Hz, noise 0.10 to 0.10"#,
            "IN02 inertial parameters</th><td>of link elbow_link</td><td>elbow</td>",
            r#"<td class="n">0.012 N·m</td><td class="n">0.050 N·m</td>"#,
        ] {
            assert!(page.contains(expected), "{expected} is missing");
        }
    }

    #[test]
    fn the_extended_robot_can_be_copied_with_what_its_format_leaves_out() {
        let sample = sample::arm();
        assert!(!super::html(&sample.report()).unwrap().contains("with what was found"));
        let text = "<robot name=\"arm\"/>".to_owned();
        let export = exchange::Export { text, fates: Vec::new(), robot: sample.robot.clone() };
        let descriptions = [(exchange::Format::Urdf, export)];
        let report =
            crate::diagnosis::report::Report { descriptions: &descriptions, ..sample.report() };
        let page = super::html(&report).unwrap();
        assert!(page.contains("<summary>URDF <small>extended.urdf</small></summary>"), "{page}");
        assert!(page.contains("<pre>&#60;robot name=&#34;arm&#34;/&#62;</pre>"));
    }

    #[test]
    fn a_name_cannot_end_the_embedded_json() {
        let mut sample = sample::arm();
        sample.diagnosis.robot = "</script><img>".into();
        let page = super::html(&sample.report()).unwrap();
        assert_eq!(page.matches("</script>").count(), 2);
        assert!(!page.contains("<img>"));
    }

    #[test]
    fn the_same_input_gives_the_same_bytes() {
        let (a, b) = (sample::arm(), sample::arm());
        assert!(super::html(&a.report()).unwrap() == super::html(&b.report()).unwrap());
    }
}
