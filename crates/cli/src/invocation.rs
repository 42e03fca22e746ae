use std::ffi::OsString;
use std::io;
use std::path::{Path, PathBuf};
use std::sync::OnceLock;

/// The command line of this call. It differs from that of the operating system where another
/// program has called [`crate::main`].
static COMMAND_LINE: OnceLock<Vec<OsString>> = OnceLock::new();

/// The name of the program that this process is.
static NAME: OnceLock<&str> = OnceLock::new();

/// Keeps the name of the program and the command line that it was started with; the first ones count.
pub fn keep(name: &'static str, command_line: Vec<OsString>) {
    let _ = NAME.set(name);
    let _ = COMMAND_LINE.set(command_line);
}

/// The name of the program: `plumbline`, unless another one was started.
pub fn name() -> &'static str {
    NAME.get().copied().unwrap_or("plumbline")
}

/// The arguments behind the program's name.
pub fn arguments() -> Vec<String> {
    let all = COMMAND_LINE.get().map_or(&[] as &[_], Vec::as_slice);
    all.iter().skip(1).map(|argument| argument.to_string_lossy().into_owned()).collect()
}

/// The file to start for another run of this program.
///
/// # Errors
///
/// What the operating system says where it does not know.
pub fn program() -> io::Result<PathBuf> {
    let name = COMMAND_LINE.get().and_then(|all| all.first()).map(Path::new);
    match name.filter(|name| name.components().count() > 1) {
        Some(path) => path.canonicalize(),
        None => std::env::current_exe(),
    }
}
