use evaluation::{Drift, ForwardGap, ForwardWindow};

use crate::diagnosis::report::Report;
use colours::Role;
use pages::{Axis, Chart, CurveShape, ReportError, Series, significant};

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
        Series::of(role, CurveShape::Line(points))
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
    let lost = windows.iter().filter_map(|window| {
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
    let mut all: Vec<String> = lost.collect();
    for (of, name) in ["nominal", "extended"].into_iter().enumerate() {
        let mut troubles = windows.iter().filter_map(|w| drifts(w)[of].trouble.as_ref());
        let refused =
            troubles.next().map(|why| format!("The {name} robot is not simulated: {why}"));
        all.extend(refused);
    }
    all
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::sample;

    #[test]
    fn the_drift_over_time_starts_at_nothing_and_ends_at_that_of_the_table() {
        let mut gap = sample::forward_gap();
        let chart = drift_chart(&gap).unwrap();
        let lines: Vec<&CurveShape> = chart.series.iter().map(|series| &series.shape).collect();
        let nominal = CurveShape::Line(vec![[0.0, 0.0], [100.0, 20.0], [200.0, 50.0]]);
        let extended = CurveShape::Line(vec![[0.0, 0.0], [100.0, 3.0], [200.0, 4.0]]);
        assert_eq!(lines, [&nominal, &extended]);
        gap.windows[0].extended.tip_course_m.clear();
        assert!(drift_chart(&gap).is_none());
    }
}
