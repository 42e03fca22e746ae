use std::f64::consts::LN_2;

/// Number of values on either side of a line that are just beside it: eight times its width.
const BESIDE: usize = 32;

/// Number of frequencies whose median is the power around them.
pub(crate) const AROUND: usize = 200;

/// The variable that the phase of a tone may follow.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Follows {
    Position,
    Clock,
}

/// Spectra over the same values: of each run where runs have phases of their own, else one of all runs together.
pub(crate) struct SpectralLines {
    /// `[spectrum][value]`
    pub powers: Vec<Vec<f64>>,
    /// The first value of the phase per unit of beat.
    pub first: f64,
    /// Distance between neighbouring values.
    pub step: f64,
}

/// A line of a spectrum.
#[derive(Debug, Clone)]
pub(crate) struct SpectralLine {
    /// Index of the line in the spectrum.
    pub index: usize,
    /// Phase per unit of beat.
    pub at: f64,
    /// Distance between neighbouring values of the spectrum.
    pub step: f64,
    /// Power of the line in every spectrum.
    pub power: Vec<f64>,
}

impl SpectralLines {
    /// Number of values that every spectrum has.
    fn len(&self) -> usize {
        self.powers.iter().map(Vec::len).min().unwrap_or(0)
    }

    /// The line that is rarest in noise.
    pub fn line(&self) -> Option<SpectralLine> {
        let length = self.len();
        let around: Vec<Vec<f64>> = self.powers.iter().map(|p| around(&p[..length])).collect();
        let ratio = |r: usize, k: usize| self.powers[r][k] / around[r][k].max(f64::MIN_POSITIVE);
        let runs = 0..self.powers.len();
        let surprisal = |k: usize| surprisal(runs.clone().map(|r| ratio(r, k)));
        let all: Vec<f64> = (0..length).map(surprisal).collect();
        let index = (0..length).max_by(|&a, &b| all[a].total_cmp(&all[b]))?;
        let (at, step) = (self.first + index as f64 * self.step, self.step);
        Some(SpectralLine {
            index,
            at,
            step,
            power: self.powers.iter().map(|p| p[index]).collect(),
        })
    }

    /// Variance of white noise with the power just beside a value, or with the power around it if that is larger. A
    /// strong tone that is no pure sine leaks power there.
    pub fn beside(&self, index: usize, around: &[f64]) -> f64 {
        let of = |(power, around): (&Vec<f64>, &f64)| {
            let near = &power[index.saturating_sub(BESIDE)..(index + BESIDE + 1).min(power.len())];
            around.max(near.iter().sum::<f64>() / near.len() as f64)
        };
        self.powers.iter().zip(around).map(of).sum::<f64>() / around.len().max(1) as f64
    }

    /// The power around a value in every spectrum.
    pub fn around(&self, index: usize) -> Option<Vec<f64>> {
        let length = self.len();
        self.powers.iter().map(|p| around(&p[..length]).get(index).copied()).collect()
    }
}

/// The surprisal of a line in noise (nats), from the ratios of its power to that around it in every spectrum: `-ln P`, with
/// `P` the chance of a sum `S` of `R` ratios as large.
///
/// The power of white noise at one frequency over its mean is exponential, the sum over `R` spectra a Gamma variable:
///
/// ```text
/// P = exp(-S) sum_{k < R} S^k / k!
/// ```
pub(crate) fn surprisal(ratios: impl Iterator<Item = f64>) -> f64 {
    let (sum, spectra) = ratios.fold((0.0, 0), |(sum, n), ratio| (sum + ratio, n + 1));
    let mut term: f64 = 0.0;
    let terms: Vec<f64> = (0..spectra)
        .map(|k| {
            term += if k > 0 { (sum / k as f64).ln() } else { 0.0 };
            term
        })
        .collect();
    let largest = terms.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let all: f64 = terms.iter().map(|term| (term - largest).exp()).sum();
    sum - largest - all.ln()
}

/// The mean power of the noise around every value of a spectrum: the median of a block of neighbours over `ln 2`, the
/// largest of three blocks.
fn around(power: &[f64]) -> Vec<f64> {
    let median = |block: &[f64]| {
        let mut sorted = block.to_vec();
        sorted.sort_by(f64::total_cmp);
        sorted[sorted.len() / 2] / LN_2
    };
    let medians: Vec<f64> = power.chunks(AROUND).map(median).collect();
    let near = |k: usize| {
        let b = k / AROUND;
        let blocks = &medians[b.saturating_sub(1)..(b + 2).min(medians.len())];
        blocks.iter().copied().fold(0.0, f64::max)
    };
    (0..power.len()).map(near).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Of one run the chance is `exp(-S)`, of two `exp(-S) (1 + S)`; a sum of 40 over seven runs is rarer than one of 20 in
    /// one run, and one of 20 over seven is common.
    #[test]
    fn surprisal_of_a_line_is_the_tail_of_a_gamma_variable() {
        let of = |ratios: &[f64]| surprisal(ratios.iter().copied());
        assert!((of(&[20.0]) - 20.0).abs() < 1e-12);
        assert!((of(&[12.0, 8.0]) - (20.0 - 21.0_f64.ln())).abs() < 1e-12);
        // S - ln(1 + S + S^2 / 2! + ... + S^6 / 6!)
        assert!((of(&[34.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0]) - 24.288_310_416_379_8).abs() < 1e-9);
        assert!((of(&[14.0, 1.0, 1.0, 1.0, 1.0, 1.0, 1.0]) - 8.273_766_752_242_4).abs() < 1e-9);
    }
}
