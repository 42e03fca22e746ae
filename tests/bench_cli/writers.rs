//! Commands that write, and what they read.

use std::fs;
use std::path::Path;

use crate::campaign::{done, without_costs};

pub use crate::campaign::folder;

/// Commands that write below `out`, and a file of each whose [`content`] is always the same.
pub const COMMANDS: [(&str, &str); 2] = [
    ("work out --quiet", "shards/00003.parquet"),
    ("plan campaign.toml --out out", "campaign.toml"),
];

/// Commands that write below `out`, of which every call to the disk is refused, and those that take seconds.
pub const WALKED: [&str; 2] = [COMMANDS[0].0, COMMANDS[1].0];
pub const SLOW: [&str; 1] = ["merge out"];

/// Kills of each of [`WALKED`] in the long round.
pub const KILLS: usize = 50;

/// What a file holds; of a shard its records, without the times and the memory that no two runs share.
pub fn content(file: &Path) -> Vec<u8> {
    if file.extension().is_some_and(|e| e == "parquet") {
        return format!("{:?}", without_costs(file)).into_bytes();
    }
    fs::read(file).unwrap()
}

/// Puts into `out` what a command needs to find there: a campaign for one that works on it, with its trials for one that
/// merges them.
pub fn plan(folder: &Path, command: &str) {
    if !command.starts_with("plan") {
        done(folder, &["plan", "campaign.toml", "--out", "out"]);
    }
    if command.starts_with("merge") {
        done(folder, &["work", "out", "--quiet"]);
    }
}
