use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

use crate::error::DocumentError;
use crate::key_path::{KeyPath, Quoted, Segment};
use crate::node::{Node, Value, Wrong};
use crate::parse_key_path;
use crate::read::EXTENDS;
use crate::source::{SourceSpan, TextOrigin, TextSource};

/// A step of a written path, and where it stands in the text.
type Step = (Segment, Range<usize>);

/// Puts the value of `path=value` into a document.
pub(crate) fn set(root: &mut Node, assignment: &str) -> Result<(), DocumentError> {
    let source =
        Arc::new(TextSource { origin: TextOrigin::Assignment, text: assignment.to_owned() });
    let (steps, value) = parse_assignment(&source).map_err(|wrong| mistake(&source, wrong))?;
    put(root, &steps, value).map_err(|wrong| mistake(&source, wrong))
}

fn mistake(source: &Arc<TextSource>, (span, message): Wrong) -> DocumentError {
    DocumentError::at(SourceSpan::new(source, span), KeyPath::root(), &message, None)
}

fn parse_assignment(source: &Arc<TextSource>) -> Result<(Vec<Step>, Node), Wrong> {
    let text = &source.text;
    let form = "expected `path=value`, such as `effect.0.delay_s=0.002`";
    let equals = equals_sign(text).ok_or_else(|| (0..text.len(), form.to_owned()))?;
    let steps = parse_key_path::parse(&text[..equals])?;
    if matches!(steps.first(), Some((Segment::Key(key), _)) if key == EXTENDS) {
        return Err((steps[0].1.clone(), "`extends` belongs into a file".to_owned()));
    }
    let after = &text[equals + 1..];
    let start = text.len() - after.trim_start().len();
    let span = start..start + after.trim().len();
    if span.is_empty() {
        return Err((span, "expected a value, an empty string is written `\"\"`".to_owned()));
    }
    let last = steps.last().map_or(0..0, |(_, span)| span.clone());
    let mut value = match Node::value_at(source, span.clone()) {
        Err(_) if !text[span.clone()].starts_with(['"', '\'', '[', '{']) => {
            let value = Value::String(text[span.clone()].to_owned());
            Node { value, source: Arc::clone(source), key: 0..0, span }
        }
        read => read?,
    };
    value.key = last;
    Ok((steps, value))
}

/// The first `=` that is not part of a quoted key.
fn equals_sign(text: &str) -> Option<usize> {
    let mut quote = None;
    let mut escaped = false;
    for (at, c) in text.char_indices() {
        match quote {
            None if c == '=' => return Some(at),
            None if c == '"' || c == '\'' => quote = Some(c),
            Some(open) if c == open && !escaped => quote = None,
            _ => {}
        }
        escaped = quote == Some('"') && c == '\\' && !escaped;
    }
    None
}

/// Goes down `steps` and puts the value at the end, with tables where nothing stands.
fn put(node: &mut Node, steps: &[Step], value: Node) -> Result<(), Wrong> {
    let Some(((segment, span), rest)) = steps.split_first() else {
        *node = value;
        return Ok(());
    };
    let described = node.describe();
    let wrong = |message: String| Err((span.clone(), message));
    match (&mut node.value, segment) {
        (Value::Table(table), Segment::Key(key)) => match table.get_mut(key) {
            Some(entry) => put(entry, rest, value),
            None => {
                table.insert(key.clone(), in_tables(rest, span, value)?);
                Ok(())
            }
        },
        (Value::Array(array), Segment::Index(index)) => {
            let length = array.len();
            match array.get_mut(*index) {
                Some(entry) => put(entry, rest, value),
                None => wrong(format!("index {index} is past the end of an array of {length}")),
            }
        }
        (_, Segment::Key(key)) => {
            wrong(format!("key {} needs a table, found {described}", Quoted(key)))
        }
        (_, Segment::Index(index)) => {
            wrong(format!("index {index} needs an array, found {described}"))
        }
    }
}

/// The value inside new tables, the outermost of which has its key at `key`.
fn in_tables(steps: &[Step], key: &Range<usize>, value: Node) -> Result<Node, Wrong> {
    let Some(((segment, span), rest)) = steps.split_first() else { return Ok(value) };
    let Segment::Key(name) = segment else {
        return Err((span.clone(), format!("index {segment} needs an array, found nothing")));
    };
    let source = Arc::clone(&value.source);
    let inner = BTreeMap::from([(name.clone(), in_tables(rest, span, value)?)]);
    Ok(Node { value: Value::Table(inner), source, key: key.clone(), span: key.clone() })
}

#[cfg(test)]
mod tests {
    use std::path::Path;

    use crate::document::Document;
    use crate::key_path::KeyPath;

    const TEXT: &str = "name = \"a\"\n[[effect]]\npayload.mass_kg = 1\n[joint.\"a.b\"]\nx = 1\n";

    /// The document after an assignment, and the assignment's value in it.
    fn after(assignment: &str, path: &str) -> (Document, String) {
        let mut document = Document::from_text("a.toml", TEXT).unwrap();
        document.set(assignment).unwrap();
        let path: KeyPath = path.parse().unwrap();
        let value = document.root.nearest(path.segments()).to_toml().to_string();
        (document, value)
    }

    #[test]
    fn a_value_is_toml_or_else_a_bare_string() {
        for (text, value) in [
            ("0.6", "0.6"),
            (" 3 ", "3"),
            ("true", "true"),
            ("[1, 2]", "[1, 2]"),
            ("\"3\"", "\"3\""),
            ("'a=b'", "\"a=b\""),
            ("robots/wam7", "\"robots/wam7\""),
            ("a b=c", "\"a b=c\""),
            ("0.6 nm", "\"0.6 nm\""),
            ("1.2.3", "\"1.2.3\""),
        ] {
            assert_eq!(after(&format!("name={text}"), "name").1, value);
        }
    }

    #[test]
    fn a_path_goes_through_arrays_and_quoted_keys_and_makes_tables() {
        let path = "effect.0.payload.mass_kg";
        assert_eq!(after(&format!("{path}=2"), path).1, "2");
        assert_eq!(after("joint.\"a.b\".x=2", "joint.\"a.b\".x").1, "2");
        assert_eq!(after("joint.'a=b'.x=2", "joint.\"a=b\".x").1, "2");
        assert_eq!(after(r#"joint."\"=".x=2"#, r#"joint."\"=".x"#).1, "2");
        let (document, value) = after("new.table.key=2", "new.table.key");
        assert_eq!(value, "2");
        assert!(document.to_toml().contains("[new.table]\nkey = 2\n"));
        assert_eq!(document.directory_of(&KeyPath::root().key("new")), Path::new(""));
        // What is set replaces a table, it is not merged into it.
        assert_eq!(after("joint={ c = 1 }", "joint").1, "{ c = 1 }");
    }

    #[test]
    fn what_cannot_be_set_is_underlined_and_leaves_the_document_as_it_was() {
        let cases = [
            ("", "", "expected `path=value`"),
            ("name", "name", "expected `path=value`"),
            ("name=", "", "expected a value"),
            ("=3", "", "unquoted keys cannot be empty"),
            ("a/b=3", "/", "invalid unquoted key"),
            ("name.x=3", "x", "key \"x\" needs a table, found the string \"a\""),
            ("effect.x=3", "x", "key \"x\" needs a table, found an array of 1"),
            ("effect.1.x=3", "1", "index 1 is past the end of an array of 1"),
            ("joint.0=3", "0", "index 0 needs an array, found a table"),
            ("new.0.x=3", "0", "index 0 needs an array, found nothing"),
            ("extends=\"b.toml\"", "extends", "`extends` belongs into a file"),
            ("name=[1,", "", "unclosed array"),
            ("name='a", "", "invalid literal string"),
        ];
        for (assignment, underlined, message) in cases {
            let mut document = Document::from_text("a.toml", TEXT).unwrap();
            let before = document.to_toml();
            let error = document.set(assignment).unwrap_err();
            assert_eq!(error.place().unwrap().text(), underlined, "{error}");
            assert!(error.to_string().contains(message), "{error}");
            assert_eq!(document.to_toml(), before);
        }
    }
}
