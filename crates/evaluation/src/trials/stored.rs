//! Scores read back from JSON, in which a number that is not finite is null.

use catalogue::EffectKind;
use diagnosis::{EffectAt, Verdict};
use serde::{Deserialize, Deserializer};

/// An effect and its place; the code beside the name is for people.
#[derive(Deserialize)]
struct Place {
    effect: EffectKind,
    #[serde(default)]
    joint: Option<String>,
    #[serde(default)]
    link: Option<String>,
}

impl From<Place> for EffectAt {
    fn from(Place { effect, joint, link }: Place) -> Self {
        Self { effect, joint, link }
    }
}

/// The verdicts by the names that the diagnosis writes.
#[derive(Deserialize)]
#[serde(remote = "Verdict", rename_all = "snake_case")]
enum Named {
    Consistent,
    Explained,
    PartlyExplained,
    Unexplained,
    DataInadequate,
}

pub(crate) fn place<'de, D: Deserializer<'de>>(from: D) -> Result<EffectAt, D::Error> {
    Place::deserialize(from).map(EffectAt::from)
}

pub(crate) fn places<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<EffectAt>, D::Error> {
    Ok(Vec::<Place>::deserialize(from)?.into_iter().map(EffectAt::from).collect())
}

pub(crate) fn verdict<'de, D: Deserializer<'de>>(from: D) -> Result<Verdict, D::Error> {
    Named::deserialize(from)
}

pub(crate) fn number<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(from)?.unwrap_or(f64::NAN))
}

pub(crate) fn known_interval<'de, D: Deserializer<'de>>(
    from: D,
) -> Result<Option<[f64; 2]>, D::Error> {
    let known = Option::<[Option<f64>; 2]>::deserialize(from)?;
    Ok(known.map(|interval| interval.map(|end| end.unwrap_or(f64::NAN))))
}

pub(crate) fn interval<'de, D: Deserializer<'de>>(from: D) -> Result<[f64; 2], D::Error> {
    Ok(<[Option<f64>; 2]>::deserialize(from)?.map(|end| end.unwrap_or(f64::NAN)))
}
