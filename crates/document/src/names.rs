/// The candidate that `found` is most likely a misspelling of.
///
/// A candidate is near when at most a third of its letters are wrong, missing or exchanged
/// with their neighbour (upper and lower case count as equal), or when one is the start of
/// the other, as in `level` for `level_nm`. Of equally near ones the first is given.
///
/// ```
/// use document::suggest;
///
/// assert_eq!(suggest("elbwo", ["shoulder", "elbow"]), Some("elbow"));
/// assert_eq!(suggest("level", ["joint", "level_nm"]), Some("level_nm"));
/// assert_eq!(suggest("knee", ["shoulder", "elbow"]), None);
/// ```
pub fn suggest<'a>(found: &str, candidates: impl IntoIterator<Item = &'a str>) -> Option<&'a str> {
    // Two letters would start too much.
    const SHORTEST_START: usize = 3;
    let found = found.to_lowercase();
    let starts = |start: &str, whole: &str| {
        start.chars().count() >= SHORTEST_START && whole.starts_with(start)
    };
    let near = candidates.into_iter().filter_map(|candidate| {
        let lower = candidate.to_lowercase();
        let wrong = strsim::damerau_levenshtein(&found, &lower);
        let few = 3 * wrong <= lower.chars().count().max(3);
        let start = starts(&found, &lower) || starts(&lower, &found);
        (few || start).then_some((wrong, candidate))
    });
    near.min_by_key(|(wrong, _)| *wrong).map(|(_, candidate)| candidate)
}

/// Names in a sentence: `a`, `b` or `c`.
pub(crate) fn one_of(names: &[&str]) -> String {
    let quoted: Vec<String> = names.iter().map(|name| format!("`{name}`")).collect();
    match quoted.split_last() {
        None => "nothing".to_owned(),
        Some((last, [])) => last.clone(),
        Some((last, rest)) => format!("{} or {last}", rest.join(", ")),
    }
}

/// The sentence and the help for a name that none of `expected` is.
pub(crate) fn unknown_name(what: &str, found: &str, expected: &[&str]) -> (String, String) {
    let hint = suggest(found, expected.iter().copied());
    let hint = hint.map_or_else(String::new, |name| format!(", did you mean `{name}`?"));
    (format!("unknown {what} `{found}`{hint}"), format!("expected {}", one_of(expected)))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn misspelt_names_find_the_nearest() {
        let effects = ["viscous_friction", "coulomb_friction", "payload"];
        assert_eq!(suggest("columb_friction", effects), Some("coulomb_friction"));
        assert_eq!(suggest("Coulomb-Friction", effects), Some("coulomb_friction"));
        assert_eq!(suggest("coulomb", effects), Some("coulomb_friction"));
        assert_eq!(suggest("payloads", effects), Some("payload"));
        assert_eq!(suggest("joint_2", ["joint_1", "joint_3", "joint2"]), Some("joint_1"));
    }

    #[test]
    fn names_that_are_far_away_are_not_suggested() {
        for found in ["", "p", "friction", "co", "duration_s"] {
            assert_eq!(suggest(found, ["viscous_friction", "payload", "mass"]), None, "{found}");
        }
    }

    #[test]
    fn names_are_listed_as_in_a_sentence() {
        assert_eq!(one_of(&[]), "nothing");
        assert_eq!(one_of(&["a"]), "`a`");
        assert_eq!(one_of(&["a", "b", "c"]), "`a`, `b` or `c`");
    }
}
