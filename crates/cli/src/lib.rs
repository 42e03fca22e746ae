//! The program `plumbline`, and what of it the Python module shares.
//!
//! ```text
//! command line -> main -> a command -> files, text, exit code
//! ```
//!
//! [`main`] is the program, whoever starts it. The rest is how files are read, how a diagnosis is
//! written and recorded, and what `design` and `track` do, for whoever has them in memory; and what
//! `plumbline-bench` shares: the command line, the output folder, progress and errors.

mod after_help;
mod arguments;
mod columns;
mod commands;
mod design_error;
mod diagnosed_input;
mod effect_facts;
mod effect_name;
mod error;
mod escape;
mod exit_status;
mod help_texts;
mod input;
mod input_warnings;
mod installed;
mod invocation;
mod loss;
mod messages;
mod output;
mod path;
mod progress;
mod quiet;
mod schema_text;
mod watch;

use std::ffi::OsString;

use clap::FromArgMatches;

use crate::arguments::{Arguments, Command, LogCommand, RobotCommand, command};
use crate::commands::{
    compare, completions, demo, design, diagnose, explain, export, learn, log_info, man, replay,
    robot_check, robot_init, run as run_scenario, schema, simulate, track, view,
};
use crate::exit_status::ExitStatus;

pub use crate::columns::{ColumnArguments, ExcerptArguments};
pub use crate::commands::compare::words as comparison_text;
pub use crate::commands::design::diagnosis_file::DiagnosisFile;
pub use crate::commands::design::motion_design::{MotionDesign, MotionRequest};
pub use crate::commands::diagnose::{
    write as write_diagnosis, write_recording as record_diagnosis,
};
pub use crate::commands::explain::plain_explanation;
pub use crate::commands::learn::timing::{median_query_us, median_us};
pub use crate::commands::replay::Replays;
pub use crate::commands::robot_init::{
    Arguments as RobotInit, InitialisedRobot, write as init_robot,
};
pub use crate::commands::run::Output as RunOutput;
pub use crate::commands::run::run_folder::{
    DiagnosedRuns, EXTENDED, RunFolder, diagnosis_files, log_file,
};
pub use crate::commands::schema::print_schema;
pub use crate::commands::track::tracking_result::{TrackingRequest, TrackingResult};
pub use crate::diagnosed_input::options_of_columns;
pub use crate::effect_facts::facts as effect_facts;
pub use crate::effect_name::find_effect;
pub use crate::error::CliError;
pub use crate::escape::escape_json;
pub use crate::input::{
    PartArguments, SearchArguments, hash, hashes_of, provenance, provenance_of,
};
pub use crate::input_warnings::{corrected_runs, input_warnings};
pub use crate::invocation::{
    keep as keep_command_line, name as program_name, program as program_file,
};
pub use crate::messages::print_error;
pub use crate::output::{create_folder, display_path, print, print_json};
pub use crate::progress::Line;
pub use crate::watch::Watch;

/// Runs the program with a command line, whose first argument is the program's own name, and gives its
/// exit code.
///
/// Without a command that can be understood it is the help that was asked for, or what is wrong with the command line.
pub fn main(command_line: Vec<OsString>) -> u8 {
    let read = command().try_get_matches_from(&command_line).and_then(|matches| {
        Arguments::from_arg_matches(&matches).map_err(|error| error.format(&mut command()))
    });
    invocation::keep("plumbline", command_line);
    match read.map_err(|error| answer_of_clap(&error)).map(|arguments| run(&arguments)) {
        Err(code) => code,
        Ok(ran) => exit_code(ran),
    }
}

/// Prints the help that was asked for, or what is wrong with the command line, and gives the exit code.
pub fn answer_of_clap(error: &clap::Error) -> u8 {
    let text = error.render().ansi().to_string();
    if error.use_stderr() {
        messages::tell(&text.trim_end_matches('\n'));
    } else if let Err(error) = print(&text) {
        return exit_code(Err(error));
    }
    u8::try_from(error.exit_code()).unwrap_or(2)
}

fn exit_code(ran: Result<ExitStatus, CliError>) -> u8 {
    match ran {
        Ok(status) => status.code(),
        Err(error) => {
            error.print();
            error.exit_code()
        }
    }
}

fn run(arguments: &Arguments) -> Result<ExitStatus, CliError> {
    match &arguments.command {
        Command::Demo(arguments) => demo::run(arguments),
        Command::Run(arguments) => run_scenario::run(arguments),
        Command::Diagnose(arguments) => diagnose::run(arguments),
        Command::Compare(arguments) => compare::run(arguments),
        Command::Design(arguments) => design::run(arguments),
        Command::Robot(RobotCommand::Check(arguments)) => robot_check::run(arguments),
        Command::Robot(RobotCommand::Init(arguments)) => robot_init::run(arguments),
        Command::Log(LogCommand::Info(arguments)) => log_info::run(arguments),
        Command::Explain(arguments) => explain::run(arguments),
        Command::Export(arguments) => export::run(arguments),
        Command::Learn(arguments) => learn::run(arguments),
        Command::Replay(arguments) => replay::run(arguments),
        Command::Simulate(arguments) => simulate::run(arguments),
        Command::Track(arguments) => track::run(arguments),
        Command::View(arguments) => view::run(arguments),
        Command::Schema(arguments) => schema::run(arguments),
        Command::Completions(arguments) => completions::run(arguments, command()),
        Command::Man(arguments) => man::run(arguments, command()),
    }
}
