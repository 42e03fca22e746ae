use std::borrow::Cow;

/// Most characters of a name or a number in a message.
pub const WORD: usize = 80;
/// Most characters of a message.
pub const MESSAGE: usize = 4000;

/// A name or a number as a message quotes it: of more than [`WORD`] characters the middle is left out, `aaa…zzz`.
pub fn shorten(name: &str) -> Cow<'_, str> {
    without_middle(name, WORD)
}

/// A message whose words are shortened. A word ends at a blank, at a comma, and at the `/` of a path.
pub fn shorten_words(message: &str) -> Cow<'_, str> {
    let is_end = |c: char| c.is_whitespace() || matches!(c, ',' | '/');
    let is_short = |word: &str| word.chars().nth(WORD).is_none();
    if message.split(is_end).all(is_short) {
        return without_middle(message, MESSAGE);
    }
    let mut shown = String::new();
    for piece in message.split_inclusive(is_end) {
        let word = piece.trim_end_matches(is_end);
        shown.push_str(&shorten(word));
        shown.push_str(&piece[word.len()..]);
    }
    Cow::Owned(without_middle(&shown, MESSAGE).into_owned())
}

fn without_middle(text: &str, most: usize) -> Cow<'_, str> {
    // Two thirds stand before the gap: names are told apart by their begin and their number.
    let (before, behind) = (most * 2 / 3, most - 1 - most * 2 / 3);
    let at = |count: usize| text.char_indices().nth(count).map(|(at, _)| at);
    let from_end = |count: usize| text.char_indices().nth_back(count - 1).map(|(at, _)| at);
    match (at(most), at(before), from_end(behind)) {
        (Some(_), Some(first), Some(last)) => {
            Cow::Owned(format!("{}…{}", &text[..first], &text[last..]))
        }
        _ => Cow::Borrowed(text),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_long_word_loses_its_middle_and_the_others_nothing() {
        let word = |count: usize| "é".repeat(count);
        assert_eq!(shorten(&word(WORD)), word(WORD));
        let shown = shorten(&format!("a{}z", word(WORD))).into_owned();
        assert_eq!(shown.chars().count(), WORD);
        assert!(shown.starts_with("aé") && shown.ends_with("éz") && shown.contains('…'), "{shown}");
        let long = "9".repeat(300);
        let told = format!("/a/{long}.csv: row 2,\tcolumn {long}: found {long}, {long},b");
        let shown = shorten_words(&told);
        let words: Vec<&str> = shown.split([' ', '\t', '/', ',']).collect();
        assert!(words.iter().all(|word| word.chars().count() <= WORD), "{shown}");
        assert!(shown.starts_with("/a/9") && shown.contains("row 2,\tcolumn 9"), "{shown}");
        assert!(shown.ends_with("9,b"), "{shown}");
    }

    #[test]
    fn paths_and_lists_of_short_names_stay_whole() {
        let names: Vec<String> = (0..100).map(|k| format!("panda_joint{k}")).collect();
        let path = "/a/folder/of/many/names".repeat(9);
        let told = format!("{path}: --joints {}", names.join(","));
        assert_eq!(shorten_words(&told), told);
    }

    #[test]
    fn a_message_of_many_words_ends() {
        let told = "a long name ".repeat(MESSAGE);
        assert_eq!(shorten_words(&told).chars().count(), MESSAGE);
        let told = format!("{} b", "a".repeat(MESSAGE)).repeat(200);
        assert!(shorten_words(&told).chars().count() <= MESSAGE);
    }
}
