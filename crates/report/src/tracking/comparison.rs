use schemars::{JsonSchema, Schema};
use serde::Serialize;

use crate::learning::comparison::ComparedJoint;
use pages::{Provenance, ReportError, column_extremes, with_schema, written_schema};

/// Name and version of the schema of `tracking.json`.
const SCHEMA: &str = "plumbline.tracking/1";

/// One motion followed with several feedforwards and the same feedback.
///
/// ```text
/// u = u_FF(q_ref, qd_ref, qdd_ref) + Kp error + Kd error_rate
/// ```
///
/// Every list by joint has the order of `joints`. Errors and gains of a slide
/// are in m and N in the place of rad and N m.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct TrackingComparison {
    /// Name of the robot.
    pub robot: String,
    /// The joints.
    pub joints: Vec<ComparedJoint>,
    /// What was to be followed, in words.
    pub motion: String,
    /// The gains of the feedback.
    pub gains: ControllerGains,
    /// What the time of a prediction was, in words.
    pub clock: String,
    /// How long the motion is (s).
    pub duration_s: f64,
    /// The runs, in the order of tables and figures.
    pub models: Vec<TrackedModel>,
    /// The errors at other gains, if they were asked for.
    pub sweep: Option<ErrorSweep>,
    /// What to know before trusting the numbers.
    pub warnings: Vec<String>,
    /// Where it all comes from.
    pub provenance: Provenance,
}

/// The gains of the feedback.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ControllerGains {
    /// Name of the set.
    pub name: String,
    /// Effort per error, by joint (N m/rad).
    pub kp: Vec<f64>,
    /// Effort per rate of the error, by joint (N m s/rad).
    pub kd: Vec<f64>,
}

/// The run with one feedforward.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct TrackedModel {
    /// Its short name, such as `gp-rbd`.
    pub name: String,
    /// What it is, in a few words.
    pub words: String,
    /// Root of the mean square error over the run, by joint (rad).
    pub rmse_rad: Vec<f64>,
    /// The same over the first ten seconds (rad).
    pub rmse_first_10_s_rad: Vec<f64>,
    /// The largest error, by joint (rad).
    pub max_error_rad: Vec<f64>,
    /// Root of the mean square distance of the end effector from where it should be (m).
    pub tip_rmse_m: Option<f64>,
    /// Largest distance of the end effector from where it should be (m).
    pub tip_max_m: Option<f64>,
    /// Root of the mean square error of the links behind the transmissions (rad), where they
    /// are seen.
    pub link_rmse_rad: Option<Vec<f64>>,
    /// Root of the mean square effort, by joint (N m).
    pub effort_rms_nm: Vec<f64>,
    /// Root of the mean square effort of the feedback, by joint (N m).
    pub feedback_rms_nm: Vec<f64>,
    /// Largest change of the feedforward from one sample to the next, by joint (N m).
    pub largest_jump_nm: Vec<f64>,
    /// Time that one prediction takes, for all joints (us).
    pub prediction_us: f64,
    /// Why the run ended early; none for a complete run.
    pub stopped: Option<String>,
    /// What happened on the way, in sentences.
    pub events: Vec<String>,
    /// How punctual the control loop was; none where time was simulated.
    pub timing: Option<WallTiming>,
    /// The motion at its beginning. Not in the JSON: the log of the run holds it.
    #[serde(skip)]
    pub first_seconds: FirstSeconds,
}

/// How well a control loop kept its time.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, JsonSchema)]
pub struct WallTiming {
    /// Samples of the control loop.
    pub ticks: usize,
    /// Samples that began more than one period late.
    pub missed_deadlines: usize,
    /// How late the latest of them began (us).
    pub worst_late_us: f64,
    /// Samples that found no newer prediction.
    pub missed_updates: usize,
    /// From a request to its prediction, 99 in 100 (us).
    pub latency_99_us: f64,
    /// From a request to its prediction, the longest (us).
    pub latency_max_us: f64,
}

/// The beginning of a motion, thinned to the points that its drawing needs.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct FirstSeconds {
    /// Time (s) and desired position (rad), by joint.
    pub desired: Vec<Vec<[f64; 2]>>,
    /// Time (s) and measured position (rad), by joint.
    pub measured: Vec<Vec<[f64; 2]>>,
    /// Time (s) and measured minus desired position (rad), by joint.
    pub error: Vec<Vec<[f64; 2]>>,
}

/// The errors at several gains.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct ErrorSweep {
    /// Name of the set of gains that was scaled.
    pub gains: String,
    /// How much of the motion was followed (s).
    pub duration_s: f64,
    /// `Kp` over that of the set, rising; `Kd` goes with its square root.
    pub scales: Vec<f64>,
    /// The errors of each feedforward.
    pub models: Vec<SweptFeedforward>,
}

/// The errors of one feedforward at several gains.
#[derive(Debug, Clone, PartialEq, Serialize, JsonSchema)]
pub struct SweptFeedforward {
    /// The name of the model.
    pub name: String,
    /// Root of the mean square error by joint, for each of the scales (rad).
    pub rmse_rad: Vec<Vec<f64>>,
}

/// Length of what [`FirstSeconds`] holds (s).
const FIRST_SECONDS: f64 = 10.0;

/// Pixel columns that its curves are drawn on at most.
const COLUMNS: usize = 400;

impl FirstSeconds {
    /// The first ten seconds of signals, one a joint, sampled at rising times (s).
    pub fn of(time_s: &[f64], desired: &[&[f64]], measured: &[&[f64]]) -> Self {
        let end = time_s.first().map_or(0.0, |start| start + FIRST_SECONDS);
        let drawn = |signals: &[&[f64]]| {
            let points = |signal: &&[f64]| {
                let pairs = time_s.iter().zip(signal.iter()).take_while(|(t, _)| **t <= end);
                column_extremes(&pairs.map(|(&t, &x)| [t, x]).collect::<Vec<_>>(), COLUMNS)
            };
            signals.iter().map(points).collect()
        };
        let error = |(measured, desired): (&&[f64], &&[f64])| -> Vec<f64> {
            measured.iter().zip(desired.iter()).map(|(q, desired)| q - desired).collect()
        };
        let errors: Vec<Vec<f64>> = measured.iter().zip(desired).map(error).collect();
        let errors: Vec<&[f64]> = errors.iter().map(Vec::as_slice).collect();
        Self { desired: drawn(desired), measured: drawn(measured), error: drawn(&errors) }
    }
}

impl TrackingComparison {
    /// The JSON schema of the file.
    pub fn schema() -> Schema {
        written_schema::<Self>(SCHEMA, "Plumbline tracking")
    }

    /// `tracking.json`, in the schema `plumbline.tracking/1`. A number that is not finite is
    /// `null`.
    ///
    /// # Errors
    ///
    /// [`ReportError::Format`].
    pub fn json(&self) -> Result<String, ReportError> {
        with_schema(SCHEMA, self)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tracking::sample;

    #[test]
    fn the_json_holds_every_number_but_not_the_signals() {
        let text = sample::comparison().json().unwrap();
        let value: serde_json::Value = serde_json::from_str(&text).unwrap();
        assert_eq!(value["schema"], "plumbline.tracking/1");
        assert_eq!(value["joints"][1]["effort_unit"], "N");
        let rigid = &value["models"][1];
        assert_eq!(rigid["rmse_rad"][0], 0.02);
        assert!(rigid["timing"].is_null() && rigid.get("first_seconds").is_none());
        assert!(value["models"][0]["rmse_rad"][1].is_null(), "not a number");
        assert_eq!(value["sweep"]["models"][0]["rmse_rad"][2][0], 0.02);
    }

    #[test]
    fn the_first_seconds_end_after_ten_and_keep_a_jump() {
        let time: Vec<f64> = (0..30_000).map(|k| 5.0 + 0.002 * f64::from(k)).collect();
        let mut signal = vec![0.0; time.len()];
        signal[1234] = 1.0;
        let first = FirstSeconds::of(&time, &[&signal], &[&signal[..1], &[]]);
        let desired = &first.desired[0];
        assert!(desired.len() <= 2 * COLUMNS && desired.contains(&[time[1234], 1.0]));
        assert!(desired.last().is_some_and(|end| (14.9..=15.0).contains(&end[0])));
        assert_eq!(first.measured, [vec![[5.0, 0.0]], vec![]]);
        let late: Vec<f64> = signal.iter().map(|q| q - 0.25).collect();
        let error = FirstSeconds::of(&time, &[&signal], &[&late]).error;
        assert!(
            !error[0].is_empty() && error[0].iter().all(|[_, error]| (error + 0.25).abs() < 1e-12)
        );
        assert_eq!(FirstSeconds::of(&[], &[&[]], &[]).desired, [Vec::<[f64; 2]>::new()]);
    }
}
