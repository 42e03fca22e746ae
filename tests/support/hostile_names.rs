//! Names that mean something to a format of files.

/// One for every character that a format obeys.
pub const HOSTILE_NAMES: [&str; 22] = [
    "a\nb = 1\n#",
    "a\rb",
    "a\tb",
    "a]]>b",
    "</script><script>alert(1)</script>",
    "--><robot>",
    "a & b &amp; &#10;",
    "<a href='x'>\"y\"</a>",
    "a'b\"c\\d",
    "\"\"\"a'''",
    "[joint.b]",
    "{\"a\": 1}",
    "@a@</a>(b)",
    "a\u{0}b\u{1}",
    "a\u{1b}[2Jb\u{7}",
    "a\u{85}b\u{9b}c",
    "a\u{202e}b\u{2066}c",
    "a\u{2028}b\u{2029}",
    "\u{feff}a\u{fffe}\u{ffff}",
    "a\u{7f}b",
    "../../a",
    "élan 臂 🦾",
];

/// A name as an attribute of XML, all but letters and digits by their number.
pub fn in_xml(name: &str) -> String {
    let shown = |c: char| match c.is_ascii_alphanumeric() {
        true => c.to_string(),
        false => format!("&#{};", u32::from(c)),
    };
    name.chars().map(shown).collect()
}

/// What XML 1.0 can hold of a name: other characters as `\u{1b}`.
pub fn held_by_xml(name: &str) -> String {
    let is_left_out = |c: char| c < ' ' && !matches!(c, '\t' | '\n' | '\r');
    let shown = |c: char| match is_left_out(c) || matches!(c, '\u{fffe}' | '\u{ffff}') {
        true => c.escape_unicode().to_string(),
        false => c.to_string(),
    };
    name.chars().map(shown).collect()
}
