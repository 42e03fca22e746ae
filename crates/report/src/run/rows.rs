use experiment::{ForwardWindow, Metrics, PredictionGain};

use crate::diagnosis::forward::drifts;
use crate::run::run_report::THOUSANDTHS;
use pages::significant;

/// Length of time after which the page shows the drift joint by joint (s).
pub(crate) const TOLD_S: f64 = 0.2;

/// A number before and after, and how many times less it is.
pub(crate) struct GainRow {
    /// What it is.
    pub what: String,
    pub before: String,
    pub after: String,
    pub times: String,
}

/// What finding the effects gains, over all joints.
pub(crate) fn gain_rows(metrics: &Metrics) -> Vec<GainRow> {
    let mut rows = vec![gain_row(
        "torque error, RMS over all joints".to_owned(),
        PredictionGain::of_torque(&metrics.torque),
        "N·m",
        1.0,
    )];
    for ForwardWindow { window_s, .. } in &metrics.forward.windows {
        let what = format!("drift of the simulated tip in {:.0} ms", 1e3 * window_s);
        rows.push(gain_row(
            what,
            PredictionGain::of_drift(&metrics.forward, *window_s),
            "mm",
            THOUSANDTHS,
        ));
    }
    let what = format!("tracking error of the tip, gains {}", metrics.gains);
    rows.push(gain_row(what, PredictionGain::of_tracking(&metrics.tracking), "mm", THOUSANDTHS));
    rows
}

fn gain_row(what: String, gain: Option<PredictionGain>, unit: &str, scale: f64) -> GainRow {
    let with_unit = |value: f64| format!("{} {unit}", significant(scale * value, 3));
    let Some(gain) = gain else {
        return GainRow { what, before: "-".into(), after: "-".into(), times: "-".into() };
    };
    let times = format!("{}x", significant(gain.times(), 2));
    GainRow { what, before: with_unit(gain.before), after: with_unit(gain.after), times }
}

/// The numbers of one joint, of the robot as described and of the extended one.
pub(crate) struct JointNumbers {
    /// Mean square of the torque error over the variance of the torque.
    pub nmse: [f64; 2],
    /// RMS error of the torque (N m or N).
    pub torque: [f64; 2],
    /// Drift after [`TOLD_S`] (mrad or mm).
    pub drift: [f64; 2],
    /// RMS error of the tracking (mrad or mm).
    pub tracking: [f64; 2],
}

/// The numbers of all joints; what was not measured is not a number.
pub(crate) fn joint_numbers(metrics: &Metrics) -> Vec<JointNumbers> {
    const MODELS: [&str; 2] = ["cad", "named"];
    let at = |values: Option<&[f64]>, joint: usize| {
        values.and_then(|values| values.get(joint)).copied().unwrap_or(f64::NAN)
    };
    let window = metrics.forward.windows.iter().find(|w| (w.window_s - TOLD_S).abs() < 1e-9);
    let numbers = |joint: usize| JointNumbers {
        nmse: MODELS.map(|name| {
            let model = metrics.torque.iter().find(|model| model.model == name);
            model.and_then(|model| *model.nmse.get(joint)?).unwrap_or(f64::NAN)
        }),
        torque: MODELS.map(|name| {
            let model = metrics.torque.iter().find(|model| model.model == name);
            at(model.map(|model| model.rms_nm.as_slice()), joint)
        }),
        drift: [0, 1]
            .map(|of| THOUSANDTHS * at(window.and_then(|w| drifts(w)[of].rms.as_deref()), joint)),
        tracking: MODELS.map(|name| {
            let run = metrics.tracking.iter().find(|run| run.model == name);
            THOUSANDTHS * at(run.and_then(|run| run.rms.as_deref()), joint)
        }),
    };
    (0..metrics.joints.len()).map(numbers).collect()
}
