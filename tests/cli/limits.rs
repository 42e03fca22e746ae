//! Commands that find no room for a file.

use std::path::Path;
use std::process::{Command, Output};

use crate::program::{Answer, PROGRAM};

/// Runs a command where no file may become larger than so many kB, as on a disk that is full.
pub fn with_room(folder: &Path, kb: usize, arguments: &[&str]) -> Answer {
    limited(folder, "trap '' XFSZ; ", kb, arguments).into()
}

/// Runs a command that the system kills in the middle of the write with which a file becomes larger than so many kB.
pub fn killed_beyond(folder: &Path, kb: usize, arguments: &[&str]) -> Output {
    limited(folder, "ulimit -c 0; ", kb, arguments)
}

fn limited(folder: &Path, before: &str, kb: usize, arguments: &[&str]) -> Output {
    let script = format!("{before}ulimit -f {}; exec \"$0\" \"$@\"", 2 * kb);
    let mut command = Command::new("sh");
    command.current_dir(folder).args(["-c", &script]).arg(PROGRAM).args(arguments);
    command.output().unwrap()
}
