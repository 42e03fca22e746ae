use std::fmt;
use std::ops::Range;
use std::str::FromStr;

use toml::de::{DeTable, DeValue};

use crate::DocumentError;

/// One step into a document.
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Segment {
    /// The key of a table.
    Key(String),
    /// The place in an array, from 0.
    Index(usize),
}

/// Where a value stands in a document, such as `effect.0.coulomb_friction.level_nm`.
///
/// Written as a dotted TOML key. Bare digits are the place in an array, from 0; a key that
/// holds other characters than letters, digits, `-` and `_`, or that is a number, is quoted.
///
/// ```
/// use document::KeyPath;
///
/// let path: KeyPath = r#"start."arm/joint.1".0"#.parse()?;
/// assert_eq!(path, KeyPath::root().key("start").key("arm/joint.1").index(0));
/// assert_eq!(path.to_string(), r#"start."arm/joint.1".0"#);
/// # Ok::<(), document::DocumentError>(())
/// ```
#[derive(Debug, Clone, PartialEq, Eq, PartialOrd, Ord, Hash, Default)]
pub struct KeyPath(Vec<Segment>);

impl KeyPath {
    /// The document itself.
    #[must_use]
    pub fn root() -> Self {
        Self::default()
    }

    /// The value of `key` in the table that stands here.
    #[must_use]
    pub fn key(&self, key: impl Into<String>) -> Self {
        self.then(Segment::Key(key.into()))
    }

    /// The value at `index`, from 0, in the array that stands here.
    #[must_use]
    pub fn index(&self, index: usize) -> Self {
        self.then(Segment::Index(index))
    }

    /// The steps from the document to the value.
    #[must_use]
    pub fn segments(&self) -> &[Segment] {
        &self.0
    }

    fn then(&self, segment: Segment) -> Self {
        Self(self.0.iter().cloned().chain([segment]).collect())
    }
}

impl FromIterator<Segment> for KeyPath {
    fn from_iter<I: IntoIterator<Item = Segment>>(segments: I) -> Self {
        Self(segments.into_iter().collect())
    }
}

impl fmt::Display for KeyPath {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        for (i, segment) in self.0.iter().enumerate() {
            let dot = if i == 0 { "" } else { "." };
            write!(f, "{dot}{segment}")?;
        }
        Ok(())
    }
}

impl fmt::Display for Segment {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::Index(index) => write!(f, "{index}"),
            Self::Key(key) if is_bare(key) && as_index(key).is_none() => f.write_str(key),
            Self::Key(key) => write!(f, "{}", Quoted(key)),
        }
    }
}

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

/// A string as TOML writes it, which shows control characters by their number.
pub(crate) struct Quoted<'a>(pub(crate) &'a str);

impl fmt::Display for Quoted<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("\"")?;
        for c in self.0.chars() {
            match c {
                '"' => f.write_str("\\\"")?,
                '\\' => f.write_str("\\\\")?,
                '\n' => f.write_str("\\n")?,
                '\t' => f.write_str("\\t")?,
                '\r' => f.write_str("\\r")?,
                c if c.is_control() => write!(f, "\\u{:04X}", u32::from(c))?,
                c => write!(f, "{c}")?,
            }
        }
        f.write_str("\"")
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
        .map_err(|error| (clamped(error.span(), text), crate::error::syntax(&error)))?
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

fn clamped(span: Option<Range<usize>>, text: &str) -> Range<usize> {
    let span = span.unwrap_or(0..text.len());
    span.start.min(text.len())..span.end.min(text.len())
}

fn is_bare(key: &str) -> bool {
    !key.is_empty() && key.chars().all(|c| c.is_ascii_alphanumeric() || c == '-' || c == '_')
}

/// The number that is written exactly so.
fn as_index(text: &str) -> Option<usize> {
    text.parse().ok().filter(|index: &usize| index.to_string() == text)
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
            let path = KeyPath(segments);
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
