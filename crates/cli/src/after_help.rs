use self::HelpPart::{Examples, List, Words};

/// Columns of a help text at most.
pub const MOST_COLUMNS: usize = 100;

/// Columns that a name in a list may take before what it is stands below it.
const LONGEST_NAME: usize = 20;

/// Columns that the words beside a name have at least.
const NARROWEST: usize = 20;

/// A part of what stands behind the options in the help of a command.
pub enum HelpPart {
    /// Command lines, each as it is typed.
    Examples(&'static [&'static str]),
    /// A paragraph.
    Words(&'static str),
    /// What a list is of, and each of its names with what it is.
    List(&'static str, &'static [(&'static str, &'static str)]),
}

/// The parts, laid out for the terminal.
pub fn after(parts: &[HelpPart]) -> String {
    let width = terminal_width();
    let texts: Vec<String> = parts.iter().map(|part| part.text(width)).collect();
    texts.join("\n\n")
}

/// Names with what each is, beside one another where that fits into `width` columns.
pub fn list(rows: &[(&str, &str)], width: usize) -> String {
    let longest = rows.iter().map(|(name, _)| name.len()).filter(|&length| length <= LONGEST_NAME);
    let indent = longest.max().unwrap_or(0) + 4;
    let room = width.saturating_sub(indent).max(NARROWEST);
    let row = |(name, words): &(&str, &str)| {
        let lines = report::pack(words.split_whitespace(), " ", room);
        let words = lines.join(&format!("\n{:indent$}", ""));
        match name.len() > indent - 4 {
            true => format!("  {name}\n{:indent$}{words}", ""),
            false => format!("  {name:<0$}  {words}", indent - 4),
        }
    };
    rows.iter().map(row).collect::<Vec<_>>().join("\n")
}

/// Columns of the terminal as clap counts them, which lays out the rest of a help text.
pub fn terminal_width() -> usize {
    let terminal = terminal_size::terminal_size().map(|(width, _)| usize::from(width.0));
    let told = || std::env::var("COLUMNS").ok()?.parse().ok();
    terminal.or_else(told).unwrap_or(MOST_COLUMNS).min(MOST_COLUMNS)
}

impl HelpPart {
    fn text(&self, width: usize) -> String {
        match self {
            Examples(lines) => format!("Examples:\n  {}", lines.join("\n  ")),
            Words(words) => report::pack(words.split_whitespace(), " ", width).join("\n"),
            List(title, rows) => format!("{title}\n{}", list(rows, width)),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_a_name_is_stands_beside_it_or_below_it_and_never_under_it() {
        let rows = [
            ("a.toml", "one two three four five"),
            ("models/a-very-long-name.parquet", "six seven"),
        ];
        let expected = "  a.toml  one two three four\n          five\n  \
                        models/a-very-long-name.parquet\n          six seven";
        assert_eq!(list(&rows, 30), expected);
    }

    #[test]
    fn a_paragraph_has_no_line_that_is_cut() {
        let text = Words("one two three four").text(9);
        assert_eq!(text, "one two\nthree\nfour");
    }
}
