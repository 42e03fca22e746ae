use catalogue::EffectKind;

use crate::error::CliError;

/// The effect of a name or a code.
///
/// # Errors
///
/// [`CliError::UnknownEffect`], with names that are near.
pub fn find_effect(name: &str) -> Result<EffectKind, CliError> {
    let plain = name.to_lowercase().replace(['-', ' '], "_");
    plain.parse().map_err(|_| {
        let name_with_code = |kind: &EffectKind| format!("{} {kind}", kind.code());
        let near = EffectKind::ALL.iter().filter(|kind| is_near(&plain, kind.name()));
        let near: Vec<String> = near.map(name_with_code).collect();
        let hint = if near.is_empty() {
            "a name such as coulomb_friction or a code such as FR02 was expected".to_owned()
        } else {
            format!("did you mean {}?", near.join(" or "))
        };
        CliError::UnknownEffect { name: name.to_owned(), hint }
    })
}

/// Whether `typed` is a misspelt `name` or one of its words.
fn is_near(typed: &str, name: &str) -> bool {
    let mut words = std::iter::once(name).chain(name.split('_'));
    words.any(|word| 3 * strsim::damerau_levenshtein(typed, word) <= word.len())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_effect_that_is_none_is_told_in_one_line() {
        let error_of = |name| find_effect(name).unwrap_err().to_string();
        let expected = "effect FR99: it is not in the catalogue, \
                        a name such as coulomb_friction or a code such as FR02 was expected";
        assert_eq!(error_of("FR99"), expected);
        assert!(
            error_of("coulomb").ends_with("did you mean FR02 coulomb_friction?"),
            "{}",
            error_of("coulomb")
        );
    }
}
