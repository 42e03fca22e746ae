//! A schema as a page in Markdown: a table of keys for the file and for each table in it.

use std::collections::{BTreeMap, VecDeque};

use schemars::Schema;
use serde_json::Value;

/// Ends of keys and the units that they stand for, the longest first.
const UNITS: [(&str, &str); 22] = [
    ("_nm_s_per_rad", "N·m·s/rad"),
    ("_nm_per_rad3", "N·m/rad³"),
    ("_nm2_per_hz", "(N·m)²/Hz"),
    ("_rad_per_s2", "rad/s²"),
    ("_rad_per_s", "rad/s"),
    ("_nm_per_rad", "N·m/rad"),
    ("_m_per_s2", "m/s²"),
    ("_m_per_s", "m/s"),
    ("_kg_m2", "kg·m²"),
    ("_nm2", "(N·m)²"),
    ("_nm", "N·m"),
    ("_rad", "rad"),
    ("_deg", "deg"),
    ("_hz", "Hz"),
    ("_ms", "ms"),
    ("_us", "µs"),
    ("_kg", "kg"),
    ("_mm", "mm"),
    ("_celsius", "°C"),
    ("_n", "N"),
    ("_m", "m"),
    ("_s", "s"),
];

/// Most values that stand in a cell; more have a table of their own.
const FEW: usize = 6;

/// The page of a schema.
pub(super) fn page(schema: &Schema) -> String {
    let root = schema.as_value();
    let text = |key: &str| root.get(key).and_then(Value::as_str).unwrap_or_default();
    let mut page = format!("# {}\n\n{}\n", text("title"), text("description"));
    let mut tables = Tables { root, told: BTreeMap::new(), left: VecDeque::new() };
    page.push_str(&tables.keys("", root));
    while let Some((place, name)) = tables.left.pop_front() {
        let definition = tables.definition(&name);
        page.push_str(&format!("\n## `{place}`\n"));
        if let Some(words) = definition.get("description").and_then(Value::as_str) {
            page.push_str(&format!("\n{words}\n"));
        }
        page.push_str(&match values(definition) {
            Some(values) => value_table(&values),
            None => tables.keys(&place, definition),
        });
    }
    page
}

/// The tables of a page: which are told, and which are still to come.
struct Tables<'a> {
    root: &'a Value,
    /// The places of definitions that have a table, by their names.
    told: BTreeMap<String, String>,
    /// Places, and the names of the definitions that stand there.
    left: VecDeque<(String, String)>,
}

impl<'a> Tables<'a> {
    fn definition(&self, name: &str) -> &'a Value {
        self.root.get("$defs").and_then(|all| all.get(name)).unwrap_or(&Value::Null)
    }

    /// The keys of a table, or of each form that it may have.
    fn keys(&mut self, place: &str, schema: &'a Value) -> String {
        let mut text = String::new();
        if let Some(properties) = schema.get("properties").and_then(Value::as_object) {
            text.push_str("\n| key | value | unit | default | meaning |\n|---|---|---|---|---|\n");
            for (key, value) in properties {
                text.push_str(&self.row(place, schema, key, value));
            }
        }
        for form in forms(schema) {
            let form = self.resolve(form);
            if form.get("properties").is_some() {
                text.push_str(&self.keys(place, form));
            }
        }
        text
    }

    fn row(&mut self, place: &str, table: &Value, key: &str, value: &'a Value) -> String {
        let own = self.resolve(value);
        let words = [value, own].into_iter().find_map(|v| v.get("description")?.as_str());
        let default = match value.get("default") {
            Some(default) if !is_nothing(default) => format!("`{default}`"),
            _ if is_required(table, key) => "needed".to_owned(),
            _ => String::new(),
        };
        let unit = UNITS.iter().find(|(end, _)| key.ends_with(end)).map_or("", |(_, unit)| unit);
        let place = if place.is_empty() { key.to_owned() } else { format!("{place}.{key}") };
        let kind = self.kind(&place, value);
        let words = cell(words.unwrap_or_default());
        format!("| `{key}` | {} | {unit} | {default} | {words} |\n", cell(&kind))
    }

    /// What a schema refers to.
    fn resolve(&self, schema: &'a Value) -> &'a Value {
        match reference(schema) {
            Some(name) => self.definition(name),
            None => schema,
        }
    }

    /// What a value may be, in words. A definition with keys gets a table of its own.
    fn kind(&mut self, place: &str, schema: &'a Value) -> String {
        if let Some(name) = reference(schema) {
            let definition = self.definition(name);
            return match values(definition) {
                Some(values) if values.len() <= FEW => names(&values),
                None if !has_keys(definition) => self.kind(place, definition),
                _ => {
                    let is_list = values(definition).is_some();
                    let kind = if is_list { "one of a list" } else { "table" };
                    match self.told.get(name) {
                        Some(told) => format!("{kind} as `{told}`"),
                        None => {
                            self.told.insert(name.to_owned(), place.to_owned());
                            self.left.push_back((place.to_owned(), name.to_owned()));
                            kind.to_owned()
                        }
                    }
                }
            };
        }
        if let Some(values) = values(schema) {
            return names(&values);
        }
        let forms: Vec<String> = forms(schema)
            .filter(|form| form.get("type").is_none_or(|kind| kind != "null"))
            .map(|form| self.kind(place, form))
            .collect();
        if !forms.is_empty() {
            return forms.join(" or ");
        }
        let named = schema.get("additionalProperties").filter(|inner| inner.is_object());
        let kind = match schema.get("type") {
            Some(Value::Array(kinds)) => {
                kinds.iter().filter_map(Value::as_str).find(|kind| *kind != "null")
            }
            kind => kind.and_then(Value::as_str),
        };
        match (kind, schema.get("items"), named) {
            (Some("array"), Some(items), _) => format!("list of {}", self.kind(place, items)),
            (Some("object"), _, Some(inner)) => {
                format!("by name: {}", self.kind(&format!("{place}.NAME"), inner))
            }
            (Some("string"), ..) => "text".to_owned(),
            (Some("integer"), ..) => "whole number".to_owned(),
            (Some("boolean"), ..) => "true or false".to_owned(),
            (Some("object"), ..) => "table".to_owned(),
            (Some("array"), ..) => "list".to_owned(),
            (Some(kind), ..) => kind.to_owned(),
            (None, ..) => {
                schema.get("const").map_or_else(String::new, |value| format!("`{value}`"))
            }
        }
    }
}

/// The definition that a schema refers to.
fn reference(schema: &Value) -> Option<&str> {
    schema.get("$ref")?.as_str()?.strip_prefix("#/$defs/")
}

/// The forms of which a value has one.
fn forms(schema: &Value) -> impl Iterator<Item = &Value> {
    let lists = ["anyOf", "oneOf"].into_iter().filter_map(|key| schema.get(key)?.as_array());
    lists.flatten()
}

fn is_required(schema: &Value, key: &str) -> bool {
    let required = schema.get("required").and_then(Value::as_array);
    required.is_some_and(|keys| keys.iter().any(|own| own == key))
}

/// Whether a default says no more than that nothing is there.
fn is_nothing(default: &Value) -> bool {
    match default {
        Value::Array(list) => list.is_empty(),
        Value::Object(table) => table.is_empty(),
        value => value.is_null(),
    }
}

fn has_keys(schema: &Value) -> bool {
    schema.get("properties").is_some() || forms(schema).any(|form| form.get("properties").is_some())
}

/// The values of an enumeration, each with what it means.
fn values(schema: &Value) -> Option<Vec<(String, String)>> {
    let plain = schema.get("enum").and_then(Value::as_array);
    if let Some(values) = plain {
        return Some(values.iter().map(|value| (value.to_string(), String::new())).collect());
    }
    let forms: Vec<&Value> = forms(schema).collect();
    let mut all = vec![];
    for form in &forms {
        let meaning = form.get("description").and_then(Value::as_str).unwrap_or_default();
        match (form.get("const"), form.get("enum").and_then(Value::as_array)) {
            (Some(value), _) => all.push((value.to_string(), meaning.to_owned())),
            (None, Some(values)) => {
                all.extend(values.iter().map(|value| (value.to_string(), meaning.to_owned())));
            }
            (None, None) => return None,
        }
    }
    (!all.is_empty()).then_some(all)
}

fn names(values: &[(String, String)]) -> String {
    values.iter().map(|(value, _)| format!("`{value}`")).collect::<Vec<_>>().join(", ")
}

fn value_table(values: &[(String, String)]) -> String {
    let rows = values.iter().map(|(value, meaning)| format!("| `{value}` | {} |\n", cell(meaning)));
    format!("\n| value | meaning |\n|---|---|\n{}", rows.collect::<String>())
}

/// Text in one cell of a table.
fn cell(text: &str) -> String {
    text.split_whitespace().collect::<Vec<_>>().join(" ").replace('|', "\\|")
}

#[cfg(test)]
mod tests {
    use schemars::json_schema;

    use super::*;

    #[test]
    fn a_key_has_its_unit_its_default_and_its_meaning() {
        let schema = json_schema!({
            "title": "Arm", "description": "An arm.",
            "properties": {
                "joint": { "type": "object", "additionalProperties": { "$ref": "#/$defs/Joint" } },
                "side": { "anyOf": [{ "$ref": "#/$defs/Side" }, { "type": "null" }] },
            },
            "required": ["joint"],
            "$defs": {
                "Joint": { "description": "A joint.", "properties": {
                    "rotor_kg_m2": { "type": ["number", "null"], "default": 0.5, "description": "A | b." },
                } },
                "Side": { "oneOf": [{ "const": "left", "description": "Left." }, { "const": "right" }] },
            },
        });
        assert_eq!(
            page(&schema),
            "# Arm\n\nAn arm.\n\n| key | value | unit | default | meaning |\n|---|---|---|---|---|\n\
             | `joint` | by name: table |  | needed |  |\n| `side` | `\"left\"`, `\"right\"` |  |  |  |\n\n\
             ## `joint.NAME`\n\nA joint.\n\n| key | value | unit | default | meaning |\n|---|---|---|---|---|\n\
             | `rotor_kg_m2` | number | kg·m² | `0.5` | A \\| b. |\n"
        );
    }
}
