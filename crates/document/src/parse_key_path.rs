use std::ops::Range;
use std::str::FromStr;

use toml::de::{DeTable, DeValue};

use crate::error::{DocumentError, syntax};
use crate::key_path::{KeyPath, Segment, as_index};

impl FromStr for KeyPath {
    type Err = DocumentError;

    fn from_str(text: &str) -> Result<Self, DocumentError> {
        let segments = parse(text).map_err(|(span, reason)| DocumentError::NotAKeyPath {
            text: text.to_owned(),
            column: text.get(..span.start).unwrap_or(text).chars().count() + 1,
            reason,
        })?;
        Ok(segments.into_iter().map(|(segment, _)| segment).collect())
    }
}

/// The segments of a written path, each with where it stands, or what is wrong and where.
pub(crate) type Parsed = Result<Vec<(Segment, Range<usize>)>, (Range<usize>, String)>;

/// Reads a path with the TOML parser, as the key of `path = 0`.
pub(crate) fn parse(text: &str) -> Parsed {
    let everything = 0..text.len();
    let one_path = "one path was expected, such as `effect.0.delay_s`";
    // A line break, a comment or a value would make it more than a key.
    if text.contains(['\n', '\r']) {
        return Err((everything, one_path.to_owned()));
    }
    let assignment = format!("{text}=0");
    let mut table = DeTable::parse(&assignment)
        .map_err(|error| (clamp(error.span(), text), syntax(&error)))?
        .into_inner();
    let mut segments = Vec::new();
    loop {
        let mut entries = table.into_iter();
        let (Some((key, value)), None) = (entries.next(), entries.next()) else {
            return Err((everything, one_path.to_owned()));
        };
        let index = text.get(key.span()).and_then(as_index);
        let segment = index.map_or_else(|| Segment::Key(key.get_ref().to_string()), Segment::Index);
        segments.push((segment, key.span()));
        let end = value.span().start;
        match value.into_inner() {
            DeValue::Table(inner) => table = inner,
            DeValue::Integer(_) if end > text.len() => return Ok(segments),
            _ => return Err((everything, one_path.to_owned())),
        }
    }
}

fn clamp(span: Option<Range<usize>>, text: &str) -> Range<usize> {
    let span = span.unwrap_or(0..text.len());
    span.start.min(text.len())..span.end.min(text.len())
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;

    fn segment() -> impl Strategy<Value = Segment> {
        prop_oneof![any::<usize>().prop_map(Segment::Index), any::<String>().prop_map(Segment::Key)]
    }

    proptest! {
        #[test]
        fn a_written_path_is_read_as_the_same_path(
            segments in prop::collection::vec(segment(), 1..6),
        ) {
            let path: KeyPath = segments.into_iter().collect();
            prop_assert_eq!(path.to_string().parse(), Ok(path));
        }

        #[test]
        fn any_text_is_a_path_or_an_error(text in "[a-z0-9.\"'\\\\=# \\[\\]{}\n]{0,12}") {
            let _ = text.parse::<KeyPath>();
        }
    }

    #[test]
    fn digits_are_an_index_and_quoted_digits_a_key() {
        let path: KeyPath = "a.0.\"0\".'x.y'.007".parse().unwrap();
        let expected = KeyPath::root().key("a").index(0).key("0").key("x.y").key("007");
        assert_eq!(path, expected);
        assert_eq!(path.to_string(), "a.0.\"0\".\"x.y\".007");
    }

    #[test]
    fn what_is_more_than_a_path_is_refused() {
        for text in ["", "a..b", ".a", "a b", "a=1 #", "[a] #", "[a]\nb", "a/b", "'a", "a[0]"] {
            let error = text.parse::<KeyPath>();
            assert!(matches!(error, Err(DocumentError::NotAKeyPath { .. })), "{text}: {error:?}");
        }
        assert_eq!(
            "a.b/c".parse::<KeyPath>().unwrap_err().to_string(),
            "key path a.b/c, column 4: invalid unquoted key, expected letters, numbers, `-`, `_`"
        );
    }
}
