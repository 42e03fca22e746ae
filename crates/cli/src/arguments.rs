use std::fmt::Write as _;

use clap::{CommandFactory, Parser, Subcommand};

use crate::after_help::{MOST_COLUMNS, after, list, terminal_width};
use crate::commands::{
    compare, completions, demo, design, diagnose, explain, export, learn, log_info, man, replay,
    robot_check, robot_init, run, schema, simulate, track, view,
};
use crate::help_texts as help;

/// The commands as the help of the program lists them, by what one has to do.
const GROUPS: [(&str, &[&str]); 3] = [
    (
        "Your arm",
        &["diagnose", "compare", "design", "export", "log", "robot", "explain", "view", "demo"],
    ),
    ("Simulation and research", &["simulate", "run", "replay", "learn", "track"]),
    ("Shell", &["completions", "man", "schema"]),
];

/// Shows what a simulation gets wrong in a recorded log, names the cause, extends the
/// model and measures the gain.
#[derive(Debug, Parser)]
#[command(
    name = "plumbline",
    version,
    max_term_width = MOST_COLUMNS,
    after_help = after(help::PROGRAM),
    arg_required_else_help = true
)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Names what a model gets wrong in logs, writes the extended model, a report and a figure
    #[command(after_help = after(help::DIAGNOSE))]
    Diagnose(diagnose::Arguments),
    /// Names what changed from one set of logs to another
    #[command(after_help = after(help::COMPARE))]
    Compare(compare::Arguments),
    /// Searches the motion that tells apart what a diagnosis could not, within the robot's limits
    #[command(after_help = after(help::DESIGN))]
    Design(design::Arguments),
    /// Writes the robot with its findings as URDF, MJCF, SDF and USD, and the actuator card of its
    /// servos (--to actuator); says what each leaves out
    #[command(after_help = after(help::EXPORT))]
    Export(export::Arguments),
    /// Looks at logs: rate, gaps, ranges, noise, time skew
    #[command(subcommand)]
    Log(LogCommand),
    /// Looks at a robot description: joints, limits, masses, consistency
    #[command(subcommand)]
    Robot(RobotCommand),
    /// Explains an effect by its code or name; without one lists them all
    #[command(alias = "effects", after_help = after(help::EXPLAIN))]
    Explain(explain::Arguments),
    /// Opens the report of an output folder in the browser, its recordings in rerun's viewer
    #[command(after_help = after(help::VIEW))]
    View(view::Arguments),
    /// Shows a whole run on an arm that comes with the program: two effects are hidden, found, and repaired
    #[command(after_help = after(help::DEMO))]
    Demo(demo::Arguments),
    /// Makes logs alone: simulates a scenario, and writes what was put in apart from them
    #[command(after_help = after(help::SIMULATE))]
    Simulate(simulate::Arguments),
    /// Simulates a scenario, diagnoses its logs, and measures what the answer gains
    #[command(after_help = after(help::RUN))]
    Run(run::Arguments),
    /// Compares a simulation with logs: motion under their torque, torque along their motion
    #[command(after_help = after(help::REPLAY))]
    Replay(replay::Arguments),
    /// Learns models of the torque from logs and compares them on others
    #[command(after_help = after(help::LEARN))]
    Learn(learn::arguments::Arguments),
    /// Tracks a motion with low gains and the torque of models fed forward, and compares them
    #[command(after_help = after(help::TRACK))]
    Track(track::Arguments),
    /// Prints the script with which a shell completes commands and options
    #[command(after_help = after(help::COMPLETIONS))]
    Completions(completions::Arguments),
    /// Writes a manual page for the program and for every command
    #[command(after_help = after(help::MAN))]
    Man(man::Arguments),
    /// Prints the JSON schema of a file that is read or written; lists all schemas without a name
    #[command(after_help = after(help::SCHEMA))]
    Schema(schema::Arguments),
}

/// Commands on a robot description.
#[derive(Debug, Subcommand)]
pub enum RobotCommand {
    /// Prints joints, limits, masses, consistency and the number of base parameters
    #[command(after_help = after(help::ROBOT_CHECK))]
    Check(robot_check::Arguments),
    /// Writes a robot.toml with what a URDF cannot say, guessed, and a scenario that moves the robot
    #[command(after_help = after(help::ROBOT_INIT))]
    Init(robot_init::Arguments),
}

/// Commands on logs.
#[derive(Debug, Subcommand)]
pub enum LogCommand {
    /// Prints rate, jitter, gaps, ranges, quantisation, saturation and time skew
    #[command(after_help = after(help::LOG_INFO))]
    Info(log_info::Arguments),
}

/// The command line, whose help lists the commands in groups.
pub fn command() -> clap::Command {
    let command = Arguments::command();
    let header = command.get_styles().get_header();
    let mut template = "{about-with-newline}\n{usage-heading} {usage}\n\n".to_owned();
    let width = terminal_width();
    for (title, names) in GROUPS {
        let words = |name: &&str| {
            let about = command.find_subcommand(name).and_then(clap::Command::get_about);
            about.map(ToString::to_string).unwrap_or_default()
        };
        let words: Vec<String> = names.iter().map(words).collect();
        let rows = names.iter().zip(&words).map(|(name, words)| (*name, words.as_str()));
        let rows = list(&rows.collect::<Vec<_>>(), width);
        let _ = write!(template, "{header}{title}:{header:#}\n{rows}\n\n");
    }
    let _ = write!(template, "{header}Options:{header:#}\n{{options}}{{after-help}}");
    command.help_template(template)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_command_is_in_one_group() {
        let mut listed: Vec<&str> =
            GROUPS.iter().flat_map(|(_, names)| names.iter().copied()).collect();
        let command = Arguments::command();
        let mut all: Vec<&str> = command.get_subcommands().map(|c| c.get_name()).collect();
        listed.sort_unstable();
        all.sort_unstable();
        assert_eq!(listed, all);
    }

    #[test]
    fn the_command_line_is_consistent() {
        command().debug_assert();
    }
}
