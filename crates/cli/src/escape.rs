//! Text of which a terminal obeys nothing but the program's own styles.
//!
//! Names come from files and files come from anyone. All that the program prints goes through here on its way out, so
//! that where a name came from does not matter.

use std::fmt::Write;

/// Begin and end of the code of a style.
const STYLE: (&str, char) = ("\u{1b}[", 'm');
/// Longest code of a style, without begin and end (bytes).
const LONGEST_STYLE: usize = 8;

/// A text with its lines. A character that a terminal would obey, or that turns the direction of what stands beside it,
/// is written by its number: `\u{9b}`.
pub fn escape(text: &str) -> String {
    let is_layout = |c: char| matches!(c, '\n' | '\t');
    let mut shown = String::with_capacity(text.len());
    let mut rest = text;
    while let Some(c) = rest.chars().next() {
        let length = style(rest).unwrap_or(0);
        if length > 0 || !is_obeyed(c) || is_layout(c) {
            let (kept, behind) = rest.split_at(length.max(c.len_utf8()));
            shown.push_str(kept);
            rest = behind;
        } else {
            shown.extend(c.escape_unicode());
            rest = &rest[c.len_utf8()..];
        }
    }
    shown
}

/// A text as one line without styles, for a comment: ends of lines and tabs are written by their numbers too.
pub fn escape_line(text: &str) -> String {
    let mut line = String::with_capacity(text.len());
    for c in text.chars() {
        if is_obeyed(c) { line.extend(c.escape_unicode()) } else { line.push(c) }
    }
    line
}

/// JSON that means the same, with nothing in it that a terminal obeys.
pub fn escape_json(json: &str) -> String {
    let mut shown = String::with_capacity(json.len());
    for c in json.chars() {
        // Between strings stand no other characters than these, and in strings JSON itself forbids them.
        if !is_obeyed(c) || matches!(c, '\n' | '\t' | '\r') {
            shown.push(c);
            continue;
        }
        for unit in c.encode_utf16(&mut [0; 2]) {
            let _ = write!(shown, "\\u{unit:04x}");
        }
    }
    shown
}

/// Whether a terminal obeys a character, or writes what is around it in another order.
fn is_obeyed(c: char) -> bool {
    let is_direction = matches!(c, '\u{61c}' | '\u{200e}' | '\u{200f}' | '\u{202a}'..='\u{202e}' | '\u{2066}'..='\u{2069}');
    let is_unseen = matches!(c, '\u{2028}' | '\u{2029}' | '\u{feff}' | '\u{e0000}'..='\u{e007f}');
    c.is_control() || is_direction || is_unseen
}

/// Length of the code of one of the program's own styles that a text begins with (bytes): bold, faint, italic,
/// underlined and coloured, and none of these. What hides or blinks is no style of the program.
fn style(text: &str) -> Option<usize> {
    let (begin, end) = STYLE;
    let code = text.strip_prefix(begin)?;
    let length = code.find(end).filter(|length| *length <= LONGEST_STYLE)?;
    let is_own = match &code[..length] {
        "" | "0" | "1" | "2" | "3" | "4" => true,
        code => match code.strip_prefix("38;5;") {
            Some(colour) => colour.parse::<u8>().is_ok(),
            None => matches!(code.parse::<u8>(), Ok(31..=37 | 90..=97)),
        },
    };
    is_own.then_some(begin.len() + length + end.len_utf8())
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    const HOSTILE: &str = "[\u{0}-\u{1f}\u{7f}-\u{a0}\u{61c}\u{200e}\u{202a}-\u{202e}\u{2066}-\u{2069}\u{feff}\u{e0041}a\\[\\];m0-9\"\\\\]{0,40}";

    #[test]
    fn what_a_terminal_obeys_is_written_by_its_number() {
        assert_eq!(escape("a\u{1b}]0;b\u{7}\rc\n\td"), "a\\u{1b}]0;b\\u{7}\\u{d}c\n\td");
        assert_eq!(escape("\u{9b}2J\u{202e}é"), "\\u{9b}2J\\u{202e}é");
        assert_eq!(escape_line("a\nb = 1\u{1b}[1m"), "a\\u{a}b = 1\\u{1b}[1m");
    }

    #[test]
    fn styles_of_the_program_stay_and_others_do_not() {
        for own in ["\u{1b}[0m", "\u{1b}[1m", "\u{1b}[33m", "\u{1b}[38;5;12m", "\u{1b}[m"] {
            assert_eq!(escape(own), own);
        }
        for other in ["\u{1b}[8m", "\u{1b}[7m", "\u{1b}[2J", "\u{1b}[38;5;999m", "\u{1b}["] {
            assert_eq!(escape(other), other.replace('\u{1b}', "\\u{1b}"));
        }
    }

    proptest! {
        #[test]
        fn nothing_that_is_obeyed_is_left(name in HOSTILE) {
            let text = escape(&format!("\u{1b}[1m{name}\u{1b}[0m\n"));
            let mut rest = text.as_str();
            while let Some(c) = rest.chars().next() {
                let length = style(rest).unwrap_or(c.len_utf8());
                prop_assert!(style(rest).is_some() || !is_obeyed(c) || matches!(c, '\n' | '\t'));
                rest = &rest[length..];
            }
            prop_assert!(!escape_line(&name).contains(is_obeyed));
        }

        #[test]
        fn a_comment_of_toml_ends_with_its_line(name in HOSTILE) {
            let table: toml::Table = toml::from_str(&format!("# {}\na = 1\n", escape_line(&name))).unwrap();
            prop_assert_eq!(table.len(), 1);
        }

        #[test]
        fn json_means_the_same(name in HOSTILE) {
            let json = serde_json::to_string_pretty(&[&name]).unwrap();
            let shown = escape_json(&json);
            prop_assert!(!shown.contains(|c: char| is_obeyed(c) && c != '\n'));
            let read: Vec<String> = serde_json::from_str(&shown).unwrap();
            prop_assert_eq!(read, vec![name]);
        }
    }
}
