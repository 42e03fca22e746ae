use std::path::{Path, PathBuf};

use document::Document;
use evaluation::Experiment;

use crate::Outcome;
use crate::commands::run::{Output, perform};
use crate::error::CliError;

/// The robot and the scenario, as the repository has them.
const SOURCES: [(&str, &[u8]); 4] = [
    ("robots/wam7/robot.urdf", include_bytes!("../../../../robots/wam7/robot.urdf")),
    ("robots/wam7/robot.toml", include_bytes!("../../../../robots/wam7/robot.toml")),
    ("scenarios/wam.toml", include_bytes!("../../../../scenarios/wam.toml")),
    (SCENARIO, include_bytes!("../../../../scenarios/demo.toml")),
];

const SCENARIO: &str = "scenarios/demo.toml";

const INTRODUCTION: &str = "\
A Barrett WAM is simulated with two effects hidden in it. What is wrong with the model of it is found
from the logs alone, and repaired; then the truth is opened.
";

/// Arguments of `demo`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    #[command(flatten)]
    output: Output,
    /// Seed that the two effects are drawn from, and the noise of the sensors
    #[arg(long, value_parser = clap::value_parser!(u64).range(0..=i64::MAX as u64))]
    seed: Option<u64>,
}

/// Hides two effects in a simulated arm, finds them in its logs and measures what that gains.
pub fn run(arguments: &Arguments) -> Result<Outcome, CliError> {
    let out = arguments.output.out.clone().unwrap_or_else(|| PathBuf::from("out/demo"));
    let source = out.join("source");
    report::write_folder(&source, &SOURCES)?;
    let scenario = source.join(Path::new(SCENARIO));
    let experiment = Experiment::from_document(&Document::read(&scenario)?, arguments.seed)?;
    arguments.output.leave(INTRODUCTION);
    perform(&experiment, &scenario, &out, &arguments.output)
}
