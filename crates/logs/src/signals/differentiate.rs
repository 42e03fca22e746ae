/// Derivative of a uniformly sampled signal by the five-point central difference:
///
/// ```text
/// x'[k] = (x[k-2] - 8 x[k-1] + 8 x[k+1] - x[k+2]) rate / 12
/// ```
///
/// Its gain on a sine of angular frequency `w` is `1 - (w / rate)^4 / 30`: 3e-4 low at
/// a twentieth of the sampling rate. The second and the last but one sample use the
/// three-point difference `(x[k+1] - x[k-1]) rate / 2`. The first and the last sample use the
/// difference with their neighbour. The unit is that of `x` per second. A signal of fewer
/// than two samples has the derivative 0.
pub fn differentiate(x: &[f64], rate_hz: f64) -> Vec<f64> {
    let n = x.len();
    let at = |k: usize| -> f64 {
        if n < 2 {
            0.0
        } else if k == 0 {
            (x[1] - x[0]) * rate_hz
        } else if k == n - 1 {
            (x[k] - x[k - 1]) * rate_hz
        } else if k == 1 || k == n - 2 {
            0.5 * (x[k + 1] - x[k - 1]) * rate_hz
        } else {
            (x[k - 2] - 8.0 * x[k - 1] + 8.0 * x[k + 1] - x[k + 2]) * rate_hz / 12.0
        }
    };
    (0..n).map(at).collect()
}
