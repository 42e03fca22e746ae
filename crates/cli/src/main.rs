//! The program `plumbline`.

mod arguments;
mod columns;
mod commands;
mod doubts;
mod error;
mod input;
mod output;
mod progress;
mod watch;

use std::process::ExitCode;

use clap::Parser;

use crate::arguments::{Arguments, Command, LogCommand, RobotCommand};
use crate::commands::{
    compare, demo, design, diagnose, effects, explain, export, learn, log_info, replay,
    robot_check, robot_init, run as run_scenario, schema, simulate, track, trials, view,
};
use crate::error::CliError;

/// How a command that ran to its end turned out.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Outcome {
    /// Exit code 0.
    Good,
    /// A gap is left or an inertia is impossible: exit code 1.
    Gap,
}

fn main() -> ExitCode {
    let result = run(&Arguments::parse());
    match result {
        Ok(Outcome::Good) => ExitCode::SUCCESS,
        Ok(Outcome::Gap) => ExitCode::from(1),
        Err(error) => {
            error.print();
            ExitCode::from(error.exit_code())
        }
    }
}

fn run(arguments: &Arguments) -> Result<Outcome, CliError> {
    match &arguments.command {
        Command::Demo(arguments) => demo::run(arguments),
        Command::Run(arguments) => run_scenario::run(arguments),
        Command::Diagnose(arguments) => diagnose::run(arguments),
        Command::Compare(arguments) => compare::run(arguments),
        Command::Design(arguments) => design::run(arguments),
        Command::Robot(RobotCommand::Check(arguments)) => robot_check::run(arguments),
        Command::Robot(RobotCommand::Init(arguments)) => robot_init::run(arguments),
        Command::Log(LogCommand::Info(arguments)) => log_info::run(arguments),
        Command::Effects(arguments) => effects::run(arguments),
        Command::Explain(arguments) => explain::run(arguments),
        Command::Export(arguments) => export::run(arguments),
        Command::Learn(arguments) => learn::run(arguments),
        Command::Replay(arguments) => replay::run(arguments),
        Command::Simulate(arguments) => simulate::run(arguments),
        Command::Track(arguments) => track::run(arguments),
        Command::Trials(action) => trials::run(action),
        Command::View(arguments) => view::run(arguments),
        Command::Schema(arguments) => schema::run(arguments),
    }
}
