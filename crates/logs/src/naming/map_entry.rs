//! Entries of a column map: a name, a list of names, or a table with unit and factor.

use std::fmt;
use std::marker::PhantomData;

use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::de::value::{MapAccessDeserializer, SeqAccessDeserializer};
use serde::de::{self, Deserialize, Deserializer, MapAccess, SeqAccess, Visitor};

use log_formats::TimeScale;

use crate::naming::unit::Unit;

/// The column of a signal in a file, and its conversion:
///
/// ```text
/// signal = scale * factor(unit) * value + offset
/// ```
#[derive(Debug, Clone, PartialEq)]
pub struct MappedColumn {
    /// Name of the column.
    pub column: String,
    /// Unit of the values in the file; by default the SI unit, and radians for angles.
    pub unit: Option<Unit>,
    /// Factor, such as a torque constant or the sign of an axis.
    pub scale: f64,
    /// Offset that is added last, in SI units and radians.
    pub offset: f64,
}

impl MappedColumn {
    /// Converts a value of the file to the signal (SI units, radians).
    pub fn convert(&self, value: f64) -> f64 {
        self.scale * self.unit.map_or(1.0, Unit::factor) * value + self.offset
    }

    /// The same conversion for a column of time.
    pub(crate) fn time_scale(&self) -> TimeScale {
        let factor = self.scale * self.unit.map_or(1.0, Unit::factor);
        TimeScale { factor, offset_s: self.offset }
    }
}

/// The columns of one signal for all joints: a pattern of names, or one name per joint.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Pattern {
    pub column: Names,
    pub unit: Option<Unit>,
    /// Factors, one for all joints or one per joint.
    pub scale: Numbers,
    /// Offsets, one for all joints or one per joint.
    pub offset: Numbers,
}

/// Names of columns.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Names {
    Pattern(String),
    Each(Vec<String>),
}

/// One number for all joints, or one per joint.
#[derive(Debug, Clone, PartialEq)]
pub(crate) enum Numbers {
    All(f64),
    Each(Vec<f64>),
}

#[derive(serde::Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct ColumnTable {
    /// Name of the column in the file.
    column: String,
    /// Unit of the values in the file; by default the SI unit, and radians for angles.
    unit: Option<Unit>,
    /// Factor, such as a torque constant or the sign of an axis.
    #[serde(default = "one")]
    scale: f64,
    /// Offset that is added last, in SI units and radians.
    #[serde(default)]
    offset: f64,
}

fn one() -> f64 {
    1.0
}

#[derive(serde::Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
struct PatternTable {
    /// A pattern of names, or one name per joint.
    column: Names,
    /// Unit of the values in the file; by default the SI unit, and radians for angles.
    unit: Option<Unit>,
    /// Factors, one for all joints or one per joint.
    #[schemars(extend("default" = 1.0))]
    scale: Option<Numbers>,
    /// Offsets that are added last, in SI units and radians, one for all joints or one per joint.
    #[schemars(extend("default" = 0.0))]
    offset: Option<Numbers>,
}

impl From<String> for MappedColumn {
    fn from(column: String) -> Self {
        Self { column, unit: None, scale: 1.0, offset: 0.0 }
    }
}

impl From<ColumnTable> for MappedColumn {
    fn from(ColumnTable { column, unit, scale, offset }: ColumnTable) -> Self {
        Self { column, unit, scale, offset }
    }
}

impl From<Names> for Pattern {
    fn from(column: Names) -> Self {
        Self { column, unit: None, scale: Numbers::All(1.0), offset: Numbers::All(0.0) }
    }
}

impl From<PatternTable> for Pattern {
    fn from(PatternTable { column, unit, scale, offset }: PatternTable) -> Self {
        let of = |given: Option<Numbers>, usual| given.unwrap_or(Numbers::All(usual));
        Self { column, unit, scale: of(scale, 1.0), offset: of(offset, 0.0) }
    }
}

/// Reads a string, a list or a table, each in its own way. An error inside keeps its place in the file, which
/// an untagged enumeration would lose.
struct Either<T> {
    expected: &'static str,
    of: PhantomData<T>,
}

impl<'de> Visitor<'de> for Either<MappedColumn> {
    type Value = MappedColumn;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.expected)
    }

    fn visit_str<E: de::Error>(self, name: &str) -> Result<MappedColumn, E> {
        Ok(name.to_owned().into())
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<MappedColumn, A::Error> {
        ColumnTable::deserialize(MapAccessDeserializer::new(map)).map(Into::into)
    }
}

impl<'de> Visitor<'de> for Either<Pattern> {
    type Value = Pattern;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.expected)
    }

    fn visit_str<E: de::Error>(self, name: &str) -> Result<Pattern, E> {
        Ok(Names::Pattern(name.to_owned()).into())
    }

    fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Pattern, A::Error> {
        let names = Vec::deserialize(SeqAccessDeserializer::new(list))?;
        Ok(Names::Each(names).into())
    }

    fn visit_map<A: MapAccess<'de>>(self, map: A) -> Result<Pattern, A::Error> {
        PatternTable::deserialize(MapAccessDeserializer::new(map)).map(Into::into)
    }
}

impl<'de> Visitor<'de> for Either<Names> {
    type Value = Names;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.expected)
    }

    fn visit_str<E: de::Error>(self, name: &str) -> Result<Names, E> {
        Ok(Names::Pattern(name.to_owned()))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Names, A::Error> {
        Vec::deserialize(SeqAccessDeserializer::new(list)).map(Names::Each)
    }
}

impl<'de> Visitor<'de> for Either<Numbers> {
    type Value = Numbers;

    fn expecting(&self, f: &mut fmt::Formatter) -> fmt::Result {
        f.write_str(self.expected)
    }

    fn visit_f64<E: de::Error>(self, value: f64) -> Result<Numbers, E> {
        Ok(Numbers::All(value))
    }

    fn visit_i64<E: de::Error>(self, value: i64) -> Result<Numbers, E> {
        Ok(Numbers::All(value as f64))
    }

    fn visit_u64<E: de::Error>(self, value: u64) -> Result<Numbers, E> {
        Ok(Numbers::All(value as f64))
    }

    fn visit_seq<A: SeqAccess<'de>>(self, list: A) -> Result<Numbers, A::Error> {
        Vec::deserialize(SeqAccessDeserializer::new(list)).map(Numbers::Each)
    }
}

impl<'de> Deserialize<'de> for MappedColumn {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let expected = "a column or a table with column, unit, scale, offset";
        deserializer.deserialize_any(Either::<Self> { expected, of: PhantomData })
    }
}

impl<'de> Deserialize<'de> for Pattern {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let expected = "a pattern of columns, a list of them, or a table with column, unit, scale, \
                        offset";
        deserializer.deserialize_any(Either::<Self> { expected, of: PhantomData })
    }
}

impl<'de> Deserialize<'de> for Names {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let expected = "a pattern of columns or a list of them";
        deserializer.deserialize_any(Either::<Self> { expected, of: PhantomData })
    }
}

impl<'de> Deserialize<'de> for Numbers {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let expected = "a number or a list of them";
        deserializer.deserialize_any(Either::<Self> { expected, of: PhantomData })
    }
}

/// Forms of an entry, of which one is written.
fn one_of<const N: usize>(description: &str, forms: [Schema; N]) -> Schema {
    json_schema!({ "description": description, "anyOf": forms.to_vec() })
}

macro_rules! schema_of_forms {
    ($entry:ident, $description:literal, $($form:ty),+) => {
        impl JsonSchema for $entry {
            fn schema_name() -> std::borrow::Cow<'static, str> {
                stringify!($entry).into()
            }

            fn json_schema(generator: &mut SchemaGenerator) -> Schema {
                one_of($description, [$(generator.subschema_for::<$form>()),+])
            }
        }
    };
}

schema_of_forms!(
    MappedColumn,
    "A column, or a table that tells its unit as well.",
    String,
    ColumnTable
);
schema_of_forms!(
    Pattern,
    "The columns of all joints: a pattern of names, one name per joint, or a table that tells their unit as well.",
    String,
    Vec<String>,
    PatternTable
);
schema_of_forms!(Names, "A pattern of names, or one name per joint.", String, Vec<String>);
schema_of_forms!(Numbers, "One number for all joints, or one per joint.", f64, Vec<f64>);
