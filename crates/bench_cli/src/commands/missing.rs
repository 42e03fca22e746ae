use std::path::PathBuf;

use benchmark::{KindCount, Manifest};
use cli::display_path;

/// Arguments of `status` and `merge`.
#[derive(Debug, clap::Args)]
pub struct Folder {
    /// The folder of a campaign that was planned
    #[arg(value_name = "DIR")]
    pub folder: PathBuf,
}

/// What is missing, in sentences.
pub fn missing(made: &Manifest, counts: &[KindCount]) -> Vec<String> {
    let broken = made.broken.iter().map(|broken| {
        format!("{}: it does not count, {}", display_path(&broken.path), broken.reason)
    });
    let left = counts.last().filter(|all| all.open() > 0).map(|all| {
        format!("{} of {} trials are left to make: plumbline-bench work", all.open(), all.trials())
    });
    broken.chain(left).collect()
}

/// Sentences on lines of their own, a blank one above.
pub fn sentences(all: &[String]) -> String {
    if all.is_empty() { String::new() } else { format!("\n{}\n", all.join("\n")) }
}
