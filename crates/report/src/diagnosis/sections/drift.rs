use askama::Template;
use experiment::{Drift, ForwardGap};
use pages::{ReportError, significant};

use crate::diagnosis::forward::{drift_in_page, drifts, remarks};
use crate::diagnosis::report::Report;
use crate::diagnosis::sections::section::Section;

/// How far simulations drift from the logs, where that was measured.
#[derive(Template)]
#[template(path = "diagnosis/sections/drift.html")]
pub(crate) struct SimulationDrift {
    /// The lengths of time.
    windows: Vec<String>,
    /// A row a joint and one of the tip: drift before and after, by length of time.
    rows: Vec<(String, Vec<[String; 2]>)>,
    /// What was left out, in sentences.
    remarks: Vec<String>,
    /// How the drift of the tip grows, as SVG; empty where there is nothing to draw.
    course: String,
}

impl<'a> Section<'a> for SimulationDrift {
    fn new(report: &Report<'a>) -> Result<Option<Self>, ReportError> {
        let Some(ForwardGap { windows }) = report.forward else { return Ok(None) };
        let cells = |of: &dyn Fn(&Drift) -> f64| -> Vec<[String; 2]> {
            let number = |drift: &Drift| significant(of(drift), 3);
            windows.iter().map(|w| drifts(w).map(number)).collect()
        };
        let joints = report.robot.links().iter().enumerate().map(|(j, link)| {
            let unit = if link.joint.kind.is_rotation() { "mrad" } else { "mm" };
            let at = |drift: &Drift| drift.rms.as_ref().and_then(|rms| rms.get(j).copied());
            let name = format!("{} ({unit})", link.joint.name);
            (name, cells(&|drift| 1e3 * at(drift).unwrap_or(f64::NAN)))
        });
        let tip = cells(&|drift| drift.tip_rms_m.map_or(f64::NAN, |m| 1e3 * m));
        Ok(Some(Self {
            windows: windows.iter().map(|w| format!("{:.0} ms", 1e3 * w.window_s)).collect(),
            rows: joints.chain([("tip (mm)".to_owned(), tip)]).collect(),
            remarks: remarks(windows),
            course: drift_in_page(report.forward)?,
        }))
    }
}

#[cfg(test)]
mod tests {
    use experiment::ForwardWindow;

    use super::*;
    use crate::diagnosis::forward::forward_sentence;
    use crate::sample;

    #[test]
    fn the_drift_is_told_by_joint_and_at_the_tip_and_what_ran_away_is_said() {
        let (sample, gap) = (sample::arm(), sample::forward_gap());
        let report = Report { forward: Some(&gap), ..sample.report() };
        let table = SimulationDrift::new(&report).unwrap().unwrap();
        assert_eq!(table.windows, ["200 ms"]);
        assert_eq!(table.rows[0], ("shoulder (mrad)".into(), vec![["100".into(), "10.0".into()]]));
        assert_eq!(table.rows[2], ("tip (mm)".into(), vec![["50.0".into(), "4.00".into()]]));
        assert_eq!(
            table.remarks[0],
            "In 2 of 5 windows of 200 ms a joint of the nominal simulation ran away, of the extended \
             one in 0; they are left out of the drift"
        );
        assert_eq!(table.remarks[1], "The extended robot is not simulated: a reason");
        let page = crate::diagnosis::page::html(&report).unwrap();
        assert!(page.contains("How far the simulation drifts") && page.contains("50.0"));
        assert!(crate::diagnosis::text::text(&report).contains("50.0 mm RMS"));
        let json: serde_json::Value =
            serde_json::from_str(&crate::diagnosis::json::json(&report).unwrap()).unwrap();
        assert_eq!(json["gain"]["forward"]["windows"][0]["extended"]["tip_rms_m"], 0.004);
    }

    #[test]
    fn what_was_not_simulated_is_not_told() {
        let sample = sample::arm();
        assert!(SimulationDrift::new(&sample.report()).unwrap().is_none());
        assert!(
            !crate::diagnosis::page::html(&sample.report())
                .unwrap()
                .contains("How far the simulation drifts")
        );
        let gap = ForwardGap {
            windows: vec![ForwardWindow {
                window_s: 0.2,
                windows: 0,
                nominal: Drift::default(),
                extended: Drift::default(),
            }],
        };
        let report = Report { forward: Some(&gap), ..sample.report() };
        assert_eq!(
            SimulationDrift::new(&report).unwrap().unwrap().rows[0].1,
            [["-".to_owned(), "-".to_owned()]]
        );
        assert!(forward_sentence(&report).is_none());
    }
}
