//! The program `plumbline-bench`: campaigns of blind trials, and the figures of a paper.

mod arguments;
mod commands;
mod error;
mod exit_status;
mod submit_error;

use std::ffi::OsString;
use std::process::ExitCode;

use clap::Parser;

use crate::arguments::{Arguments, Command};
use crate::commands::figure::draw;
use crate::commands::submit::submission;
use crate::commands::times::measure;
use crate::commands::{compare, merge, plan, schema, status, work};
use crate::error::BenchError;
use crate::exit_status::ExitStatus;

fn main() -> ExitCode {
    let command_line: Vec<OsString> = std::env::args_os().collect();
    let arguments = Arguments::parse_from(&command_line);
    cli::keep_command_line("plumbline-bench", command_line);
    match run(&arguments) {
        Ok(ExitStatus::Good) => ExitCode::SUCCESS,
        Ok(ExitStatus::Gap) => ExitCode::FAILURE,
        Err(error) => {
            error.print();
            ExitCode::from(error.exit_code())
        }
    }
}

fn run(arguments: &Arguments) -> Result<ExitStatus, BenchError> {
    match &arguments.command {
        Command::Plan(arguments) => plan::run(arguments),
        Command::Work(arguments) => work::run(arguments),
        Command::Submit(arguments) => submission::run(arguments),
        Command::Status(arguments) => status::run(arguments),
        Command::Merge(arguments) => merge::run(arguments),
        Command::Compare(arguments) => compare::run(arguments),
        Command::Figure(arguments) => draw::run(arguments),
        Command::Times(arguments) => measure::run(arguments),
        Command::Schema(arguments) => schema::run(arguments),
    }
}
