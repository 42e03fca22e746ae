use experiment::{Drift, ForwardGap, ForwardWindow};

use crate::numbers::significant;
use crate::{Axis, Chart, Report, ReportError, Series, Shape};
use colours::Role;

/// How far both simulations drift in some lengths of time, as text.
pub(crate) struct ForwardTable {
    /// The lengths of time.
    pub windows: Vec<String>,
    /// A row a joint and one of the tip: drift before and after, by length of time.
    pub rows: Vec<(String, Vec<[String; 2]>)>,
    /// What was left out, in sentences.
    pub remarks: Vec<String>,
}

/// The drift of a report, where it was measured.
pub(crate) fn forward_table(report: &Report) -> Option<ForwardTable> {
    let ForwardGap { windows } = report.forward?;
    let cells = |of: &dyn Fn(&Drift) -> f64| -> Vec<[String; 2]> {
        let told = |drift: &Drift| significant(of(drift), 3);
        windows.iter().map(|w| drifts(w).map(told)).collect()
    };
    let joints = report.robot.links().iter().enumerate().map(|(j, link)| {
        let unit = if link.joint.kind.is_rotation() { "rad" } else { "m" };
        let at = |drift: &Drift| drift.rms.as_ref().and_then(|rms| rms.get(j).copied());
        let name = format!("{} ({unit})", link.joint.name);
        (name, cells(&|drift| at(drift).unwrap_or(f64::NAN)))
    });
    let tip = cells(&|drift| drift.tip_rms_m.map_or(f64::NAN, |m| 1e3 * m));
    Some(ForwardTable {
        windows: windows.iter().map(|w| format!("{:.0} ms", 1e3 * w.window_s)).collect(),
        rows: joints.chain([("tip (mm)".to_owned(), tip)]).collect(),
        remarks: remarks(windows),
    })
}

/// How far the tip drifts in 200 ms, in a sentence.
pub(crate) fn forward_sentence(report: &Report) -> Option<String> {
    let window = report.forward?.windows.iter().find(|w| (w.window_s - 0.2).abs() < 1e-9)?;
    let [nominal, extended] = drifts(window).map(|drift| drift.tip_rms_m);
    let [nominal, extended] = [nominal?, extended?].map(|m| significant(1e3 * m, 3));
    Some(format!(
        "Moved by the measured torque for 200 ms, the tip of the simulation ends {nominal} mm RMS \
         off, that of the extended one {extended} mm"
    ))
}

/// The drifts of a window: of the robot as described, and of the extended one.
pub(crate) fn drifts(window: &ForwardWindow) -> [&Drift; 2] {
    [&window.nominal, &window.extended]
}

/// How the drift of the tip grows over the longest length of time that both simulations came
/// through; none where there is no such.
pub(crate) fn drift_chart(gap: &ForwardGap) -> Option<Chart> {
    let both = |w: &&ForwardWindow| drifts(w).iter().all(|drift| !drift.tip_course_m.is_empty());
    let window = gap.windows.iter().rfind(both)?;
    let line = |(role, drift): (Role, &Drift)| {
        let course = &drift.tip_course_m;
        let step_ms = 1e3 * window.window_s / course.len() as f64;
        let grown = course.iter().enumerate().map(|(k, m)| [step_ms * (k + 1) as f64, 1e3 * m]);
        let points = std::iter::once([0.0, 0.0]).chain(grown).collect();
        Series::of(role, Shape::Line(points))
    };
    let roles = [Role::Nominal, Role::Extended].into_iter().zip(drifts(window));
    Some(Chart {
        title: "Drift of the simulated tip".to_owned(),
        x: Axis::from_zero("time since the measured state", "ms"),
        y: Axis::from_zero("drift of the tip, RMS", "mm"),
        series: roles.map(line).collect(),
        floor: None,
        size: (720.0, 180.0),
    })
}

/// The drift of the tip for a page; empty where there is nothing to draw.
///
/// # Errors
///
/// [`ReportError::Format`].
pub(crate) fn drift_in_page(gap: Option<&ForwardGap>) -> Result<String, ReportError> {
    gap.and_then(drift_chart).map_or_else(|| Ok(String::new()), |chart| chart.in_page())
}

/// What was left out of the drifts, in sentences.
pub(crate) fn remarks(windows: &[ForwardWindow]) -> Vec<String> {
    let told = windows.iter().filter_map(|window| {
        let [nominal, extended] = drifts(window).map(|drift| drift.runaways);
        (nominal + extended > 0).then(|| {
            format!(
                "In {nominal} of {} windows of {:.0} ms a joint of the nominal simulation ran \
                 away, of the extended one in {extended}; they are left out of the drift",
                window.windows,
                1e3 * window.window_s,
            )
        })
    });
    let mut all: Vec<String> = told.collect();
    for (of, name) in ["nominal", "extended"].into_iter().enumerate() {
        let mut troubles = windows.iter().filter_map(|w| drifts(w)[of].trouble.as_ref());
        let told = troubles.next().map(|why| format!("The {name} robot is not simulated: {why}"));
        all.extend(told);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;

    /// One length of time, of which two windows in five ran away with the nominal simulation.
    fn gap() -> ForwardGap {
        let nominal = Drift {
            rms: Some(vec![0.1, 0.02]),
            tip_rms_m: Some(0.05),
            tip_course_m: vec![0.02, 0.05],
            runaways: 2,
            trouble: None,
        };
        let extended = Drift {
            rms: Some(vec![0.01, 0.002]),
            tip_rms_m: Some(0.004),
            tip_course_m: vec![0.003, 0.004],
            runaways: 0,
            trouble: Some("a reason".into()),
        };
        ForwardGap { windows: vec![ForwardWindow { window_s: 0.2, windows: 5, nominal, extended }] }
    }

    #[test]
    fn the_drift_is_told_by_joint_and_at_the_tip_and_what_ran_away_is_said() {
        let (sample, gap) = (sample::arm(), gap());
        let report = Report { forward: Some(&gap), ..sample.report() };
        let table = forward_table(&report).unwrap();
        assert_eq!(table.windows, ["200 ms"]);
        assert_eq!(
            table.rows[0],
            ("shoulder (rad)".into(), vec![["0.100".into(), "0.0100".into()]])
        );
        assert_eq!(table.rows[2], ("tip (mm)".into(), vec![["50.0".into(), "4.00".into()]]));
        assert_eq!(
            table.remarks[0],
            "In 2 of 5 windows of 200 ms a joint of the nominal simulation ran away, of the extended \
             one in 0; they are left out of the drift"
        );
        assert_eq!(table.remarks[1], "The extended robot is not simulated: a reason");
        let page = crate::html(&report).unwrap();
        assert!(page.contains("How far the simulation drifts") && page.contains("50.0"));
        assert!(crate::text(&report).contains("50.0 mm RMS"));
        let json: serde_json::Value = serde_json::from_str(&crate::json(&report).unwrap()).unwrap();
        assert_eq!(json["gain"]["forward"]["windows"][0]["extended"]["tip_rms_m"], 0.004);
    }

    #[test]
    fn what_was_not_simulated_is_not_told() {
        let sample = sample::arm();
        assert!(forward_table(&sample.report()).is_none());
        assert!(!crate::html(&sample.report()).unwrap().contains("How far the simulation drifts"));
        let gap = ForwardGap {
            windows: vec![ForwardWindow {
                window_s: 0.2,
                windows: 0,
                nominal: Drift::default(),
                extended: Drift::default(),
            }],
        };
        let report = Report { forward: Some(&gap), ..sample.report() };
        assert_eq!(forward_table(&report).unwrap().rows[0].1, [["-".to_owned(), "-".to_owned()]]);
        assert!(forward_sentence(&report).is_none());
    }

    #[test]
    fn the_drift_over_time_starts_at_nothing_and_ends_at_that_of_the_table() {
        let mut gap = gap();
        let chart = drift_chart(&gap).unwrap();
        let lines: Vec<&Shape> = chart.series.iter().map(|series| &series.shape).collect();
        let nominal = Shape::Line(vec![[0.0, 0.0], [100.0, 20.0], [200.0, 50.0]]);
        let extended = Shape::Line(vec![[0.0, 0.0], [100.0, 3.0], [200.0, 4.0]]);
        assert_eq!(lines, [&nominal, &extended]);
        gap.windows[0].extended.tip_course_m.clear();
        assert!(drift_chart(&gap).is_none());
    }
}
