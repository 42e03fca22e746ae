/// A logarithmic axis on a drawing.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct LogAxis {
    /// Common logarithms of its ends.
    log: [f64; 2],
    /// Where its ends lie (px).
    px: [f64; 2],
}

/// A number at an axis.
#[derive(Debug, Clone, PartialEq)]
pub struct AxisTick {
    /// Where it lies (px).
    pub at: f64,
    /// The number; empty between powers of ten.
    pub label: String,
}

impl LogAxis {
    /// The axis that holds all positive numbers among `values`, begins at a power of ten and
    /// ends at one or little above them; none without a positive number. What lies more than
    /// `most` powers of ten below the end is not on it.
    pub fn over_decades(
        values: impl Iterator<Item = f64>,
        most: i32,
        px: [f64; 2],
    ) -> Option<Self> {
        let [low, high] = range(values)?;
        let end = high.log10().ceil().min(high.log10() + 0.15);
        // Room below the smallest number, so that a bar of it can be seen.
        let start = (low.log10() - 0.1).floor().max(end.ceil() - f64::from(most));
        Some(Self { log: [start.min((end - 1.0).floor()), end], px })
    }

    /// The axis from the smallest to the largest positive number among `values`; none without.
    pub fn over(values: impl Iterator<Item = f64>, px: [f64; 2]) -> Option<Self> {
        let [low, high] = range(values)?.map(f64::log10);
        Some(Self { log: [low, high.max(low + 0.1)], px })
    }

    /// Where a number lies (px); numbers beyond an end lie at it, and zero at the start.
    pub fn at(&self, value: f64) -> f64 {
        let [low, high] = self.log;
        let share = ((value.max(0.0).log10() - low) / (high - low)).clamp(0.0, 1.0);
        round_px(self.px[0] + share * (self.px[1] - self.px[0]))
    }

    /// Whether a number lies on the axis.
    pub fn holds(&self, value: f64) -> bool {
        let [low, high] = self.log;
        (low - 1e-9..=high + 1e-9).contains(&value.log10())
    }

    /// The powers of ten, with their names, and the whole multiples between them, without.
    pub fn ticks(&self) -> Vec<AxisTick> {
        let [low, high] = self.log.map(|end| end.floor() as i32);
        let name = if low < -3 || high > 5 { as_power } else { in_digits };
        let numbers = (low..=high).flat_map(|decade| {
            (1..10).map(move |digit| {
                let label = if digit == 1 { name(decade) } else { String::new() };
                (f64::from(digit) * 10_f64.powi(decade), label)
            })
        });
        let on_axis = numbers.filter(|(value, _)| self.holds(*value));
        on_axis.map(|(value, label)| AxisTick { at: self.at(value), label }).collect()
    }
}

/// A place on a drawing with as many digits as the eye can tell (px).
pub fn round_px(px: f64) -> f64 {
    (10.0 * px).round() / 10.0
}

fn range(values: impl Iterator<Item = f64>) -> Option<[f64; 2]> {
    let positive = values.filter(|v| *v > 0.0 && v.is_finite());
    let fold = |range: Option<[f64; 2]>, v: f64| {
        Some(range.map_or([v, v], |[low, high]| [low.min(v), high.max(v)]))
    };
    positive.fold(None, fold)
}

/// A power of ten as `0.001` or `1000`.
fn in_digits(exponent: i32) -> String {
    let zeros =
        "0".repeat(exponent.unsigned_abs().saturating_sub(u32::from(exponent < 0)) as usize);
    if exponent < 0 { format!("0.{zeros}1") } else { format!("1{zeros}") }
}

/// A power of ten as `10⁻⁴`; one and ten in digits.
fn as_power(exponent: i32) -> String {
    if matches!(exponent, 0 | 1) {
        return in_digits(exponent);
    }
    let digit = |c: char| match c.to_digit(10) {
        Some(d) => ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'][d as usize],
        None => '⁻',
    };
    format!("10{}", exponent.to_string().chars().map(digit).collect::<String>())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Where numbers lie, which is round_px and so compared exactly.
    fn places(axis: LogAxis, values: &[f64]) -> Vec<f64> {
        values.iter().map(|&value| axis.at(value)).collect()
    }

    #[test]
    fn equal_ratios_are_equal_lengths() {
        let axis = LogAxis::over_decades([0.02, 8.0].into_iter(), 8, [300.0, 0.0]).unwrap();
        assert_eq!(places(axis, &[0.01, 0.1, 1.0, 10.0]), [300.0, 200.0, 100.0, 0.0]);
        assert_eq!(places(axis, &[0.0, 1e-9, 1e9]), [300.0, 300.0, 0.0]);
        let short = LogAxis::over_decades([0.02, 1.01].into_iter(), 8, [300.0, 0.0]).unwrap();
        assert!(short.holds(1.3) && !short.holds(1.5));
        let labels: Vec<String> = axis.ticks().into_iter().map(|t| t.label).collect();
        assert_eq!(labels.iter().filter(|l| !l.is_empty()).count(), 4);
        assert_eq!(labels.len(), 28);
    }

    #[test]
    fn an_axis_holds_what_it_can() {
        assert_eq!(LogAxis::over([0.0, f64::NAN, -1.0].into_iter(), [0.0, 1.0]), None);
        let one = LogAxis::over([100.0].into_iter(), [0.0, 50.0]).unwrap();
        assert_eq!(places(one, &[100.0]), [0.0]);
        let deep = LogAxis::over_decades([1e-30, 0.9].into_iter(), 8, [80.0, 0.0]).unwrap();
        assert_eq!(places(deep, &[1e-30, 1e-8, 1e-4]), [80.0, 80.0, 40.0]);
        assert!(!deep.holds(1e-30) && deep.holds(1e-8));
    }

    #[test]
    fn an_axis_names_its_powers_of_ten_in_one_way() {
        let labels = |low: f64, high: f64| -> Vec<String> {
            let axis = LogAxis::over([low, high].into_iter(), [0.0, 1.0]).unwrap();
            axis.ticks().into_iter().map(|t| t.label).filter(|l| !l.is_empty()).collect()
        };
        assert_eq!(labels(1e-3, 1e2), ["0.001", "0.01", "0.1", "1", "10", "100"]);
        assert_eq!(labels(1e-4, 1e2), ["10⁻⁴", "10⁻³", "10⁻²", "10⁻¹", "1", "10", "10²"]);
        assert_eq!(labels(9e9, 2e10), ["10¹⁰"]);
    }
}
