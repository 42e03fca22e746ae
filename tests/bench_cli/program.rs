use std::path::Path;
use std::process::Command;

pub use checks::program::Answer;

/// The file of the program.
pub const PROGRAM: &str = env!("CARGO_BIN_EXE_plumbline-bench");

/// The program.
pub fn plumbline_bench() -> Command {
    checks::program::command(PROGRAM)
}

/// The same with Ctrl-C as a terminal has it.
#[cfg(unix)]
pub fn interruptible() -> Command {
    checks::program::interruptible(PROGRAM)
}

/// Runs the program with these arguments in this folder.
pub fn run(folder: &Path, arguments: &[&str]) -> Answer {
    checks::program::run(PROGRAM, folder, arguments)
}
