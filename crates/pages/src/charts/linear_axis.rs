use crate::charts::log_axis::{AxisTick, round_px};

/// An axis on a drawing on which equal differences are equal lengths.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LinearAxis {
    /// Its ends.
    ends: [f64; 2],
    /// Where they lie (px).
    px: [f64; 2],
}

impl LinearAxis {
    /// The axis from the smallest to the largest finite number among `values`; none without.
    pub fn over(values: impl Iterator<Item = f64>, px: [f64; 2]) -> Option<Self> {
        let finite = values.filter(|v| v.is_finite());
        let [low, high] = finite
            .fold([f64::INFINITY, f64::NEG_INFINITY], |[low, high], v| [low.min(v), high.max(v)]);
        let size = low.abs().max(high.abs()).max(1e-12);
        let ends = if high - low > 1e-9 * size { [low, high] } else { [low - size, high + size] };
        (low <= high && (ends[1] - ends[0]).is_finite()).then_some(Self { ends, px })
    }

    /// Where a number lies (px).
    pub fn at(&self, value: f64) -> f64 {
        let [low, high] = self.ends;
        round_px(self.px[0] + (value - low) / (high - low) * (self.px[1] - self.px[0]))
    }

    /// At most six round numbers: multiples of one, two or five times a power of ten.
    pub fn ticks(&self) -> Vec<AxisTick> {
        let [low, high] = self.ends;
        let exponent = (0.2 * (high - low)).log10().floor() as i32;
        let steps = [(1.0, exponent), (2.0, exponent), (5.0, exponent), (1.0, exponent + 1)];
        let steps = steps.map(|(digit, exponent)| (digit * 10_f64.powi(exponent), -exponent));
        let fits = |(step, _): &(f64, i32)| high - low <= 5.0 * step * (1.0 + 1e-9);
        let (step, decimals) = steps.into_iter().find(fits).unwrap_or(steps[3]);
        let decimals = decimals.clamp(0, 12) as usize;
        let numbers = (low / step - 1e-9).ceil() as i64..=(high / step + 1e-9).floor() as i64;
        let tick = |number: i64| {
            let value = number as f64 * step;
            AxisTick { at: self.at(value), label: format!("{value:.decimals$}") }
        };
        numbers.map(tick).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(low: f64, high: f64) -> Vec<String> {
        let axis = LinearAxis::over([low, high].into_iter(), [0.0, 100.0]).unwrap();
        axis.ticks().into_iter().map(|tick| tick.label).collect()
    }

    #[test]
    fn ticks_are_few_and_round() {
        assert_eq!(labels(0.0, 10.0), ["0", "2", "4", "6", "8", "10"]);
        assert_eq!(labels(-0.31, 0.42), ["-0.2", "0.0", "0.2", "0.4"]);
        assert_eq!(labels(1.999, 2.004), ["1.999", "2.000", "2.001", "2.002", "2.003", "2.004"]);
        assert_eq!(labels(-1e6, 1e6), ["-1000000", "-500000", "0", "500000", "1000000"]);
        assert!(labels(3.0, 3.0).len() >= 2);
    }

    #[test]
    fn ends_lie_at_the_ends_and_no_number_has_no_axis() {
        let axis = LinearAxis::over([2.0, f64::NAN, -2.0].into_iter(), [300.0, 0.0]).unwrap();
        let places: Vec<f64> = [-2.0, 0.0, 2.0].iter().map(|&v| axis.at(v)).collect();
        assert_eq!(places, [300.0, 150.0, 0.0]);
        assert_eq!(LinearAxis::over([f64::NAN].into_iter(), [0.0, 1.0]), None);
        assert_eq!(LinearAxis::over([-f64::MAX, f64::MAX].into_iter(), [0.0, 1.0]), None);
    }
}
