use std::path::{Path, PathBuf};
use std::sync::Arc;

use serde::de::DeserializeOwned;

use crate::error::DocumentError;
use crate::key_path::{KeyPath, Segment};
use crate::names::unknown_name;
use crate::node::{Node, Value};
use crate::source::{TextOrigin, TextSource};
use crate::{read, set};

/// A TOML document, every value of which knows the file, line and column it comes from.
///
/// A file may extend others, `extends = "base.toml"` or a list of which later ones count
/// more, with paths relative to the file that says so. What the file says itself counts
/// most: tables are merged key by key, anything else is replaced, lists of tables as a whole.
///
/// ```
/// use document::Document;
///
/// #[derive(serde::Deserialize)]
/// #[serde(deny_unknown_fields)]
/// struct Friction {
///     level_nm: f64,
/// }
///
/// let mut document = Document::from_text("friction.toml", "level_nm = 0.4")?;
/// document.set("level_nm=0.6")?;
/// let friction: Friction = document.parse()?;
/// assert_eq!(friction.level_nm, 0.6);
///
/// let document = Document::from_text("friction.toml", "level = 0.4")?;
/// let mistake = document.parse::<Friction>().err().map(|error| error.to_string());
/// assert_eq!(
///     mistake.as_deref(),
///     Some("friction.toml:1:1: level: unknown key `level`, did you mean `level_nm`?")
/// );
/// # Ok::<(), document::DocumentError>(())
/// ```
#[derive(Debug, Clone)]
pub struct Document {
    pub(crate) root: Node,
}

impl Document {
    /// Reads a file and the files it extends.
    ///
    /// # Errors
    ///
    /// - [`DocumentError::Unreadable`] when the file is none, is not UTF-8, has more than 16 MiB with the
    ///   files that it extends, or is no TOML under a name that does not end with `.toml`.
    /// - [`DocumentError::Mistake`] when a text is not TOML, or when a file that is extended
    ///   cannot be read, extends itself, or is the 17th in a row or the 257th in all.
    pub fn read(path: impl AsRef<Path>) -> Result<Self, DocumentError> {
        read::read(path.as_ref()).map(|root| Self { root })
    }

    /// Reads the file that this document names at `key`, relative to the folder of the file in which the name stands,
    /// and the files that it extends. Gives its path too.
    ///
    /// # Errors
    ///
    /// [`DocumentError::Mistake`], at the key for a file that cannot be read, is no TOML or is this document itself,
    /// and in the file for a mistake of what it extends.
    pub fn read_named(
        &self,
        key: &KeyPath,
        named: &Path,
    ) -> Result<(Self, PathBuf), DocumentError> {
        let file = self.directory_of(key).join(named);
        let refuse = |reason| self.mistake(key, format!("{}: {reason}", file.display()), None);
        let root = read::read_named(&file, self.root.source.file()).map_err(refuse)??;
        Ok((Self { root }, file))
    }

    /// Reads a text of the program's own; mistakes show it under `name`.
    ///
    /// # Errors
    ///
    /// [`DocumentError::Mistake`] when the text is not TOML, or extends files: it has no
    /// folder to look for them.
    pub fn from_text(name: &str, text: &str) -> Result<Self, DocumentError> {
        let origin = TextOrigin::Text(name.to_owned());
        let source = Arc::new(TextSource { origin, text: text.to_owned() });
        let mut root = read::parse(&source)?;
        match read::take_extends(&mut root) {
            None => Ok(Self { root }),
            Some(extends) => {
                let path = KeyPath::root().key(read::EXTENDS);
                let message = "nothing can be extended here";
                Err(DocumentError::at(extends.key_place(), path, message, None))
            }
        }
    }

    /// Puts the value of `path=value` into the document, in place of what is there.
    ///
    /// The path is a [`KeyPath`]; the value is TOML, or else a string as it stands, unless it
    /// begins with a quote or bracket. Missing tables on the path are created.
    ///
    /// # Errors
    ///
    /// [`DocumentError::Mistake`] when the text is not of that form, the path goes through
    /// something that is no table or array, an index is past the end of its array, or the
    /// path is `extends`.
    pub fn set(&mut self, assignment: &str) -> Result<(), DocumentError> {
        set::set(&mut self.root, assignment)
    }

    /// The document as a value of type `T`.
    ///
    /// Enumerations are best written the way serde does without attributes, `coulomb_friction = {
    /// level_nm = 0.6 }`: serde buffers the values of `tag`, `untagged` and `flatten` before it
    /// knows their type, and a mistake in them is shown at the table around. No type takes a date.
    ///
    /// # Errors
    ///
    /// [`DocumentError::Mistake`] at the first value that `T` does not take, the first key
    /// that it does not know, or the table in which it misses one.
    pub fn parse<T: DeserializeOwned>(&self) -> Result<T, DocumentError> {
        T::deserialize(&self.root).map_err(|fault| fault.locate(&self.root))
    }

    /// A mistake that only the meaning of a value shows.
    ///
    /// It is shown at the value at `path` or, where nothing stands, at the innermost table or
    /// array around. `message` says what was found and what was expected, `help` what may be
    /// done.
    #[must_use]
    pub fn mistake(
        &self,
        path: &KeyPath,
        message: impl Into<String>,
        help: Option<String>,
    ) -> DocumentError {
        let place = self.root.nearest(path.segments()).place();
        DocumentError::at(place, path.clone(), &message.into(), help)
    }

    /// The mistake of a name `found` at `path` that is not among the `expected` ones.
    ///
    /// It is shown at the value at `path` where `found` is that value, and at the key where
    /// `found` is the key at the end of `path`. `what` says what the names are, such as
    /// `joint`.
    #[must_use]
    pub fn unknown_name(
        &self,
        path: &KeyPath,
        what: &str,
        found: &str,
        expected: &[&str],
    ) -> DocumentError {
        let (message, help) = unknown_name(what, found, expected);
        let node = self.root.nearest(path.segments());
        let is_value = matches!(&node.value, Value::String(text) if text == found);
        let is_key = matches!(path.segments().last(), Some(Segment::Key(key)) if key == found);
        let place = if is_key && !is_value { node.key_place() } else { node.place() };
        DocumentError::at(place, path.clone(), &message, Some(help))
    }

    /// The folder that a path written at `path` is relative to: that of the file the value
    /// comes from, empty (the current folder) for a value that comes from no file.
    ///
    /// Where nothing stands at `path`, it is that of the innermost table or array around.
    #[must_use]
    pub fn directory_of(&self, path: &KeyPath) -> &Path {
        self.root.nearest(path.segments()).source.folder()
    }

    /// The whole document as one TOML text that extends nothing, keys in alphabetical order.
    #[must_use]
    pub fn to_toml(&self) -> String {
        match self.root.to_toml() {
            toml::Value::Table(table) => table.to_string(),
            other => other.to_string(),
        }
    }
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;
    use toml::{Table, Value};

    use super::*;
    use crate::error::Coloring;

    fn value() -> impl Strategy<Value = Value> {
        let leaf = prop_oneof![
            any::<String>().prop_map(Value::String),
            any::<i64>().prop_map(Value::Integer),
            (-1e300..1e300).prop_map(Value::Float),
            Just(Value::Float(f64::INFINITY)),
            any::<bool>().prop_map(Value::Boolean),
            Just(Value::Datetime("1979-05-27T07:32:00Z".parse().unwrap())),
        ];
        leaf.prop_recursive(4, 24, 4, |inner| {
            prop_oneof![
                prop::collection::vec(inner.clone(), 0..4).prop_map(Value::Array),
                prop::collection::vec((".{0,4}", inner), 0..4)
                    .prop_map(|entries| { Value::Table(entries.into_iter().collect()) }),
            ]
        })
    }

    /// What `toml` itself reads, `None` where it refuses.
    fn peer(text: &str) -> Option<Value> {
        text.parse::<Table>().ok().map(Value::Table)
    }

    proptest! {
        #[test]
        fn a_document_written_and_read_is_the_same(
            entries in prop::collection::vec(("[a-d]{1,2}", value()), 0..6),
        ) {
            let table: Table = entries.into_iter().collect();
            let document = Document::from_text("a", &table.to_string()).unwrap();
            prop_assert_eq!(document.root.to_toml(), Value::Table(table));
            let again = Document::from_text("b", &document.to_toml()).unwrap();
            prop_assert_eq!(again.root.to_toml(), document.root.to_toml());
            prop_assert_eq!(again.to_toml(), document.to_toml());
        }

        #[test]
        fn any_bytes_are_a_document_or_an_error(
            bytes in prop::collection::vec(any::<u8>(), 0..64),
        ) {
            let folder = tempfile::TempDir::new().unwrap();
            let path = folder.path().join("soup.toml");
            std::fs::write(&path, bytes).unwrap();
            if let Err(error) = Document::read(&path) {
                prop_assert!(!error.render(Coloring::Ansi).is_empty());
            }
        }

        #[test]
        fn any_soup_of_toml_is_read_as_toml_reads_it(
            text in "([a-c]|[.=,0-9\"'{}\\[\\]# \n\\\\é\u{1b}]|1e9|= \\[|\\[\\[a\\]\\]\n){0,24}",
        ) {
            match Document::from_text("soup", &text) {
                Ok(document) => {
                    prop_assert_eq!(Some(document.root.to_toml()), peer(&text));
                    if let Err(error) = document.parse::<std::collections::HashMap<String, u8>>() {
                        prop_assert!(error.render(Coloring::Plain).starts_with("error: "));
                    }
                }
                Err(error) => {
                    prop_assert_eq!(peer(&text), None);
                    prop_assert!(error.render(Coloring::Plain).starts_with("error: "));
                    prop_assert!(error.place().unwrap().span().end <= text.len());
                }
            }
            let mut document = Document::from_text("a", "a = [{ b = 1 }]").unwrap();
            if let Err(error) = document.set(&text) {
                prop_assert!(error.render(Coloring::Plain).starts_with("error: "));
            }
        }
    }
}
