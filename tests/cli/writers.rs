//! Commands that write, and what they read.

use std::path::Path;

use crate::arm::{self, Gap};

/// Commands that write below `out`, and a file of each whose [`content`] is always the same.
pub const COMMANDS: [(&str, &str); 9] = [
    ("diagnose --robot arm.urdf --log run_0.csv run_1.csv --out out", "diagnosis.json"),
    (
        "compare --robot arm.urdf --before run_0.csv --after run_1.csv --out out",
        "after/diagnosis.json",
    ),
    (
        "replay --robot arm.urdf --log run_0.csv --window-ms 200 --out out",
        "run_0_forward_200ms.parquet",
    ),
    (
        "learn --robot arm.urdf --train run_0.csv --test run_1.csv --models rbd,gp --points 150 --out out",
        "models/rbd.parquet",
    ),
    ("simulate scenario.toml --out out", "waves.parquet"),
    (
        "design --robot arm.urdf --separate FR02@elbow --from FR04@elbow --duration-s 5 --out out",
        "motion.csv",
    ),
    ("track tracking.toml --out out", "logs/rbd.parquet"),
    ("run runs.toml --seed 1 --out out", "metrics.json"),
    ("demo --out out", "metrics.json"),
];

/// Commands that write below `out`, of which every call to the disk is refused, and those that take seconds.
pub const WALKED: [&str; 12] = [
    COMMANDS[0].0,
    COMMANDS[1].0,
    COMMANDS[2].0,
    COMMANDS[3].0,
    COMMANDS[4].0,
    COMMANDS[5].0,
    COMMANDS[6].0,
    COMMANDS[7].0,
    "run tracking.toml --out out",
    "export arm.toml --out out",
    "robot init arm.urdf --force --out out",
    "man --out out",
];
pub const SLOW: [&str; 2] = [
    "diagnose --robot arm.urdf --log run_0.csv --no-recording --residual gp --out out",
    COMMANDS[8].0,
];

/// Commands that are walked beside these: of `plumbline` there are none.
pub const FURTHER: [&str; 0] = [];

/// Those that refuse a folder in which they have been.
pub const ONCE: [&str; 0] = [];

/// Kills of each of [`WALKED`] in the long round.
pub const KILLS: usize = 75;

/// Samples of its logs: eight seconds.
const ROWS: usize = 1600;

/// What a file holds.
pub fn content(file: &Path) -> Vec<u8> {
    std::fs::read(file).unwrap()
}

/// The arm of the campaign, with gains that a motion is tracked with.
const SOFT: &str = r#"urdf = "arm.urdf"
joint.shoulder = { rotor_inertia_kg_m2 = 0.1, kp_nm_per_rad = 400.0, kd_nm_s_per_rad = 20.0 }
joint.elbow = { rotor_inertia_kg_m2 = 0.1, kp_nm_per_rad = 200.0, kd_nm_s_per_rad = 10.0 }

[gains.soft]
kp_nm_per_rad = [100.0, 50.0]
kd_nm_s_per_rad = [10.0, 5.0]
"#;

/// A scenario of two runs: one is diagnosed, the other tells what that gains.
const RUNS: &str = r#"robot = "soft.toml"
engine.step_ms = 0.5
sensors.effort_noise_nm = { shoulder = 0.1, elbow = 0.1 }
effect = [{ viscous_friction = { joint = "elbow", viscous_nm_s_per_rad = 3.0 } }]

[[run]]
name = "first"
motion.sinusoids = { seed = 1, terms = 3, lowest_hz = 0.2, highest_hz = 1, duration_s = 6 }

[[run]]
name = "last"
motion.sinusoids = { seed = 2, terms = 3, lowest_hz = 0.2, highest_hz = 1, duration_s = 4, fade_s = 0.5 }
"#;

/// The first of them is learned from.
const TRACKING: &str = r#"plant = "runs.toml"
motion.sinusoids = { seed = 3, terms = 3, lowest_hz = 0.3, highest_hz = 1, duration_s = 2, fade_s = 0.5 }
feedforward = ["none", "rbd"]
control.gains = "soft"
learn.train = ["first"]
"#;

/// The arm without gains that a motion is tracked with.
const ROBOT: &str = "urdf = \"arm.urdf\"\n\
    joint.shoulder = { rotor_inertia_kg_m2 = 0.1, kp_nm_per_rad = 400.0, kd_nm_s_per_rad = 20.0 }\n\
    joint.elbow = { rotor_inertia_kg_m2 = 0.1, kp_nm_per_rad = 200.0, kd_nm_s_per_rad = 10.0 }\n";

/// Its scenario.
const SCENARIO: &str = "robot = \"arm.toml\"\nengine.step_ms = 0.5\n\
    sensors.effort_noise_nm = { shoulder = 0.1, elbow = 0.1 }\n\n[[run]]\nname = \"waves\"\n\
    motion.sinusoids = { seed = 1, terms = 3, lowest_hz = 0.2, highest_hz = 1, duration_s = 6 }\n";

/// A folder with what the commands read.
pub fn folder() -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    arm::write(path, "arm.urdf", arm::URDF);
    arm::write(path, "arm.toml", ROBOT);
    arm::write(path, "scenario.toml", SCENARIO);
    for number in 0..2 {
        let log = arm::log(number, Gap::Friction(1.5));
        let rows: String = log.split_inclusive('\n').take(1 + ROWS).collect();
        arm::write(path, &format!("run_{number}.csv"), &rows);
    }
    arm::write(path, "soft.toml", SOFT);
    arm::write(path, "runs.toml", RUNS);
    arm::write(path, "tracking.toml", TRACKING);
    folder
}

/// Puts into `out` what a command needs to find there: nothing.
pub fn plan(_: &Path, _: &str) {}
