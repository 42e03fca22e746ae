use std::path::PathBuf;

use clap::Command;
use clap_mangen::Man;

use crate::error::CliError;
use crate::exit_status::ExitStatus;
use crate::output::create_folder;

/// Arguments of `man`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Folder for the pages
    #[arg(long, value_name = "DIR", default_value = "out/man")]
    out: PathBuf,
}

/// Writes a manual page for the program and for every command.
pub fn run(arguments: &Arguments, mut command: Command) -> Result<ExitStatus, CliError> {
    // Gives every command the names of those above it, and the program its help.
    command.build();
    let mut pages = Vec::new();
    collect(&command, &mut pages)?;
    create_folder(&arguments.out)?;
    let files: Vec<(&str, &[u8])> =
        pages.iter().map(|(name, page)| (name.as_str(), page.as_slice())).collect();
    report::write_folder(&arguments.out, &files)?;
    Ok(ExitStatus::Good)
}

/// The page of a command and those of the commands below it, by the names of their files.
fn collect(command: &Command, pages: &mut Vec<(String, Vec<u8>)>) -> std::io::Result<()> {
    let man = Man::new(command.clone());
    let mut page = Vec::new();
    man.render(&mut page)?;
    pages.push((man.get_filename(), page));
    // `help` shows what the pages hold.
    let mut own = command.get_subcommands().filter(|c| !c.is_hide_set() && c.get_name() != "help");
    own.try_for_each(|command| collect(command, pages))
}
