use std::ops::Range;

/// Correlation below which samples farther apart count as independent.
const INDEPENDENT: f64 = 0.05;

/// Largest lag of the sum of correlations (samples).
const FARTHEST: usize = 60;

/// Number of samples of a signal that count as one independent sample: its integrated autocorrelation time over
/// independent runs,
///
/// ```text
/// t = 1 + 2 sum over k of rho(k),   up to the first rho below 0.05
/// ```
///
/// (Sokal 1997).
pub(super) fn memory(x: &[f64], runs: &[Range<usize>]) -> f64 {
    let mut centred = x.to_vec();
    for run in runs {
        let part = &mut centred[run.clone()];
        let mean = part.iter().sum::<f64>() / part.len().max(1) as f64;
        part.iter_mut().for_each(|x| *x -= mean);
    }
    let product = |lag: usize| -> f64 {
        let of = |run: &Range<usize>| {
            let part = &centred[run.clone()];
            let late = part.iter().skip(lag);
            part.iter().zip(late).map(|(a, b)| a * b).sum::<f64>()
        };
        runs.iter().map(of).sum()
    };
    let square = product(0);
    let correlations = (1..FARTHEST).map(|lag| product(lag) / square.max(f64::MIN_POSITIVE));
    1.0 + 2.0 * correlations.take_while(|rho| *rho >= INDEPENDENT).sum::<f64>()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every value of an uncorrelated sequence of 1 and -1 (Steele et al. 2014), thrice.
    #[test]
    fn a_signal_that_stands_still_for_three_samples_tells_a_third() {
        let value = |k: usize| {
            let z = (k as u64 + 1).wrapping_mul(0x9E37_79B9_7F4A_7C15);
            let z = (z ^ (z >> 30)).wrapping_mul(0xBF58_476D_1CE4_E5B9);
            if (z ^ (z >> 27)) >> 63 == 0 { 1.0 } else { -1.0 }
        };
        let x: Vec<f64> = (0..60_000).map(|k| value(k / 3)).collect();
        let t = memory(&x, &[0..30_000, 30_000..60_000]);
        // 1 + 2 (2/3 + 1/3) = 3
        assert!((t - 3.0).abs() < 0.15, "{t}");
    }
}
