//! Parts of messages.

/// `; did you mean NAME?`, or nothing without a name.
pub fn suggestion(nearest: Option<&str>) -> String {
    // A message stays one line, whatever the names in the file hold.
    let plain = |name: &str| name.replace(char::is_control, " ");
    nearest.map(|name| format!("; did you mean {}?", plain(name))).unwrap_or_default()
}

/// Names with commas between them, or `none`.
pub fn list(names: &[String]) -> String {
    if names.is_empty() { "none".to_owned() } else { names.join(", ") }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_of_a_file_keeps_the_message_on_one_line() {
        assert_eq!(suggestion(Some("\0ime\n")), "; did you mean  ime ?");
    }
}
