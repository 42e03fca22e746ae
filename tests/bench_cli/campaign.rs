//! A campaign of few and quick trials.

use std::fs;
use std::path::{Path, PathBuf};

use benchmark::{Costs, Record};

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

/// What a folder is merged into, but for what trials cost: the records, and the tally.
pub fn merged(folder: &Path, name: &str) -> (Vec<Record>, serde_json::Value) {
    done(folder, &["merge", name]);
    let records = without_costs(&folder.join(name).join("trials.parquet"));
    let tally = fs::read(folder.join(name).join("tally.json")).unwrap();
    let mut tally: serde_json::Value = serde_json::from_slice(&tally).unwrap();
    tally.as_object_mut().unwrap().remove("slowest").unwrap();
    for row in tally["rows"].as_array_mut().unwrap() {
        for cost in ["median_s", "nine_of_ten_s", "logs_s", "peak_memory_mb"] {
            row.as_object_mut().unwrap().remove(cost).unwrap();
        }
    }
    (records, tally)
}

/// The records of a table without times and memory, which no two runs share.
pub fn without_costs(table: &Path) -> Vec<Record> {
    let mut records = Record::read(table).unwrap();
    for judged in records.iter_mut().filter_map(|record| record.score.as_mut().ok()) {
        judged.costs = Costs::default();
    }
    records
}

pub fn shards(folder: &Path) -> Vec<PathBuf> {
    let Ok(entries) = fs::read_dir(folder.join("shards")) else { return Vec::new() };
    let mut paths: Vec<PathBuf> = entries.map(|entry| entry.unwrap().path()).collect();
    paths.retain(|path| path.extension().is_some_and(|e| e == "parquet"));
    paths.sort();
    paths
}
