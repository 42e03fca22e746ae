use askama::Template;
use pages::{Provenance, ReportError, escape_json, render_page};

use crate::diagnosis::json::json;
use crate::diagnosis::report::Report;
use crate::diagnosis::sections::section::draw_all;
use crate::diagnosis::sections::{CLOSING, FOUND, OPENING};
use crate::diagnosis::sentence::{bottom_line, verdict_sentence};
use crate::diagnosis::tables::class_of;

/// `report.html`: one file that opens offline, and without scripts too.
///
/// # Errors
///
/// [`ReportError::Format`].
pub fn html(report: &Report) -> Result<String, ReportError> {
    let provenance = report.provenance.without_folders();
    render_page(&Page::new(&Report { provenance: &provenance, input: None, ..*report })?)
}

/// The sections of the page that the page of a run shows as well.
///
/// # Errors
///
/// [`ReportError::Format`].
pub(crate) fn found_sections(report: &Report) -> Result<String, ReportError> {
    Ok(format!("\n{}\n", draw_all(FOUND, report)?.join("\n\n")))
}

/// What stands about the sections.
#[derive(Template)]
#[template(path = "diagnosis/report.html")]
struct Page<'a> {
    robot: &'a str,
    class: &'static str,
    sentence: String,
    bottom_line: String,
    warnings: &'a [String],
    opening: String,
    found: String,
    closing: String,
    provenance: &'a Provenance,
    json: String,
}

impl<'a> Page<'a> {
    fn new(report: &Report<'a>) -> Result<Self, ReportError> {
        let diagnosis = report.diagnosis;
        let opening = draw_all(OPENING, report)?;
        Ok(Self {
            robot: &diagnosis.robot,
            class: class_of(diagnosis.verdict),
            sentence: verdict_sentence(diagnosis),
            bottom_line: bottom_line(report),
            warnings: &diagnosis.warnings,
            opening: opening.iter().map(|section| format!("{section}\n\n")).collect(),
            found: found_sections(report)?,
            closing: draw_all(CLOSING, report)?.join("\n\n"),
            provenance: report.provenance,
            json: escape_json(&json(report)?),
        })
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
    fn what_has_no_name_stands_under_a_heading_of_its_own() {
        let mut sample = sample::arm();
        assert!(!super::html(&sample.report()).unwrap().contains("Fitted without a name"));
        sample.diagnosis.also_fitted = Some(sample::also_fitted());
        let page = super::html(&sample.report()).unwrap();
        let section = page.split("Fitted without a name</h2>").nth(1).unwrap();
        let section = section.split("</section>").next().unwrap();
        for expected in [
            "at joint shoulder",
            "IN03 rotor inertia",
            ">0.0700<",
            ">0.0500<",
            "0.500 N·m",
            "0.400 N·m",
            "kg·m²",
        ] {
            assert!(section.contains(expected), "{expected} is missing in {section}");
        }
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
        let open = |sample: &sample::DiagnosisSample| -> Vec<bool> {
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
