//! Commands that write, and what they read.

use std::path::Path;

use crate::campaign::done;

pub use crate::campaign::folder;

/// Commands that write below `out`, and a file of each that is always the same.
pub const COMMANDS: [(&str, &str); 2] = [
    // Shards hold the times of a diagnosis, which no two runs have in common.
    ("work out --quiet", "campaign.toml"),
    ("plan campaign.toml --out out", "campaign.toml"),
];

/// Puts into `out` what a command needs to find there: a campaign, for one that works on it.
pub fn plan(folder: &Path, command: &str) {
    if command.starts_with("work") {
        done(folder, &["plan", "campaign.toml", "--out", "out"]);
    }
}
