/// The candidate most similar to a name; `None` when all are too different.
pub(crate) fn nearest<'a>(name: &str, candidates: impl Iterator<Item = &'a str>) -> Option<String> {
    // At least six letters in ten unchanged: `joint_2` finds `joint2`, not `time`.
    const SIMILAR: f64 = 0.6;
    candidates
        .map(|c| (strsim::normalized_damerau_levenshtein(name, c), c))
        .filter(|(similarity, _)| *similarity >= SIMILAR)
        .max_by(|a, b| a.0.total_cmp(&b.0))
        .map(|(_, c)| c.to_owned())
}
