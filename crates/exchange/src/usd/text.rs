use std::collections::BTreeSet;

use nalgebra::{Quaternion, UnitQuaternion, Vector3};

use crate::numbers::number;

/// Writes a text layer of Universal Scene Description.
#[derive(Debug, Default)]
pub struct UsdText {
    text: String,
    open: usize,
}

impl UsdText {
    /// A layer with lengths in metres and masses in kilograms, whose stage shows `root`.
    pub fn new(root: &str) -> Self {
        let head = format!(
            "#usda 1.0\n(\n    defaultPrim = \"{root}\"\n    kilogramsPerUnit = 1\n    metersPerUnit = 1\n    \
             upAxis = \"Z\"\n)\n"
        );
        Self { text: head, open: 0 }
    }

    /// Opens a prim of a type with applied schemas.
    pub fn open(&mut self, kind: &str, name: &str, schemas: &[String]) {
        self.line(&format!("def {kind} \"{name}\""));
        if !schemas.is_empty() {
            let quoted: Vec<String> = schemas.iter().map(|s| format!("\"{s}\"")).collect();
            let line = format!("    prepend apiSchemas = [{}]", quoted.join(", "));
            ["(", &line, ")"].iter().for_each(|line| self.line(line));
        }
        self.line("{");
        self.open += 1;
    }

    /// Closes the prim that was opened last.
    pub fn close(&mut self) {
        self.open = self.open.saturating_sub(1);
        self.line("}");
    }

    /// A property with its type and value.
    pub fn set(&mut self, property: &str, value: &str) {
        self.line(&format!("{property} = {value}"));
    }

    /// The original name of a prim.
    pub fn original_name(&mut self, name: &str) {
        self.set("custom string plumbline:name", &quote(name));
    }

    /// The text.
    pub fn finish(self) -> String {
        self.text
    }

    fn line(&mut self, line: &str) {
        self.text.push_str(&"    ".repeat(self.open));
        self.text.push_str(line);
        self.text.push('\n');
    }
}

/// A string on one line, in double quotes: control characters byte by byte as `\x1b`.
///
/// Source: `Sdf_EvalQuotedString` of OpenUSD (pxr/usd/sdf/parserHelpers.cpp).
fn quote(text: &str) -> String {
    let mut quoted = String::from("\"");
    for c in text.chars() {
        match c {
            '"' | '\\' => quoted.extend(['\\', c]),
            c if c.is_control() => {
                for byte in c.to_string().bytes() {
                    quoted.push_str(&format!("\\x{byte:02x}"));
                }
            }
            c => quoted.push(c),
        }
    }
    quoted + "\""
}

/// Three numbers.
pub fn vector(v: &Vector3<f64>) -> String {
    format!("({}, {}, {})", number(v.x), number(v.y), number(v.z))
}

/// A rotation, its real part first.
pub fn rotation(q: &UnitQuaternion<f64>) -> String {
    let q: &Quaternion<f64> = q.quaternion();
    format!("({}, {}, {}, {})", number(q.w), number(q.i), number(q.j), number(q.k))
}

/// Unique names of prims: letters, digits and `_`, not beginning with a digit.
#[derive(Debug, Default)]
pub struct PrimNames {
    used: BTreeSet<String>,
}

impl PrimNames {
    /// A unique prim name for any name.
    pub fn of(&mut self, name: &str) -> String {
        let plain = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
        let mut prim: String = name.chars().map(plain).collect();
        if prim.chars().next().is_none_or(|c| c.is_ascii_digit()) {
            prim.insert(0, '_');
        }
        let mut free = prim.clone();
        let mut count = 1;
        while !self.used.insert(free.clone()) {
            count += 1;
            free = format!("{prim}_{count}");
        }
        free
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_string_stays_on_its_line() {
        assert_eq!(quote("a\"b\\c\n\u{9b}é"), r#""a\"b\\c\x0a\xc2\x9bé""#);
    }

    #[test]
    fn names_of_prims_are_plain_and_each_is_there_once() {
        let mut names = PrimNames::default();
        let of = ["elbow", "elbow", "7-axis", "el bow", "el/bow", ""].map(|name| names.of(name));
        assert_eq!(of, ["elbow", "elbow_2", "_7_axis", "el_bow", "el_bow_2", "_"]);
    }
}
