use std::path::PathBuf;

use clap::Command;
use clap_mangen::Man;

use crate::error::CliError;
use crate::exit_status::ExitStatus;
use crate::output::{create_folder, print};

/// Width of the help in a page (characters).
const COLUMNS: usize = 100;

/// Arguments of `man`.
#[derive(Debug, clap::Args)]
pub struct Arguments {
    /// Folder for the pages
    #[arg(long, value_name = "DIR", default_value = "out/man")]
    out: PathBuf,
    /// Print one page in Markdown with the help of every command instead
    #[arg(long, conflicts_with = "out")]
    markdown: bool,
}

/// Writes a manual page for the program and for every command.
pub fn run(arguments: &Arguments, mut command: Command) -> Result<ExitStatus, CliError> {
    // Gives every command the names of those above it, and the program its help.
    command.build();
    if arguments.markdown {
        let mut page =
            String::from("# The command line\n\nWhat `--help` prints, command by command.\n");
        help(command, &mut page);
        print(&page)?;
        return Ok(ExitStatus::Good);
    }
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
    below(command).try_for_each(|command| collect(command, pages))
}

/// The commands below one, without `help`, which shows what the pages hold.
fn below(command: &Command) -> impl Iterator<Item = &Command> {
    command.get_subcommands().filter(|c| !c.is_hide_set() && c.get_name() != "help")
}

/// The help of a command and of those below it, each under its name.
fn help(command: Command, page: &mut String) {
    let name = command.get_bin_name().unwrap_or(command.get_name()).to_owned();
    let mut command = command.term_width(COLUMNS);
    let text = command.render_long_help().to_string();
    let lines: Vec<&str> = text.lines().map(str::trim_end).collect();
    page.push_str(&format!("\n## {name}\n\n```text\n{}\n```\n", lines.join("\n").trim_end()));
    below(&command).for_each(|command| help(command.clone(), page));
}
