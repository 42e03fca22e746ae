/// Lines of at most `width` characters, broken at spaces; a longer word has a line of its own.
pub fn wrap(text: &str, width: usize) -> Vec<String> {
    pack(text.split_whitespace(), " ", width)
}

/// Pieces joined by `between` on as few lines of at most `width` characters as they need.
pub fn pack<'a>(
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
pub fn shorten(text: &str, most: usize) -> String {
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
        assert_eq!(shorten("élbow", 5), "élbow");
        assert_eq!(shorten("élbow_1", 5), "élbo…");
    }

    #[test]
    fn lines_are_filled_and_not_overfilled() {
        assert_eq!(wrap("one two  three µµµµ", 8), ["one two", "three", "µµµµ"]);
        assert_eq!(wrap("a longest b", 3), ["a", "longest", "b"]);
        assert_eq!(pack(["x 1", "y 2", "z 3"], "; ", 8), ["x 1; y 2", "z 3"]);
        assert!(wrap(" ", 8).is_empty());
    }
}
