use serde::{Deserialize, Serialize};
use statrs::distribution::{Binomial, DiscreteCDF};

use crate::statistics::median::median;

/// The median of numbers, as an estimate for all possible ones.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Middle {
    /// The median; `None` without numbers.
    pub value: Option<f64>,
    /// Number of numbers.
    pub of: usize,
    /// 95 per cent interval, free of any distribution; `None` of fewer than six:
    ///
    /// ```text
    /// [x_(k), x_(n+1-k)],   k the largest with P(B <= k - 1) <= 0.025 for B binomial of n draws of a half
    /// ```
    pub interval: Option<[f64; 2]>,
}

impl Middle {
    /// Of these numbers.
    pub(crate) fn of(mut numbers: Vec<f64>) -> Self {
        numbers.sort_by(f64::total_cmp);
        let n = numbers.len();
        let below = Binomial::new(0.5, n as u64).ok();
        let is_rare = |k: &usize| below.as_ref().is_some_and(|b| b.cdf(*k as u64 - 1) <= 0.025);
        let k = (1..=n / 2).take_while(is_rare).last();
        let interval = k.map(|k| [numbers[k - 1], numbers[n - k]]);
        Self { value: median(numbers), of: n, interval }
    }

    /// Value and interval with three digits, such as `0.0121 (0.004 to 0.0503)`; `-` without numbers.
    pub fn words(&self) -> String {
        match (self.value, self.interval) {
            (None, _) => "-".to_owned(),
            (Some(value), None) => digits(value),
            (Some(value), Some([low, high])) => {
                format!("{} ({} to {})", digits(value), digits(low), digits(high))
            }
        }
    }
}

/// Three digits: as a power of ten where zeros would take their room.
fn digits(value: f64) -> String {
    match value.abs() {
        0.0 => "0".to_owned(),
        size if !(1e-3..1e5).contains(&size) => format!("{value:.1e}"),
        size => {
            let decimals = (2.0 - size.log10().floor()).clamp(0.0, 5.0) as usize;
            format!("{value:.decimals$}")
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Order statistics of the sign test: k is 1 for 6 to 8 numbers, 2 for 9 to 11, 3 for 12 (Conover 1999, table A3).
    #[test]
    fn the_interval_is_between_the_numbers_of_the_sign_test() {
        for (n, k) in [(5, None), (6, Some(1)), (8, Some(1)), (9, Some(2)), (12, Some(3))] {
            let middle = Middle::of((1..=n).rev().map(f64::from).collect());
            let expected = k.map(|k| [f64::from(k), f64::from(n + 1 - k)]);
            assert_eq!((middle.interval, middle.of), (expected, n as usize), "{n}");
        }
        assert_eq!(Middle::of(vec![]), Middle::default());
    }

    #[test]
    fn a_number_has_three_digits() {
        let words = [0.0, 1.0, 0.012_34, 1234.6, 4e-7].map(digits);
        assert_eq!(words, ["0", "1.00", "0.0123", "1235", "4.0e-7"]);
    }
}
