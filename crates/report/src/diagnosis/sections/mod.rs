//! The sections of the page of a diagnosis, in their order. A new one is a struct, its template, and
//! here its module and its place.

pub(crate) mod also_fitted;
pub(crate) mod before_and_after;
pub(crate) mod data;
pub(crate) mod descriptions;
pub(crate) mod drift;
pub(crate) mod findings;
pub(crate) mod joints;
pub(crate) mod negligible;
pub(crate) mod ruled_out;
pub(crate) mod section;
pub(crate) mod unexplained;

use crate::diagnosis::sections::section::{Draw, draw};

/// What stands at the top.
pub(crate) const OPENING: &[Draw] = &[
    |report| draw::<before_and_after::BeforeAndAfter>(report),
    |report| draw::<drift::SimulationDrift>(report),
];

/// What the page of a run shows as well.
pub(crate) const FOUND: &[Draw] = &[
    |report| draw::<findings::FoundEffects>(report),
    |report| draw::<negligible::NegligibleEffects>(report),
    |report| draw::<also_fitted::AlsoFittedParameters>(report),
    |report| draw::<unexplained::UnexplainedStructure>(report),
    |report| draw::<joints::Joints>(report),
    |report| draw::<descriptions::Descriptions>(report),
    |report| draw::<ruled_out::RuledOutEffects>(report),
];

/// What stands at the end.
pub(crate) const CLOSING: &[Draw] = &[|report| draw::<data::Data>(report)];
