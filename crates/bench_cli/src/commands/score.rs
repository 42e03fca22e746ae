use std::path::PathBuf;

use benchmark::BenchScores;
use cli::{print, print_json};

use crate::commands::missing::sentences;
use crate::error::BenchError;
use crate::exit_status::BenchExitStatus;

/// Arguments of `score`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The folder of a set that was exported
    #[arg(value_name = "DIR")]
    folder: PathBuf,
    /// A folder with an answer a trial, TRIAL.json, and what they name; its name is that of the entrant
    answers: PathBuf,
    /// The truth of the set
    #[arg(long, value_name = "FILE")]
    truth: PathBuf,
    /// Drifts of the models that are handed in, of tests/benches/replay_answers.py
    #[arg(long, value_name = "FILE")]
    replay: Option<PathBuf>,
    /// The program that answered, with its version, for the page
    #[arg(long, value_name = "WORDS")]
    program: Option<String>,
    /// Print JSON instead of tables
    #[arg(long)]
    json: bool,
}

/// Scores the answers to a set. An answer that is missing or cannot be used counts as nothing said, and is a gap.
pub fn run(arguments: &Arguments) -> Result<BenchExitStatus, BenchError> {
    let mut scores = BenchScores::new(
        &arguments.folder,
        &arguments.answers,
        &arguments.truth,
        arguments.replay.as_deref(),
    )?;
    scores.program = arguments.program.clone();
    if arguments.json {
        print_json(&scores)?;
    } else {
        let told: Vec<String> = match scores.faults.len() {
            0 => Vec::new(),
            count => {
                let title = format!("{count} count as nothing said:");
                std::iter::once(title).chain(scores.faults.iter().cloned()).collect()
            }
        };
        print(&format!("{}{}", scores.text(), sentences(&told)))?;
    }
    Ok(if scores.faults.is_empty() { BenchExitStatus::Good } else { BenchExitStatus::Gap })
}
