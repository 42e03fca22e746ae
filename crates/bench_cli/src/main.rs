//! The program `plumbline-bench`: campaigns of blind trials, and the figures of a paper.

mod arguments;
mod commands;
mod error;
mod exit_status;
mod submit_error;

use std::ffi::OsString;
use std::process::ExitCode;

use clap::Parser;

use crate::arguments::{Arguments, BenchCommand};
use crate::commands::figure::draw;
use crate::commands::submit::submission;
use crate::commands::times::measure;
use crate::commands::{
    account, board, compare, damage, export, merge, plan, schema, score, sheets, status, work,
};
use crate::error::BenchError;
use crate::exit_status::BenchExitStatus;

fn main() -> ExitCode {
    let command_line: Vec<OsString> = std::env::args_os().collect();
    let read = Arguments::try_parse_from(&command_line);
    cli::keep_command_line("plumbline-bench", command_line);
    let arguments = match read {
        Ok(arguments) => arguments,
        Err(error) => return ExitCode::from(cli::answer_of_clap(&error)),
    };
    match run(&arguments) {
        Ok(BenchExitStatus::Good) => ExitCode::SUCCESS,
        Ok(BenchExitStatus::Gap) => ExitCode::FAILURE,
        Err(error) => {
            error.print();
            ExitCode::from(error.exit_code())
        }
    }
}

fn run(arguments: &Arguments) -> Result<BenchExitStatus, BenchError> {
    match &arguments.command {
        BenchCommand::Plan(arguments) => plan::run(arguments),
        BenchCommand::Work(arguments) => work::run(arguments),
        BenchCommand::Submit(arguments) => submission::run(arguments),
        BenchCommand::Status(arguments) => status::run(arguments),
        BenchCommand::Merge(arguments) => merge::run(arguments),
        BenchCommand::Account(arguments) => account::run(arguments),
        BenchCommand::Compare(arguments) => compare::run(arguments),
        BenchCommand::Damage(arguments) => damage::run(arguments),
        BenchCommand::Export(arguments) => export::run(arguments),
        BenchCommand::Score(arguments) => score::run(arguments),
        BenchCommand::Board(arguments) => board::run(arguments),
        BenchCommand::Sheets(arguments) => sheets::run(arguments),
        BenchCommand::Figure(arguments) => draw::run(arguments),
        BenchCommand::Times(arguments) => measure::run(arguments),
        BenchCommand::Schema(arguments) => schema::run(arguments),
    }
}
