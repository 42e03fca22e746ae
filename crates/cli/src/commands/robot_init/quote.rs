//! Names as TOML writes them.

use std::fmt::Write;

/// A key of TOML: bare where it can be.
pub fn key(name: &str) -> String {
    let bare = |c: char| c.is_ascii_alphanumeric() || c == '_' || c == '-';
    if !name.is_empty() && name.chars().all(bare) { name.to_owned() } else { quote(name) }
}

/// A string of TOML on one line, in double quotes.
pub fn quote(text: &str) -> String {
    let mut quoted = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => quoted.extend(['\\', c]),
            c if c.is_control() => {
                let _ = write!(quoted, "\\u{:04X}", u32::from(c));
            }
            c => quoted.push(c),
        }
    }
    quoted + "\""
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn any_name_is_a_key_that_is_read_again() {
        for name in ["a", "a b", "a\"b\\c", "line\nbreak", "\u{7f}", "", "élan", "a.b"] {
            let text = format!("{} = 1", key(name));
            let table: toml::Table = toml::from_str(&text).unwrap();
            assert_eq!(table.keys().next().map(String::as_str), Some(name), "{text}");
        }
    }
}
