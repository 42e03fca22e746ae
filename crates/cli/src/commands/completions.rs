use clap::Command;
use clap_complete::Shell;

use crate::error::CliError;
use crate::exit_status::ExitStatus;
use crate::output::print;

/// Arguments of `completions`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The shell
    #[arg(value_enum)]
    shell: Shell,
}

/// Prints the script with which a shell completes the commands and options of the program.
pub fn run(arguments: &Arguments, mut command: Command) -> Result<ExitStatus, CliError> {
    let name = command.get_name().to_owned();
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut command, name, &mut script);
    print(&String::from_utf8_lossy(&script))?;
    Ok(ExitStatus::Good)
}
