use robot::JointKind;

use crate::scenario::tracking_scenario::TrackingScenario;
use crate::tracking::tracked_run::TrackedRun;

/// The results of a run, as Markdown for the recording.
pub(crate) fn words(scenario: &TrackingScenario, run: &TrackedRun) -> String {
    let robot = scenario.robot();
    let tip = run.metrics.end_effector_of_links.unwrap_or(run.metrics.end_effector);
    let mut text = format!(
        "# {}\n\n{}, gains `{}`\n\nEnd effector: **{:.2} mm** RMS off, {:.2} mm at most.\n\n\
         | joint | RMSE | first 10 s | largest | feedback |\n|---|---:|---:|---:|---:|\n",
        run.kind.name(),
        run.kind.words(),
        scenario.gains_name(),
        1e3 * tip.rms_m,
        1e3 * tip.max_m,
    );
    for (link, joint) in robot.links().iter().zip(&run.metrics.joints) {
        text.push_str(&format!(
            "| {} | {:.2} | {:.2} | {:.1} | {:.0} % |\n",
            link.joint.name,
            1e3 * joint.rmse,
            1e3 * joint.rmse_first_10_s,
            1e3 * joint.max_error,
            100.0 * joint.feedback_share,
        ));
    }
    let slides = robot.links().iter().any(|link| link.joint.kind == JointKind::Prismatic);
    let unit = if slides { "mrad, of slides mm" } else { "mrad" };
    text.push_str(&format!(
        "\nErrors in {unit}; feedback as a share of the RMS torque. One prediction takes {:.1} µs.\n",
        1e6 * run.prediction_time_s
    ));
    for event in &run.tracking.events {
        text.push_str(&format!("- {:.2} s: {}\n", event.time_s, event.words));
    }
    text
}
