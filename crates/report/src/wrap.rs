/// Lines of at most `width` characters, broken at spaces; a longer word has a line of its own.
pub(crate) fn wrapped(text: &str, width: usize) -> Vec<String> {
    packed(text.split_whitespace(), " ", width)
}

/// Pieces joined by `between` on as few lines of at most `width` characters as they need.
pub fn packed<'a>(
    pieces: impl IntoIterator<Item = &'a str>,
    between: &str,
    width: usize,
) -> Vec<String> {
    let mut lines: Vec<String> = Vec::new();
    for piece in pieces {
        let longer = piece.chars().count() + between.chars().count();
        match lines.last_mut() {
            Some(line) if line.chars().count() + longer <= width => {
                line.push_str(between);
                line.push_str(piece);
            }
            _ => lines.push(piece.to_owned()),
        }
    }
    lines
}

/// A text of at most `most` characters, with an ellipsis for what is cut off.
pub(crate) fn shortened(text: &str, most: usize) -> String {
    if text.chars().count() <= most {
        return text.to_owned();
    }
    text.chars().take(most.saturating_sub(1)).chain(['…']).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_name_ends_in_an_ellipsis() {
        assert_eq!(shortened("élbow", 5), "élbow");
        assert_eq!(shortened("élbow_1", 5), "élbo…");
    }

    #[test]
    fn lines_are_filled_and_not_overfilled() {
        assert_eq!(wrapped("one two  three µµµµ", 8), ["one two", "three", "µµµµ"]);
        assert_eq!(wrapped("a longest b", 3), ["a", "longest", "b"]);
        assert_eq!(packed(["x 1", "y 2", "z 3"], "; ", 8), ["x 1; y 2", "z 3"]);
        assert!(wrapped(" ", 8).is_empty());
    }
}
