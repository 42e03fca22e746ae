use clap::CommandFactory;
use clap_complete::Shell;

use crate::Outcome;
use crate::error::CliError;
use crate::output::print;

/// Arguments of `completions`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// The shell
    #[arg(value_enum)]
    shell: Shell,
}

/// Prints the script with which a shell completes commands and options.
pub fn run(arguments: &Arguments) -> Result<Outcome, CliError> {
    let mut command = crate::arguments::Arguments::command();
    let name = command.get_name().to_owned();
    let mut script = Vec::new();
    clap_complete::generate(arguments.shell, &mut command, name, &mut script);
    print(&String::from_utf8_lossy(&script))?;
    Ok(Outcome::Good)
}
