//! Bounds of weights.

/// No bounds on any of `count` weights.
pub(crate) fn unbounded(count: usize) -> Vec<(f64, f64)> {
    vec![(f64::NEG_INFINITY, f64::INFINITY); count]
}

/// The bounds of a change that may take a nominal value down to zero, and up to anything.
pub(crate) fn down_to_zero(nominal: f64) -> Vec<(f64, f64)> {
    vec![(-nominal, f64::INFINITY)]
}
