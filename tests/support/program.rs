//! A program of the workspace as its users start it.

use std::path::Path;
use std::process::{Command, Output};

/// The program in the file `path`, whatever the terminal of the tests says of colours.
pub fn command(path: &str) -> Command {
    let mut command = Command::new(path);
    command.env_remove("NO_COLOR").env_remove("CLICOLOR_FORCE");
    command
}

/// The same with Ctrl-C as a terminal has it: what a shell starts in the background, and all that this starts, is deaf
/// to it.
#[cfg(unix)]
pub fn interruptible(path: &str) -> Command {
    let mut command = command("env");
    command.arg("--default-signal=INT").arg(path);
    command
}

/// Runs the program in the file `path` with these arguments in this folder.
pub fn run(path: &str, folder: &Path, arguments: &[&str]) -> Answer {
    command(path).current_dir(folder).args(arguments).output().unwrap().into()
}

/// Exit code, standard output and standard error.
#[derive(Debug)]
pub struct Answer {
    /// Exit code.
    pub code: i32,
    /// Standard output.
    pub out: String,
    /// Standard error.
    pub err: String,
}

impl From<Output> for Answer {
    fn from(output: Output) -> Self {
        Self {
            code: output.status.code().unwrap(),
            out: String::from_utf8(output.stdout).unwrap(),
            err: String::from_utf8(output.stderr).unwrap(),
        }
    }
}
