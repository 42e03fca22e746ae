use std::fmt;

use serde::de::{self, Expected, Unexpected};

use crate::error::DocumentError;
use crate::key_path::{KeyPath, Segment};
use crate::names::unknown_name;
use crate::node::{Node, quote};

/// What is wrong with a value, as its type reports it. The place is added while the error leaves
/// the document.
#[derive(Debug)]
pub(crate) struct Fault {
    message: String,
    help: Option<String>,
    /// The way from the document to the value, the last step first.
    way_out: Vec<Segment>,
    part: Part,
}

/// What is underlined.
#[derive(Debug, Clone, Copy)]
enum Part {
    Key,
    Value,
}

impl Fault {
    pub(crate) fn new(message: String, help: Option<String>) -> Self {
        Self { message, help, way_out: Vec::new(), part: Part::Value }
    }

    /// The same fault, in the entry of a table or array.
    pub(crate) fn inside(mut self, segment: Segment) -> Self {
        self.way_out.push(segment);
        self
    }

    /// The same fault, in the key of an entry.
    pub(crate) fn in_key(self, key: &str) -> Self {
        Self { part: Part::Key, ..self.inside(Segment::Key(key.to_owned())) }
    }

    /// The fault with the place that it has in a document.
    pub(crate) fn locate(self, root: &Node) -> DocumentError {
        let path: KeyPath = self.way_out.into_iter().rev().collect();
        let node = root.nearest(path.segments());
        let place = match self.part {
            Part::Key => node.key_place(),
            Part::Value => node.place(),
        };
        DocumentError::at(place, path, &self.message, self.help)
    }

    pub(crate) fn mismatch(expected: &str, found: &str) -> Self {
        Self::new(format!("expected {expected}, found {found}"), None)
    }
}

impl de::Error for Fault {
    fn custom<T: fmt::Display>(message: T) -> Self {
        Self::new(message.to_string(), None)
    }

    fn invalid_type(found: Unexpected<'_>, expected: &dyn Expected) -> Self {
        Self::mismatch(&in_words(expected), &describe(found))
    }

    fn invalid_value(found: Unexpected<'_>, expected: &dyn Expected) -> Self {
        Self::mismatch(&in_words(expected), &describe(found))
    }

    fn invalid_length(length: usize, expected: &dyn Expected) -> Self {
        Self::mismatch(&in_words(expected), &format!("an array of {length}"))
    }

    fn unknown_variant(found: &str, expected: &'static [&'static str]) -> Self {
        let (message, help) = unknown_name("name", found, expected);
        Self::new(message, Some(help))
    }

    fn unknown_field(found: &str, expected: &'static [&'static str]) -> Self {
        let (message, help) = unknown_name("key", found, expected);
        Self::new(message, Some(help))
    }

    fn missing_field(field: &'static str) -> Self {
        Self::new(format!("`{field}` is missing"), None)
    }
}

impl de::StdError for Fault {}

impl fmt::Display for Fault {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(&self.message)
    }
}

/// What serde found, as TOML calls it.
fn describe(found: Unexpected<'_>) -> String {
    match found {
        Unexpected::Bool(value) => value.to_string(),
        Unexpected::Signed(number) => number.to_string(),
        Unexpected::Unsigned(number) => number.to_string(),
        Unexpected::Float(number) => format!("{number:?}"),
        Unexpected::Str(text) => quote(text),
        Unexpected::Seq => "an array".to_owned(),
        Unexpected::Map => "a table".to_owned(),
        Unexpected::UnitVariant => "its name alone".to_owned(),
        other => other.to_string(),
    }
}

/// What serde and the types of Rust expect, as TOML calls it.
fn in_words(expected: &dyn Expected) -> String {
    let expected = expected.to_string();
    let words = match expected.as_str() {
        "f32" | "f64" => "a number",
        "i8" | "i16" | "i32" | "i64" | "i128" | "isize" => "a whole number",
        "u8" => "a whole number from 0 to 255",
        "u16" => "a whole number from 0 to 65535",
        "u32" => "a whole number from 0 to 4294967295",
        "u64" | "u128" | "usize" => "a whole number from 0 on",
        "a boolean" => "true or false",
        "a sequence" => "an array",
        "a map" | "newtype variant" | "struct variant" | "tuple variant" => "a table",
        "unit variant" => "its name alone",
        other => match length(other) {
            Some(length) => return format!("an array of {length}"),
            None if other.starts_with("struct ") => "a table",
            None => return expected,
        },
    };
    words.to_owned()
}

/// How many values serde expects in a row, where it says so.
fn length(expected: &str) -> Option<&str> {
    let starts = ["a tuple of size ", "an array of length "];
    let counted = expected.strip_suffix(" elements").or(expected.strip_suffix(" element"));
    let counted = counted.and_then(|start| start.rsplit_once(" with "));
    let after = |start: &&str| expected.strip_prefix(*start);
    starts.iter().find_map(after).or(counted.map(|(_, count)| count))
}
