use std::fmt::Display;
use std::io::Write;

use anstyle::{AnsiColor, Style};
use files::shorten_words;

use crate::escape::escape;

/// Prints a line on the standard error, its colours only where they are wanted and nothing else that a terminal obeys.
///
/// A line that cannot be written, as on a full disk, is left out; the answer and the exit code do
/// not depend on it.
pub fn tell(what: &dyn Display) {
    let _ = writeln!(anstream::stderr().lock(), "{}", escape(&what.to_string()));
}

/// Prints words of the program, in which names from files have a bounded length, on the standard error.
pub fn note(what: &dyn Display) {
    tell(&format_args!("note: {}", shorten_words(&what.to_string())));
}

/// Prints a warning on the standard error.
pub fn warn(what: &dyn Display) {
    let yellow = AnsiColor::Yellow.on_default();
    tell(&format_args!("{yellow}warning:{yellow:#} {}", shorten_words(&what.to_string())));
}

/// Prints an error, and advice where there is any, on the standard error.
pub fn print_error(error: &dyn Display, help: Option<&str>) {
    let red: Style = AnsiColor::Red.on_default().bold();
    let cyan: Style = AnsiColor::Cyan.on_default().bold();
    tell(&format_args!("{red}error:{red:#} {}", shorten_words(&error.to_string())));
    if let Some(help) = help {
        tell(&format_args!("{cyan}help:{cyan:#} {}", shorten_words(help)));
    }
}
