//! The recording of a diagnosis against the logs that it shows.

use std::path::Path;
use std::sync::LazyLock;

use checks::arms::workspace_root;
use diagnosis::{DiagnosisRun, Settings, Silent};
use document::Document;
use experiment::{DiagnosedLogs, ExperimentError, record_diagnosis};
use logs::{PrepareSettings, Prepared, Run};
use recording::{Contents, RecordingError};
use robot::{Loaded, Robot};
use simulator::scenario::Scenario;

/// Two runs of the WAM with friction at the elbow that its description lacks.
const SCENARIO: &str = "\
extends = 'SCENARIOS/arms/wam.toml'
engine.step_ms = 0.5
effect = [{ coulomb_friction = { joint = 'j4_elbow_pitch', level_nm = 3.0 } }]
run = [{ name = 'first', motion.sinusoids = { seed = 1, terms = 3, lowest_hz = 0.15, highest_hz = 1.0, duration_s = 12.0 } },
       { name = 'second', motion.sinusoids = { seed = 2, terms = 3, lowest_hz = 0.15, highest_hz = 1.0, duration_s = 9.0 } }]
";

const ELBOW: &str = "j4_elbow_pitch";

/// What is recorded.
static CASE: LazyLock<Case> = LazyLock::new(Case::new);

struct Case {
    loaded: Loaded,
    runs: Vec<Run>,
    outcome: DiagnosisRun,
    prepared: Prepared,
}

impl Case {
    fn new() -> Self {
        let scenarios = workspace_root().join("scenarios");
        let text = SCENARIO.replace("SCENARIOS", scenarios.to_str().unwrap());
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("scenario.toml");
        std::fs::write(&path, text).unwrap();
        let document = Document::read(&path).unwrap();
        let scenario = Scenario::from_document(&document).unwrap();
        let runs = simulator::simulate(&scenario, &|| {}).unwrap().runs;
        let loaded = Robot::load(&workspace_root().join("robots/wam7/robot.toml")).unwrap();
        let settings = Settings { control_rate_hz: loaded.control.rate_hz, ..Settings::default() };
        let outcome = diagnosis::diagnose(&loaded.robot, &runs, &settings, &Silent).unwrap();
        let cutoff_hz = Some(outcome.diagnosis.data.cutoff_hz);
        let prepared = logs::prepare(&runs, &PrepareSettings { cutoff_hz }).unwrap();
        Self { loaded, runs, outcome, prepared }
    }

    fn record(&self, path: &Path) -> Result<recording::FinishedRecording, Box<ExperimentError>> {
        let Self { loaded, runs, outcome, .. } = self;
        let diagnosed = DiagnosedLogs { loaded, runs, outcome, verdict: "# Explained" };
        record_diagnosis(path, &diagnosed, &Silent).map_err(Box::new)
    }

    /// The recording as it is read back.
    fn contents(&self) -> Contents {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("recording.rrd");
        self.record(&path).unwrap();
        Contents::read(&path).unwrap()
    }
}

/// Root mean square of the numbers that are there.
fn rms(numbers: impl Iterator<Item = f64>) -> f64 {
    let known: Vec<f64> = numbers.filter(|x| x.is_finite()).collect();
    (known.iter().map(|x| x * x).sum::<f64>() / known.len() as f64).sqrt()
}

#[test]
fn the_recording_holds_both_runs_one_after_the_other() {
    let case = &*CASE;
    let contents = case.contents();
    assert!(contents.layouts > 0 && contents.layout_messages > 50);
    for arm in ["measured", "nominal", "extended"] {
        let root = format!("/world/arms/{arm}/");
        assert!(contents.entities.keys().any(|path| path.starts_with(&root)), "{arm}");
    }
    for entity in ["/world/paths/measured", "/verdict", "/events"] {
        assert!(contents.entities.contains_key(entity), "{entity}");
    }
    // Two runs begin, one cause is found at least.
    assert!(contents.entities["/events"].rows >= 3);

    let [first, second] = &case.prepared.runs[..] else { panic!("two runs were expected") };
    let length_s = |run: &logs::PreparedRun| run.time[run.time.len() - 1] - run.time[0];
    let elbow = &contents.entities[&format!("/joints/{ELBOW}")];
    assert!(elbow.times_ns.is_sorted_by(|a, b| a < b));
    // A pause of 1 s between them, a row of gaps half a second after the last.
    let last_s = 1e-9 * elbow.times_ns[elbow.times_ns.len() - 1] as f64;
    let expected_s = length_s(first) + 1.0 + length_s(second) + 0.5;
    assert!((last_s - expected_s).abs() < 0.021, "{last_s} s, {expected_s} s");

    // Every fifth sample of 500 Hz: the row at 3 s is sample 1500 of the log.
    assert_eq!(elbow.times_ns[300], 3_000_000_000);
    let (q, qd) = (first.joints[3].q[1500], first.joints[3].qd[1500]);
    assert_eq!(elbow.columns["position"][300][0].to_bits(), q.to_bits());
    assert_eq!(elbow.columns["velocity"][300][0].to_bits(), qd.to_bits());
    let gap = elbow.times_ns.windows(2).position(|w| w[1] - w[0] > 100_000_000).unwrap() + 1;
    assert!(elbow.columns["position"][gap].iter().all(|x| x.is_nan()));
    let begins = second.joints[3].q[0];
    assert_eq!(elbow.columns["position"][gap + 1][0].to_bits(), begins.to_bits());
}

#[test]
fn the_recording_shows_what_the_nominal_model_gets_wrong() {
    let case = &*CASE;
    let contents = case.contents();
    let elbow = &contents.entities[&format!("/joints/{ELBOW}")];
    // Friction of 3 N m, less where the low-pass rounds its steps; there it is hard to predict.
    let residual = |signal: usize| rms(elbow.columns["residual"].iter().map(|row| row[signal]));
    let [nominal, extended] = [residual(0), residual(1)];
    assert!((2.0..3.5).contains(&nominal), "{nominal} N m");
    assert!(extended < 0.25 * nominal, "{extended} N m of {nominal}");
    let rows = elbow.columns["torque"].iter().zip(&elbow.columns["residual"]);
    for (torque, residual) in rows.filter(|(torque, _)| torque[0].is_finite()) {
        assert!((torque[0] - torque[1] - residual[0]).abs() < 1e-12);
        assert!((torque[0] - torque[2] - residual[1]).abs() < 1e-12);
    }
    let off = |signal: usize| rms(elbow.columns["position"].iter().map(|row| row[signal] - row[0]));
    let [nominal, extended] = [off(1), off(2)];
    assert!(nominal > 0.02 && extended < 0.3 * nominal, "{nominal} and {extended} rad");
}

/// Twice the same numbers, once on one thread.
#[test]
fn the_recording_is_the_same_whatever_the_number_of_threads() {
    let case = &*CASE;
    let one = rayon::ThreadPoolBuilder::new().num_threads(1).build().unwrap();
    let [a, b] = [case.contents(), one.install(|| case.contents())];
    assert_eq!(format!("{:?}", a.entities), format!("{:?}", b.entities));
}

#[test]
fn a_model_that_cannot_be_simulated_is_recorded_without() {
    let mut case = Case::new();
    for i in 0..case.loaded.robot.joint_count() {
        let link = case.loaded.robot.link_mut(i).unwrap();
        link.inertia = robot::Inertia::zero();
        link.actuator.rotor_inertia = 0.0;
    }
    let contents = case.contents();
    let elbow = &contents.entities[&format!("/joints/{ELBOW}")];
    assert!(elbow.columns["position"].iter().all(|row| row[1].is_nan()));
    assert!(elbow.columns["position"].iter().any(|row| row[2].is_finite()));
    assert!(contents.entities["/events"].rows >= 5, "two warnings more");
}

#[test]
fn a_recording_that_cannot_be_written_is_an_error() {
    let error = CASE.record(Path::new("no/such/recording.rrd")).unwrap_err();
    let unwritable = |e: &RecordingError| matches!(e, RecordingError::Unwritable { .. });
    assert!(matches!(&*error, ExperimentError::Recording(e) if unwritable(e)), "{error}");
}
