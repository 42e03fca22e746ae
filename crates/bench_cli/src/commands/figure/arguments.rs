use std::path::PathBuf;

use cli::RunOutput;

/// Arguments of `figure`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The scenario of a figure (TOML)
    pub scenario: PathBuf,
    #[command(flatten)]
    pub output: RunOutput,
    /// Seed of every random draw of the arm with the real data, or of the made-up points
    #[arg(long, value_parser = clap::value_parser!(u64).range(0..=i64::MAX as u64))]
    pub seed: Option<u64>,
    /// A value instead of the scenario's, such as figure.learning.learn.points=300; may be given
    /// more than once
    #[arg(long, value_name = "KEY=VALUE")]
    pub set: Vec<String>,
}
