//! The lattice on which the readings of a sensor lie.

use std::f64::consts::TAU;

/// Quantiles of the gaps between sorted readings: each is a candidate for the step.
const RANKS: [f64; 7] = [0.0, 0.01, 0.05, 0.1, 0.25, 0.5, 0.75];
/// Most decimals of a file that are tried as a step.
const MOST_DECIMALS: i32 = 9;
/// Largest number of steps in a gap that is tried.
const MULTIPLES: i32 = 3;
/// Least coherence of a lattice, reached with an error of 7 % of the step.
const LEAST_COHERENCE: f64 = 0.9;
/// Fewest readings that differ from the one before.
const FEWEST_CHANGES: usize = 10;
/// Most readings and differences that are sampled, up to a factor of two.
const MOST_LOOKED_AT: usize = 5000;

/// Step of the lattice on which the values of a signal lie, given in the order in which they were read;
/// `None` without a lattice.
///
/// The candidates `h` are the powers of ten, and steps that the gaps between sorted values suggest. `d` are the
/// differences between consecutive readings, without zeros. The step is the largest `h` for which
///
/// ```text
/// mean cos(2 pi d / h) >= 0.9
/// ```
///
/// This does not depend on an offset of the lattice, and hardly on rounding in the file that is small
/// compared with the step. A file with six decimals has the step 1e-6, its resolution.
pub(crate) fn step(x: &[f64]) -> Option<f64> {
    let size = x.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
    // Digits that arithmetic in f64 does not keep.
    let least = 64.0 * f64::EPSILON * size;
    let all = || x.windows(2).map(|x| (x[1] - x[0]).abs()).filter(|d| *d > least);
    let differences: Vec<f64> = all().step_by(all().count() / MOST_LOOKED_AT + 1).collect();
    if differences.len() < FEWEST_CHANGES {
        return None;
    }
    let mut sorted: Vec<f64> = x.iter().copied().step_by(x.len() / MOST_LOOKED_AT + 1).collect();
    sorted.sort_unstable_by(f64::total_cmp);
    let mut gaps: Vec<f64> =
        sorted.windows(2).map(|x| x[1] - x[0]).filter(|gap| *gap > least).collect();
    gaps.sort_unstable_by(f64::total_cmp);
    let ranked = RANKS.iter().filter_map(|r| gaps.get((r * gaps.len() as f64) as usize));
    let candidates = ranked.flat_map(|gap| (1..=MULTIPLES).map(move |m| gap / f64::from(m)));
    let decimals = (1..=MOST_DECIMALS).map(|k| 0.1_f64.powi(k));
    let steps = candidates.map(|h| refine(h, &differences)).chain(decimals);
    steps.filter(|h| *h > least && is_coherent(*h, &differences)).max_by(f64::total_cmp)
}

/// Least squares of `d = h n` with `n` the nearest whole numbers, over larger and larger `n`: the
/// error of `h` must stay below half a step after `n` steps.
fn refine(mut h: f64, differences: &[f64]) -> f64 {
    for reach in [3.0, 10.0, 30.0, 100.0, 300.0] {
        let near = differences.iter().filter(|d| **d < (reach + 0.5) * h && **d > 0.5 * h);
        let (dn, nn) = near.fold((0.0, 0.0), |(dn, nn), d| {
            let n = (d / h).round();
            (dn + d * n, nn + n * n)
        });
        if nn > 0.0 {
            h = dn / nn;
        }
    }
    h
}

/// Whether the mean of `cos(2 pi d / h)` is at least [`LEAST_COHERENCE`]; a difference below half a step counts as -1.
/// The deficit from 1 only grows in the sum, so the search stops early: a wrong step is refused after about a tenth
/// of the differences.
fn is_coherent(h: f64, differences: &[f64]) -> bool {
    let most = (1.0 - LEAST_COHERENCE) * differences.len() as f64;
    let mut missing = 0.0;
    for d in differences {
        let steps = d / h;
        missing += if steps < 0.5 { 2.0 } else { 1.0 - (TAU * (steps - steps.round())).cos() };
        if missing > most {
            return false;
        }
    }
    true
}

#[cfg(test)]
mod tests {
    use super::*;

    fn swing(k: usize) -> f64 {
        let t = 0.002 * k as f64;
        0.9 * (1.3 * t).sin() + 0.2 * (4.1 * t + 1.0).cos()
    }

    fn quantise(step: f64, offset: f64) -> Vec<f64> {
        (0..8000).map(|k| step * (swing(k) / step).round() + offset).collect()
    }

    #[track_caller]
    fn close(x: &[f64], expected: f64) {
        let found = step(x).unwrap_or(0.0);
        assert!((found / expected - 1.0).abs() < 1e-3, "{found} for {expected}");
    }

    #[test]
    fn steps_are_found_whatever_their_offset_and_the_digits_of_the_file() {
        for h in [2.914e-3, 3.8e-4, 2.4e-5] {
            close(&quantise(h, 0.0), h);
            close(&quantise(h, 0.1234), h);
            let as_f32: Vec<f64> =
                quantise(h, 0.1234).iter().map(|x| f64::from(*x as f32)).collect();
            close(&as_f32, h);
            let decimals =
                quantise(h, 0.0).iter().map(|x| (1e6 * x).round() / 1e6).collect::<Vec<_>>();
            close(&decimals, h);
        }
    }

    #[test]
    fn six_decimals_are_a_step_of_a_millionth() {
        let x: Vec<f64> = (0..8000).map(|k| (1e6 * swing(k)).round() / 1e6).collect();
        close(&x, 1e-6);
    }

    #[test]
    fn what_lies_on_no_lattice_has_no_step() {
        let smooth: Vec<f64> = (0..8000).map(swing).collect();
        assert_eq!(step(&smooth), None);
        // Two levels with jitter of their own.
        let levels =
            (0..4000).map(|k| f64::from(k % 7 / 4) + 1e-3 * swing(k as usize * k as usize));
        assert_eq!(step(&levels.collect::<Vec<_>>()), None);
        assert_eq!(step(&[1.0; 100]), None);
        assert_eq!(step(&[]), None);
    }
}
