use crate::runs::run::range;

/// Share of the samples at the lowest or highest value, without the two samples that any signal
/// has there; 0 for a constant signal.
pub(crate) fn saturation(x: &[f64]) -> f64 {
    let (low, high) = range(x);
    let near = 1e-9 * low.abs().max(high.abs());
    if high - low <= near {
        return 0.0;
    }
    let at_extreme = x.iter().filter(|&&v| v <= low + near || v >= high - near).count();
    at_extreme.saturating_sub(2) as f64 / x.len() as f64
}
