use std::borrow::Cow;
use std::fmt;
use std::str::FromStr;

use learner::ModelKind;
use schemars::{JsonSchema, Schema, SchemaGenerator, json_schema};
use serde::{Deserialize, Deserializer, Serialize, Serializer};

/// What is fed forward.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Hash)]
pub enum FeedforwardKind {
    /// Nothing.
    None,
    /// The torque that holds the robot as described against gravity.
    Gravity,
    /// The torque of a model. For [`ModelKind::Named`] it includes the compensation of the drives.
    Model(ModelKind),
}

impl FeedforwardKind {
    /// Every kind.
    pub fn all() -> impl Iterator<Item = Self> {
        [Self::None, Self::Gravity].into_iter().chain(ModelKind::ALL.map(Self::Model))
    }

    /// Name in files and options.
    pub fn name(self) -> &'static str {
        match self {
            Self::None => "none",
            Self::Gravity => "gravity",
            Self::Model(kind) => kind.name(),
        }
    }

    /// The kind in words.
    pub fn words(self) -> &'static str {
        match self {
            Self::None => "feedback alone",
            Self::Gravity => "gravity of the robot as described",
            Self::Model(kind) => kind.words(),
        }
    }

    /// The model behind it.
    pub fn model(self) -> Option<ModelKind> {
        match self {
            Self::None => None,
            Self::Gravity => Some(ModelKind::Cad),
            Self::Model(kind) => Some(kind),
        }
    }
}

impl fmt::Display for FeedforwardKind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(self.name())
    }
}

impl FromStr for FeedforwardKind {
    type Err = String;

    fn from_str(name: &str) -> Result<Self, String> {
        Self::all().find(|kind| kind.name() == name).ok_or_else(|| {
            let names: Vec<&str> = Self::all().map(Self::name).collect();
            format!("{name:?}, one of {} was expected", names.join(", "))
        })
    }
}

impl Serialize for FeedforwardKind {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.serialize_str(self.name())
    }
}

impl<'de> Deserialize<'de> for FeedforwardKind {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let name = String::deserialize(deserializer)?;
        name.parse().map_err(serde::de::Error::custom)
    }
}

impl JsonSchema for FeedforwardKind {
    fn schema_name() -> Cow<'static, str> {
        "Feedforward".into()
    }

    fn json_schema(_: &mut SchemaGenerator) -> Schema {
        let names: Vec<&str> = Self::all().map(Self::name).collect();
        json_schema!({ "type": "string", "enum": names })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_kind_reads_back_from_its_name_and_no_other_name_does() {
        for kind in FeedforwardKind::all() {
            assert_eq!(kind.name().parse(), Ok(kind));
        }
        let error = "gp_rbd".parse::<FeedforwardKind>().unwrap_err();
        assert!(error.contains("\"gp_rbd\"") && error.contains("gp-rbd-prior"), "{error}");
    }
}
