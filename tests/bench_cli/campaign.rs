//! A campaign of few and quick trials.

use std::fs;
use std::path::{Path, PathBuf};

use crate::arm;
use crate::program::{Answer, run};

const ROBOT: &str = "urdf = \"arm.urdf\"\n\
    joint.shoulder = { rotor_inertia_kg_m2 = 0.1, kp_nm_per_rad = 400.0, kd_nm_s_per_rad = 20.0 }\n\
    joint.elbow = { rotor_inertia_kg_m2 = 0.1, kp_nm_per_rad = 200.0, kd_nm_s_per_rad = 10.0 }\n";

/// The scenario of its arm.
pub const SCENARIO: &str = "robot = \"arm.toml\"\nengine.step_ms = 0.5\n\
    sensors.effort_noise_nm = { shoulder = 0.1, elbow = 0.1 }\n\n[[run]]\nname = \"waves\"\n\
    motion.sinusoids = { seed = 1, terms = 3, lowest_hz = 0.2, highest_hz = 1, duration_s = 6 }\n";

/// Six trials.
pub const CAMPAIGN: &str = r#"scenario = "scenario.toml"
hidden = ["clean", "FR02", "payload+rotor_inertia"]
seeds = 2
seed = 7
settings = ["hidden.torque_share=[0.2, 0.3]"]
"#;

/// A folder with an arm of two joints and a campaign of six trials of it, a quarter of a second each.
pub fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    arm::write(path, "arm.urdf", arm::URDF);
    arm::write(path, "arm.toml", ROBOT);
    arm::write(path, "scenario.toml", SCENARIO);
    arm::write(path, "campaign.toml", CAMPAIGN);
    folder
}

pub fn trials(folder: &Path, arguments: &[&str]) -> Answer {
    run(folder, arguments)
}

/// With exit code 0 and nothing on the standard error.
pub fn done(folder: &Path, arguments: &[&str]) -> String {
    let answer = trials(folder, arguments);
    assert_eq!((answer.code, answer.err.as_str()), (0, ""), "{arguments:?}: {}", answer.out);
    answer.out
}

/// The tables and files that a folder is merged into.
pub fn merged(folder: &Path, name: &str) -> (String, Vec<Vec<u8>>) {
    let text = done(folder, &["merge", name]);
    let text = text.split("\nreport ").next().unwrap().to_owned();
    let files = ["trials.parquet", "tally.json", "report.html"];
    (text, files.map(|file| fs::read(folder.join(name).join(file)).unwrap()).to_vec())
}

pub fn shards(folder: &Path) -> Vec<PathBuf> {
    let Ok(entries) = fs::read_dir(folder.join("shards")) else { return Vec::new() };
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|e| e == "parquet"));
    paths.sort();
    paths
}
