use std::path::Path;
use std::process::{Command, Output};

/// The file of the program.
pub const PROGRAM: &str = env!("CARGO_BIN_EXE_plumbline-bench");

/// The program.
pub fn plumbline_bench() -> Command {
    let mut command = Command::new(PROGRAM);
    command.env_remove("NO_COLOR").env_remove("CLICOLOR_FORCE");
    command
}

/// The same with Ctrl-C as a terminal has it: what a shell starts in the background, and all that this starts, is deaf
/// to it.
#[cfg(unix)]
pub fn interruptible() -> Command {
    let program = plumbline_bench();
    let mut command = Command::new("env");
    command.env_remove("NO_COLOR").env_remove("CLICOLOR_FORCE");
    command.arg("--default-signal=INT").arg(program.get_program());
    command
}

/// Exit code, standard output and standard error.
#[derive(Debug)]
pub struct Answer {
    pub code: i32,
    pub out: String,
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

/// Runs the program with these arguments in this folder.
pub fn run(folder: &Path, arguments: &[&str]) -> Answer {
    plumbline_bench().current_dir(folder).args(arguments).output().unwrap().into()
}
