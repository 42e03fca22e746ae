//! Scores read back from JSON, where null stands for a number that is not finite.

use catalogue::EffectKind;
use diagnosis::{EffectAt, Verdict};
use serde::{Deserialize, Deserializer};

/// An effect and its place; the code beside the name is for readers.
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

/// An effect and its place.
///
/// # Errors
///
/// Those of the decoder.
pub fn place<'de, D: Deserializer<'de>>(from: D) -> Result<EffectAt, D::Error> {
    Place::deserialize(from).map(EffectAt::from)
}

/// Effects and their places.
///
/// # Errors
///
/// Those of the decoder.
pub fn places<'de, D: Deserializer<'de>>(from: D) -> Result<Vec<EffectAt>, D::Error> {
    Ok(Vec::<Place>::deserialize(from)?.into_iter().map(EffectAt::from).collect())
}

/// A verdict by the name that the diagnosis writes.
///
/// # Errors
///
/// Those of the decoder.
pub fn verdict<'de, D: Deserializer<'de>>(from: D) -> Result<Verdict, D::Error> {
    Named::deserialize(from)
}

/// A number; null becomes NaN.
///
/// # Errors
///
/// Those of the decoder.
pub fn number<'de, D: Deserializer<'de>>(from: D) -> Result<f64, D::Error> {
    Ok(Option::deserialize(from)?.unwrap_or(f64::NAN))
}

/// An interval whose null ends become NaN; `None` where it is absent.
///
/// # Errors
///
/// Those of the decoder.
pub fn known_interval<'de, D: Deserializer<'de>>(from: D) -> Result<Option<[f64; 2]>, D::Error> {
    let known = Option::<[Option<f64>; 2]>::deserialize(from)?;
    Ok(known.map(|interval| interval.map(|end| end.unwrap_or(f64::NAN))))
}

/// An interval whose null ends become NaN.
///
/// # Errors
///
/// Those of the decoder.
pub fn interval<'de, D: Deserializer<'de>>(from: D) -> Result<[f64; 2], D::Error> {
    Ok(<[Option<f64>; 2]>::deserialize(from)?.map(|end| end.unwrap_or(f64::NAN)))
}
