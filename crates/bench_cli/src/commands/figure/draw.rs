use std::path::Path;

use benchmark::{FigureScenario, FigureSpec};
use document::Document;

use crate::commands::figure::arguments::Arguments;
use crate::commands::figure::{learning, prediction_time};
use crate::error::BenchError;
use crate::exit_status::BenchExitStatus;

/// Draws a figure of the paper and says of every claim about it whether it holds.
pub fn run(arguments: &Arguments) -> Result<BenchExitStatus, BenchError> {
    let mut document = Document::read(&arguments.scenario)?;
    for assignment in &arguments.set {
        document.set(assignment)?;
    }
    let stem = arguments.scenario.file_stem().unwrap_or_default();
    let out = arguments.output.out.clone().unwrap_or_else(|| Path::new("out").join(stem));
    let scenario: FigureScenario = document.parse()?;
    match scenario.figure {
        FigureSpec::PredictionTime(_) => prediction_time::run(arguments, &document, &out),
        FigureSpec::Learning(_) => learning::run(arguments, &document, &out),
    }
}
