use anstyle::{AnsiColor, Style};

use crate::text::wrap::wrap;

/// Columns of the terminal that the text fills.
pub const TERMINAL_WIDTH: usize = 100;

/// Warnings that [`push_first_warnings`] shows.
const MOST_WARNINGS: usize = 6;

/// The style of what stands out.
pub const BOLD: Style = Style::new().bold();
/// The style of what may be read later.
pub const FAINT: Style = Style::new().dimmed();

/// A word of a table and what it means.
pub fn push_entry(out: &mut String, word: &str, meaning: &str) {
    out.push_str(&format!("{FAINT}{word:<18} {meaning}{FAINT:#}\n"));
}

/// Warnings, each in sentences of its own.
pub fn push_warnings(out: &mut String, warnings: &[String]) {
    if !warnings.is_empty() {
        out.push('\n');
    }
    for warning in warnings {
        let style = AnsiColor::Yellow.on_default();
        for (i, line) in wrap(warning, TERMINAL_WIDTH - 9).iter().enumerate() {
            let lead = if i == 0 { "warning:" } else { "        " };
            out.push_str(&format!("{style}{lead}{style:#} {line}\n"));
        }
    }
}

/// The first warnings, and how many more there are in the file that holds them all.
pub fn push_first_warnings(out: &mut String, all: &[String], file: &str) {
    let shown = all.len().min(MOST_WARNINGS);
    push_warnings(out, &all[..shown]);
    if shown < all.len() {
        out.push_str(&format!("         and {} more in {file}\n", all.len() - shown));
    }
}

/// Sentences below a table, wrap.
pub fn push_notes(out: &mut String, notes: &[String]) {
    if !notes.is_empty() {
        out.push('\n');
    }
    for line in notes.iter().flat_map(|note| wrap(note, TERMINAL_WIDTH)) {
        out.push_str(&format!("{line}\n"));
    }
}

/// A text without its colours.
pub fn without_escapes(text: &str) -> String {
    let mut pieces = text.split('\u{1b}');
    let first = pieces.next().unwrap_or_default().to_owned();
    pieces.fold(first, |out, piece| out + piece.split_once('m').map_or("", |(_, rest)| rest))
}
