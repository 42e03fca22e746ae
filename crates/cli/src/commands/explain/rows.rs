use catalogue::{EffectKind, Family};
use schemars::JsonSchema;
use serde::Serialize;

/// What the list says of an effect.
#[derive(Serialize, JsonSchema)]
pub struct EffectRow {
    #[serde(skip)]
    pub kind: EffectKind,
    pub code: &'static str,
    pub name: &'static str,
    pub family: Family,
    pub summary: &'static str,
    pub diagnosed: bool,
    /// As every effect of the catalogue is.
    pub simulated: bool,
    pub compensated: bool,
}

/// The effects by family and code.
pub fn rows() -> Vec<EffectRow> {
    let mut kinds = EffectKind::ALL;
    kinds.sort_by_key(|kind| (kind.family(), kind.code()));
    let row = |kind: EffectKind| EffectRow {
        kind,
        code: kind.code(),
        name: kind.name(),
        family: kind.family(),
        summary: kind.entry().summary,
        diagnosed: diagnosis::how_found(kind).is_ok(),
        simulated: true,
        compensated: effects::remedy(kind).is_ok(),
    };
    kinds.map(row).into()
}
