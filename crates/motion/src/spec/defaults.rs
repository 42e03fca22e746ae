use std::collections::BTreeMap;

/// One number per joint, by name.
pub(super) type ByJoint = BTreeMap<String, f64>;

/// Fade of motions that would not start and end at rest (s).
pub(super) fn two_seconds() -> f64 {
    2.0
}

/// Share of a limit that generated motions keep to.
pub(super) fn four_fifths() -> f64 {
    0.8
}
