use clap::{Parser, Subcommand};

use crate::commands::{diagnose, explain, log_info, robot_check};

const EXIT_CODES: &str = "\
Exit codes:
  0  explained or consistent; for other commands: done
  1  a gap is left unexplained, or the data cannot show one; robot check: an impossible inertia
  2  usage: arguments, or an output folder that cannot be written
  3  unusable data: a robot, a log or a column map";

/// Shows what a simulation gets wrong in a recorded log, names the cause, extends the
/// model and measures the gain.
#[derive(Debug, Parser)]
#[command(name = "plumbline", version, after_help = EXIT_CODES, arg_required_else_help = true)]
pub struct Arguments {
    /// What to do.
    #[command(subcommand)]
    pub command: Command,
}

/// The commands.
#[derive(Debug, Subcommand)]
pub enum Command {
    /// Names what the model gets wrong in the logs and writes the extended model and a report
    #[command(after_help = EXIT_CODES)]
    Diagnose(diagnose::Arguments),
    /// Looks at a robot description
    #[command(subcommand)]
    Robot(RobotCommand),
    /// Looks at logs
    #[command(subcommand)]
    Log(LogCommand),
    /// Explains an effect: equation, signature, what it is confused with; without a name, lists all
    Explain(explain::Arguments),
}

/// Commands on a robot description.
#[derive(Debug, Subcommand)]
pub enum RobotCommand {
    /// Prints joints, limits, masses, consistency and the number of base parameters
    #[command(after_help = EXIT_CODES)]
    Check(robot_check::Arguments),
}

/// Commands on logs.
#[derive(Debug, Subcommand)]
pub enum LogCommand {
    /// Prints rate, jitter, gaps, ranges, quantisation, saturation and time skew
    #[command(after_help = EXIT_CODES)]
    Info(log_info::Arguments),
}
