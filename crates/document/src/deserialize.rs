use std::collections::btree_map;
use std::slice;

use serde::de::value::StrDeserializer;
use serde::de::{
    DeserializeSeed, Deserializer, EnumAccess, Error as _, IntoDeserializer, MapAccess, SeqAccess,
    Unexpected, VariantAccess, Visitor,
};
use serde::forward_to_deserialize_any;

use crate::fault::Fault;
use crate::key_path::Segment;
use crate::names::one_of;
use crate::node::{Node, Value};

impl<'de> Deserializer<'de> for &'de Node {
    type Error = Fault;

    fn deserialize_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        match &self.value {
            Value::String(text) => visitor.visit_borrowed_str(text),
            Value::Integer(number) => visitor.visit_i64(*number),
            Value::Float(number) => visitor.visit_f64(*number),
            Value::Boolean(value) => visitor.visit_bool(*value),
            Value::Date(_) => {
                Err(Fault::invalid_type(Unexpected::Other(&self.describe()), &visitor))
            }
            Value::Array(array) => {
                let mut entries = Entries { rest: array.iter(), index: 0 };
                let value = visitor.visit_seq(&mut entries)?;
                if entries.rest.len() > 0 {
                    let expected = format!("an array of {}", entries.index);
                    return Err(Fault::mismatch(&expected, &self.describe()));
                }
                Ok(value)
            }
            Value::Table(table) => visitor.visit_map(Pairs { rest: table.iter(), value: None }),
        }
    }

    fn deserialize_option<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        visitor.visit_some(self)
    }

    fn deserialize_newtype_struct<V: Visitor<'de>>(
        self,
        _name: &'static str,
        visitor: V,
    ) -> Result<V::Value, Fault> {
        visitor.visit_newtype_struct(self)
    }

    fn deserialize_enum<V: Visitor<'de>>(
        self,
        _name: &'static str,
        variants: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fault> {
        let table = match &self.value {
            Value::String(name) => return visitor.visit_enum(Variant { name, content: None }),
            Value::Table(table) => table,
            _ => return Err(Fault::mismatch(&one_of(variants), &self.describe())),
        };
        let mut entries = table.iter();
        match (entries.next(), entries.next()) {
            (Some((name, node)), None) => visitor.visit_enum(Variant { name, content: Some(node) }),
            (None, _) => Err(Fault::mismatch(&one_of(variants), "an empty table")),
            _ => Err(one_key_too_many(table)),
        }
    }

    fn deserialize_ignored_any<V: Visitor<'de>>(self, visitor: V) -> Result<V::Value, Fault> {
        visitor.visit_unit()
    }

    forward_to_deserialize_any! {
        bool i8 i16 i32 i64 i128 u8 u16 u32 u64 u128 f32 f64 char str string bytes byte_buf unit
        unit_struct struct seq tuple tuple_struct map identifier
    }
}

/// A table that stands for one name but has several keys, each told with its place.
fn one_key_too_many(table: &btree_map::BTreeMap<String, Node>) -> Fault {
    let places = table.iter().map(|(key, node)| format!("`{key}` at {}", node.key_place()));
    let help = format!("found {}", places.collect::<Vec<_>>().join(", "));
    Fault::new(format!("expected a single key, found {}", table.len()), Some(help))
}

struct Entries<'de> {
    rest: slice::Iter<'de, Node>,
    index: usize,
}

impl<'de> SeqAccess<'de> for &mut Entries<'de> {
    type Error = Fault;

    fn next_element_seed<T: DeserializeSeed<'de>>(
        &mut self,
        seed: T,
    ) -> Result<Option<T::Value>, Fault> {
        let Some(node) = self.rest.next() else { return Ok(None) };
        let index = Segment::Index(self.index);
        self.index += 1;
        seed.deserialize(node).map(Some).map_err(|fault| fault.inside(index))
    }

    fn size_hint(&self) -> Option<usize> {
        Some(self.rest.len())
    }
}

struct Pairs<'de> {
    rest: btree_map::Iter<'de, String, Node>,
    /// The entry whose key was given last.
    value: Option<(&'de str, &'de Node)>,
}

impl<'de> MapAccess<'de> for Pairs<'de> {
    type Error = Fault;

    fn next_key_seed<K: DeserializeSeed<'de>>(
        &mut self,
        seed: K,
    ) -> Result<Option<K::Value>, Fault> {
        let Some((key, node)) = self.rest.next() else { return Ok(None) };
        self.value = Some((key, node));
        seed.deserialize(name_of(key)).map(Some).map_err(|fault| fault.in_key(key))
    }

    fn next_value_seed<T: DeserializeSeed<'de>>(&mut self, seed: T) -> Result<T::Value, Fault> {
        let (key, node) = self.value.take().ok_or_else(|| Fault::custom("a value has no key"))?;
        seed.deserialize(node).map_err(|fault| fault.inside(Segment::Key(key.to_owned())))
    }
}

fn name_of(key: &str) -> StrDeserializer<'_, Fault> {
    key.into_deserializer()
}

/// One of several kinds of value: `name`, or `name = content`.
struct Variant<'de> {
    name: &'de str,
    content: Option<&'de Node>,
}

impl Variant<'_> {
    fn locate(&self, fault: Fault) -> Fault {
        match self.content {
            Some(_) => fault.inside(Segment::Key(self.name.to_owned())),
            None => fault,
        }
    }
}

impl<'de> EnumAccess<'de> for Variant<'de> {
    type Error = Fault;
    type Variant = Self;

    fn variant_seed<V: DeserializeSeed<'de>>(self, seed: V) -> Result<(V::Value, Self), Fault> {
        match seed.deserialize(name_of(self.name)) {
            Ok(value) => Ok((value, self)),
            Err(fault) if self.content.is_some() => Err(fault.in_key(self.name)),
            Err(fault) => Err(fault),
        }
    }
}

impl<'de> Variant<'de> {
    fn content(&self) -> Result<&'de Node, Fault> {
        let name = self.name;
        let form = format!("`{name} = ...`");
        self.content.ok_or_else(|| Fault::mismatch(&form, "its name alone"))
    }
}

impl<'de> VariantAccess<'de> for Variant<'de> {
    type Error = Fault;

    fn unit_variant(self) -> Result<(), Fault> {
        match self.content {
            Some(node) => {
                let form = format!("\"{}\"", self.name);
                Err(self.locate(Fault::mismatch(&form, &node.describe())))
            }
            None => Ok(()),
        }
    }

    fn newtype_variant_seed<T: DeserializeSeed<'de>>(self, seed: T) -> Result<T::Value, Fault> {
        seed.deserialize(self.content()?).map_err(|fault| self.locate(fault))
    }

    fn tuple_variant<V: Visitor<'de>>(self, _len: usize, visitor: V) -> Result<V::Value, Fault> {
        self.content()?.deserialize_any(visitor).map_err(|fault| self.locate(fault))
    }

    fn struct_variant<V: Visitor<'de>>(
        self,
        _fields: &'static [&'static str],
        visitor: V,
    ) -> Result<V::Value, Fault> {
        self.tuple_variant(0, visitor)
    }
}
