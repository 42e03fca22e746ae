//! Parts of messages.

use files::shorten;

/// `; did you mean NAME?`, or nothing without a name.
pub fn suggestion(nearest: Option<&str>) -> String {
    nearest.map(|name| format!("; did you mean {}?", quote(name))).unwrap_or_default()
}

/// A name from a file: on one line and of a bounded length, whatever it holds.
pub fn quote(name: &str) -> String {
    shorten(&name.replace(char::is_control, " ")).into_owned()
}

/// Names with commas between them, or `none`.
pub fn list(names: &[String]) -> String {
    if names.is_empty() {
        return "none".to_owned();
    }
    let first: Vec<String> = names.iter().take(MOST_LISTED).map(|name| quote(name)).collect();
    let more = names.len().saturating_sub(MOST_LISTED);
    let rest = if more == 0 { String::new() } else { format!(" and {more} more") };
    format!("{}{rest}", first.join(", "))
}

/// Most names of [`list`].
const MOST_LISTED: usize = 100;

/// Number of items of [`columns`] that are printed.
const MOST: usize = 16;
/// Most characters of the names together, but of the first.
const LONGEST: usize = 450;

/// `; its columns are t, q[0] to q[5], tau`, numbered ones by the first and the last, or nothing without a name.
pub fn columns(names: &[String]) -> String {
    if names.is_empty() {
        return String::new();
    }
    let items = numbered_together(names);
    let mut length = 0;
    let fits = |name: &String| {
        length += name.chars().count();
        length <= LONGEST
    };
    let mut first: Vec<String> =
        items.iter().take(MOST).map(|item| quote(item)).take_while(fits).collect();
    if first.is_empty() {
        first.extend(items.first().map(|item| quote(item)));
    }
    let more = items.len() - first.len();
    let rest = if more == 0 { String::new() } else { format!(" and {more} more") };
    format!("; its columns are {}{rest}", first.join(", "))
}

/// Names in their order, three or more that differ by a number that counts up as `q[0] to q[5]`.
fn numbered_together(names: &[String]) -> Vec<String> {
    let mut items = Vec::new();
    let mut rest = names;
    while !rest.is_empty() {
        let follows = |pair: &&[String]| counts_on(&pair[0], &pair[1]);
        let length = 1 + rest.windows(2).take_while(follows).count();
        match &rest[..length] {
            [first, _, .., last] if length > 2 => items.push(format!("{first} to {last}")),
            few => items.extend(few.iter().cloned()),
        }
        rest = &rest[length..];
    }
    items
}

/// Whether `next` is `name` with its last number raised by one.
fn counts_on(name: &str, next: &str) -> bool {
    let is_digit = |c: char| c.is_ascii_digit();
    let Some(end) = name.rfind(is_digit).map(|last| last + 1) else { return false };
    let start = name[..end]
        .rfind(|c| !is_digit(c))
        .map_or(0, |at| at + name[at..].chars().next().map_or(1, char::len_utf8));
    let number = name[start..end].parse::<u64>().ok().and_then(|n| n.checked_add(1));
    number.is_some_and(|n| next == format!("{}{n}{}", &name[..start], &name[end..]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::common::error::FormatError;

    #[test]
    fn numbered_columns_are_told_by_their_ends() {
        let of =
            |names: &[&str]| columns(&names.iter().map(|n| (*n).to_owned()).collect::<Vec<_>>());
        assert_eq!(of(&[]), "");
        assert_eq!(
            of(&["t", "q[0]", "q[1]", "q[2]", "é9"]),
            "; its columns are t, q[0] to q[2], é9"
        );
        assert_eq!(of(&["q9", "q10", "a", "a"]), "; its columns are q9, q10, a, a");
        let many: Vec<String> = (0..20).map(|k| format!("{k}\nx{}", k * k)).collect();
        let told = columns(&many);
        assert!(told.ends_with(" and 4 more") && !told.contains('\n'), "{told}");
        let long = ["a", "b", "c", "d", "e", "f", "g", "h"].map(|name| name.repeat(1000));
        let told = columns(&long);
        assert!(told.chars().count() < 500 && told.ends_with(" more"), "{told}");
        let one = columns(&long[..1]);
        assert!(one.starts_with("; its columns are aaa") && one.chars().count() < 500, "{one}");
    }

    #[test]
    fn a_name_of_a_file_keeps_the_message_on_one_line() {
        assert_eq!(suggestion(Some("\0ime\n")), "; did you mean  ime ?");
        let twice =
            FormatError::DuplicateColumn { path: "a.mat".into(), column: "\u{1b}[2J\u{1}".into() };
        assert_eq!(twice.to_string(), "a.mat: two columns are called  [2J , names must be unique");
    }
}
