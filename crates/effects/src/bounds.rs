//! Bounds of weights.

/// Infinite bounds of `count` weights.
pub(crate) fn infinite_bounds(count: usize) -> Vec<(f64, f64)> {
    vec![(f64::NEG_INFINITY, f64::INFINITY); count]
}

/// Bounds of the change of a nominal value that stays at or above zero.
pub(crate) fn down_to_zero(nominal: f64) -> Vec<(f64, f64)> {
    vec![(-nominal, f64::INFINITY)]
}
