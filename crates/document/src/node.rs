use std::collections::BTreeMap;
use std::ops::Range;
use std::sync::Arc;

use toml::Spanned;
use toml::de::{DeInteger, DeTable, DeValue};
use toml::value::Datetime;

use crate::key_path::{Quoted, Segment};
use crate::source::{SourceSpan, TextSource};

/// Deepest nesting of tables and arrays.
pub(crate) const DEEPEST: usize = 128;

/// A value, and the text it comes from.
#[derive(Debug, Clone)]
pub(crate) struct Node {
    pub value: Value,
    pub source: Arc<TextSource>,
    /// The span of its key; in an array, the span of the value itself.
    pub key: Range<usize>,
    /// The value; for a table under a header, the header.
    pub span: Range<usize>,
}

#[derive(Debug, Clone)]
pub(crate) enum Value {
    String(String),
    Integer(i64),
    Float(f64),
    Boolean(bool),
    Date(Datetime),
    Array(Vec<Node>),
    Table(BTreeMap<String, Node>),
}

/// What is wrong with a text, and where.
pub(crate) type Wrong = (Range<usize>, String);

impl Node {
    /// The document that a text holds.
    pub(crate) fn document(source: &Arc<TextSource>) -> Result<Self, Wrong> {
        let table = DeTable::parse(&source.text).map_err(syntax)?;
        let root = Layer { source, offset: 0 };
        root.table(table.into_inner(), DEEPEST).map(|value| root.node(value, 0..0, 0..0))
    }

    /// The value written at `span` of a text.
    pub(crate) fn value_at(source: &Arc<TextSource>, span: Range<usize>) -> Result<Self, Wrong> {
        let layer = Layer { source, offset: span.start };
        let there = |range| layer.shift(range);
        let text = source.text.get(span.clone()).unwrap_or_default();
        let value = DeValue::parse(text)
            .map_err(syntax)
            .map_err(|(range, reason)| (there(range), reason))?;
        layer.read(value, None, DEEPEST)
    }

    /// This value with another laid over it: tables key by key, anything else replaced.
    pub(crate) fn extend_by(self, over: Self) -> Self {
        match (self.value, over.value) {
            (Value::Table(mut table), Value::Table(entries)) => {
                for (key, entry) in entries {
                    let merged = match table.remove(&key) {
                        Some(below) => below.extend_by(entry),
                        None => entry,
                    };
                    table.insert(key, merged);
                }
                Self { value: Value::Table(table), ..over }
            }
            (_, value) => Self { value, ..over },
        }
    }

    /// The value at `path`, or the innermost one on the way that is there.
    pub(crate) fn nearest(&self, path: &[Segment]) -> &Self {
        let Some((first, rest)) = path.split_first() else { return self };
        self.child(first).map_or(self, |child| child.nearest(rest))
    }

    pub(crate) fn child(&self, segment: &Segment) -> Option<&Self> {
        match (&self.value, segment) {
            (Value::Table(table), Segment::Key(key)) => table.get(key),
            (Value::Array(array), Segment::Index(index)) => array.get(*index),
            _ => None,
        }
    }

    /// Where the value stands.
    pub(crate) fn place(&self) -> SourceSpan {
        SourceSpan::new(&self.source, self.span.clone())
    }

    /// Where its key stands.
    pub(crate) fn key_place(&self) -> SourceSpan {
        SourceSpan::new(&self.source, self.key.clone())
    }

    /// What is there, for a sentence that says what was found.
    pub(crate) fn describe(&self) -> String {
        match &self.value {
            Value::String(text) => quote(text),
            Value::Integer(number) => number.to_string(),
            Value::Float(number) => format!("{number:?}"),
            Value::Boolean(value) => value.to_string(),
            Value::Date(date) => format!("the date {date}"),
            Value::Array(array) => format!("an array of {}", array.len()),
            Value::Table(_) => "a table".to_owned(),
        }
    }

    /// The value without where it comes from.
    pub(crate) fn to_toml(&self) -> toml::Value {
        match &self.value {
            Value::String(text) => toml::Value::String(text.clone()),
            Value::Integer(number) => toml::Value::Integer(*number),
            Value::Float(number) => toml::Value::Float(*number),
            Value::Boolean(value) => toml::Value::Boolean(*value),
            Value::Date(date) => toml::Value::Datetime(*date),
            Value::Array(array) => toml::Value::Array(array.iter().map(Self::to_toml).collect()),
            Value::Table(table) => {
                let entries = table.iter().map(|(key, node)| (key.clone(), node.to_toml()));
                toml::Value::Table(entries.collect())
            }
        }
    }
}

/// A string in a sentence, cut after what fits there.
pub(crate) fn quote(text: &str) -> String {
    const LONGEST: usize = 40;
    match text.char_indices().nth(LONGEST) {
        Some((end, _)) => format!("the string {}...", Quoted(&text[..end])),
        None => format!("the string {}", Quoted(text)),
    }
}

fn syntax(error: toml::de::Error) -> Wrong {
    (error.span().unwrap_or_default(), crate::error::syntax(&error))
}

/// What turns parsed values into nodes: a text, and where in it the parser began.
struct Layer<'a> {
    source: &'a Arc<TextSource>,
    offset: usize,
}

impl Layer<'_> {
    fn read(
        &self,
        value: Spanned<DeValue<'_>>,
        key: Option<Range<usize>>,
        depth: usize,
    ) -> Result<Node, Wrong> {
        let span = self.shift(value.span());
        let Some(depth) = depth.checked_sub(1) else {
            return Err((span, format!("expected at most {DEEPEST} levels, found more")));
        };
        let beyond = |expected: &str, digits: String| {
            (span.clone(), format!("expected a {expected}, found {digits}"))
        };
        let value = match value.into_inner() {
            DeValue::String(text) => Value::String(text.into_owned()),
            DeValue::Integer(digits) => integer(&digits)
                .map(Value::Integer)
                .ok_or_else(|| beyond("whole number of 64 bits", digits.to_string()))?,
            DeValue::Float(digits) => float(digits.as_str())
                .map(Value::Float)
                .ok_or_else(|| beyond("number below 1.8e308", digits.to_string()))?,
            DeValue::Boolean(value) => Value::Boolean(value),
            DeValue::Datetime(date) => Value::Date(date),
            DeValue::Array(array) => {
                let nodes = array.into_iter().map(|entry| self.read(entry, None, depth));
                Value::Array(nodes.collect::<Result<_, _>>()?)
            }
            DeValue::Table(table) => self.table(table, depth)?,
        };
        let key = key.unwrap_or_else(|| span.clone());
        Ok(self.node(value, key, span))
    }

    fn table(&self, table: DeTable<'_>, depth: usize) -> Result<Value, Wrong> {
        let entries = table.into_iter().map(|(key, value)| {
            let node = self.read(value, Some(self.shift(key.span())), depth)?;
            Ok((key.into_inner().into_owned(), node))
        });
        Ok(Value::Table(entries.collect::<Result<_, _>>()?))
    }

    fn node(&self, value: Value, key: Range<usize>, span: Range<usize>) -> Node {
        Node { value, source: Arc::clone(self.source), key, span }
    }

    fn shift(&self, span: Range<usize>) -> Range<usize> {
        span.start + self.offset..span.end + self.offset
    }
}

fn integer(digits: &DeInteger<'_>) -> Option<i64> {
    i64::from_str_radix(digits.as_str(), digits.radix()).ok()
}

/// A number that is infinite only where the text says so.
fn float(digits: &str) -> Option<f64> {
    let number: f64 = digits.parse().ok()?;
    (number.is_finite() || digits.contains(['i', 'n'])).then_some(number)
}
