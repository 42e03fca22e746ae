//! A bench for tracking: scenarios in a folder of their own, from the text of a test.

use std::path::PathBuf;

use checks::arms::workspace_root;
use document::Document;
use experiment::{
    FeedforwardKind, Learned, TrackedRun, TrackingScenario, simulated_logs, track_all,
};
use learner::SilentTraining;
use tempfile::TempDir;

/// The arm with friction, stiction and backlash, stepped less often than usual to save time.
pub const REAL: &str = "extends = \"SCENARIOS/arms/real_wam.toml\"\nengine.step_ms = 0.25\n";

/// The arm as it is described, through the sensors of a real one.
pub const PERFECT: &str = "extends = \"SCENARIOS/arms/wam.toml\"\n";

/// A run to learn from, of a seed and as large as `share` of the limits allows.
pub fn run(name: &str, seed: u64, share: f64) -> String {
    format!("[[run]]\nname = \"{name}\"\n{}\n", motion("motion.sinusoids", seed, share, 20.0))
}

/// A motion of a seed, as large as `share` of the limits allows.
pub fn motion(key: &str, seed: u64, share: f64, seconds: f64) -> String {
    format!(
        "{key} = {{ seed = {seed}, terms = 3, lowest_hz = 0.15, highest_hz = 1.0, \
         duration_s = {seconds:?}, position_share = {share:?}, velocity_share = {share:?} }}"
    )
}

/// An arm and what is tracked with it.
pub struct Bench {
    _folder: TempDir,
    pub scenario: TrackingScenario,
}

impl Bench {
    /// Reads the two scenarios; `SCENARIOS` in them is the folder of the workspace's own.
    pub fn new(plant: &str, tracking: &str) -> Self {
        let folder = tempfile::tempdir().unwrap();
        let own = workspace_root().join("scenarios");
        let write = |name: &str, text: &str| -> PathBuf {
            let path = folder.path().join(name);
            std::fs::write(&path, text.replace("SCENARIOS", own.to_str().unwrap())).unwrap();
            path
        };
        write("plant.toml", plant);
        let tracking = write("tracking.toml", &format!("plant = \"plant.toml\"\n{tracking}"));
        let document = Document::read(&tracking).unwrap();
        let scenario = match TrackingScenario::from_document(&document) {
            Ok(scenario) => scenario,
            Err(error) => panic!("{error}"),
        };
        Self { _folder: folder, scenario }
    }

    /// Learns from the arm's logs what the scenario asks for.
    pub fn learn(&self) -> Learned {
        let logs = simulated_logs(&self.scenario, &SilentTraining).unwrap();
        Learned::learn(&self.scenario, &logs, None, &SilentTraining).unwrap()
    }

    /// Tracks with everything that the scenario feeds forward.
    pub fn track(&self, learned: &Learned) -> Vec<TrackedRun> {
        let runs = track_all(&self.scenario, learned, None, &SilentTraining).unwrap();
        for run in &runs {
            assert_eq!(run.tracking.end, tracking::End::Complete, "{}", run.kind);
        }
        runs
    }
}

/// Root mean square errors of a run, joint by joint (rad).
pub fn errors(runs: &[TrackedRun], name: &str) -> Vec<f64> {
    let kind: FeedforwardKind = name.parse().unwrap();
    let run = runs.iter().find(|run| run.kind == kind).unwrap();
    run.metrics.joints.iter().map(|joint| joint.rmse).collect()
}

/// A table of all errors (mrad), for whoever reads the output of a test.
pub fn print(runs: &[TrackedRun]) {
    for run in runs {
        let errors = run.metrics.joints.iter().map(|joint| format!("{:8.2}", 1e3 * joint.rmse));
        println!("{:14}{} mrad", run.kind.name(), errors.collect::<String>());
    }
}
