//! Commands that write, and what they read.

use std::fs;
use std::path::Path;

use crate::arm;
use crate::campaign::{self, done, without_costs};

/// Commands that write below `out`, and a file of each whose [`content`] is always the same.
pub const COMMANDS: [(&str, &str); 2] = [
    ("work out --quiet", "shards/00003.parquet"),
    ("plan campaign.toml --out out", "campaign.toml"),
];

/// Commands that write below `out`, of which every call to the disk is refused, and those that take seconds.
pub const WALKED: [&str; 2] = [COMMANDS[0].0, COMMANDS[1].0];
pub const SLOW: [&str; 4] = [
    "merge out",
    "damage population.toml --kinds spikes --quiet --out out",
    "account out --quiet --store out/store",
    "times --robot arm.urdf --quiet --out out",
];

/// Further ones of which calls are refused.
pub const FURTHER: [&str; 4] =
    ["figure figure.toml --quiet --out out", "sheets out/store", "submit out --dry-run", EXPORT];

/// Writes a set of CauseBench with one trial.
pub const EXPORT: &str =
    "export --set smoke --first 1 --jobs 1 --quiet --out out/set --truth out/set.truth.json";

/// Those that refuse a folder in which they have been.
pub const ONCE: [&str; 1] = [EXPORT];

/// Kills of each of [`WALKED`] in the long round.
pub const KILLS: usize = 50;

/// One trial of a population.
const POPULATION: &str = "[population]\ntrials = 1\nseed = 5\narms = [\"hobby\"]\nlogs = [1, 1]\nlog_s = [5.0, 6.0]\n\
    longest_s = 6.0\n";

/// The first figure, of few points.
const FIGURE: &str =
    "[figure.prediction_time]\nrobot = \"arm.urdf\"\npoints = [100, 300]\nseed = 1\n";

/// A folder with what the commands read.
pub fn folder() -> tempfile::TempDir {
    let folder = campaign::folder();
    arm::write(folder.path(), "population.toml", POPULATION);
    arm::write(folder.path(), "figure.toml", FIGURE);
    folder
}

/// What a file holds; of a shard its records, without the times and the memory that no two runs share.
pub fn content(file: &Path) -> Vec<u8> {
    let is_of_trials =
        file.ends_with("trials.parquet") || file.parent().is_some_and(|p| p.ends_with("shards"));
    if is_of_trials && file.extension().is_some_and(|e| e == "parquet") {
        return format!("{:?}", without_costs(file)).into_bytes();
    }
    fs::read(file).unwrap()
}

/// Puts into `out` what a command needs to find there: a campaign for one that works on it, with its trials for one that
/// merges them or looks at them.
pub fn plan(folder: &Path, command: &str) {
    let word = command.split(' ').next();
    match word {
        Some("work" | "merge" | "submit") => {
            done(folder, &["plan", "campaign.toml", "--out", "out"]);
        }
        Some("account" | "sheets") => {
            done(folder, &["plan", "population.toml", "--out", "out"]);
            done(folder, &["work", "out", "--quiet", "--store", "out/store"]);
            fs::remove_dir(folder.join("out/work")).unwrap();
        }
        _ => {}
    }
    if word == Some("merge") {
        done(folder, &["work", "out", "--quiet"]);
    }
}
