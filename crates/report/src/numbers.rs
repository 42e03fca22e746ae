use diagnosis::Estimate;

/// A number with so many significant digits: `12300`, `1.23`, `0.0123`, `1.2e-5`.
///
/// A value that is not a number is `-`.
pub fn significant(value: f64, digits: usize) -> String {
    if !value.is_finite() {
        return "-".to_owned();
    }
    let size = value.abs();
    if size < f64::MIN_POSITIVE {
        return "0".to_owned();
    }
    let exponent = size.log10().floor() as i32;
    if !(-4..6).contains(&exponent) {
        return format!("{value:.*e}", digits.saturating_sub(1));
    }
    decimals(value, digits as i32 - 1 - exponent)
}

/// A share as a percentage: `41 %`, `0.4 %`, `> 99.9 %`.
pub fn percent(share: f64) -> String {
    let hundredths = 100.0 * share;
    match hundredths.abs() {
        x if !x.is_finite() => "-".to_owned(),
        x if x < 0.05 => "0 %".to_owned(),
        x if x < 9.95 => format!("{hundredths:.1} %"),
        x if (99.5..99.95).contains(&x) => format!("{hundredths:.1} %"),
        _ => format!("{hundredths:.0} %"),
    }
}

/// The least and the largest of some shares: `91-96 %`.
pub(crate) fn percents(shares: &[f64]) -> String {
    let finite = shares.iter().copied().filter(|share| share.is_finite());
    let low = finite.clone().reduce(f64::min).map_or("-".to_owned(), percent);
    let high = finite.reduce(f64::max).map_or("-".to_owned(), percent);
    if low == high { low } else { format!("{}-{high}", low.trim_end_matches(" %")) }
}

/// A unit as it is printed: `N m s/rad` becomes `N·m·s/rad`, `kg m^2` `kg·m²`.
/// The unit of a pure number is nothing.
pub fn unit(plain: &str) -> String {
    if plain == "1" {
        return String::new();
    }
    plain.replace("^2", "²").replace("^3", "³").replace(' ', "·")
}

/// Value, interval and unit with as many decimals as the interval bears:
/// `3.21 N·m (3.05 to 3.37)`; words where the logs do not narrow it down.
pub fn interval(estimate: &Estimate) -> String {
    if !estimate.determined {
        return "not determined by this log".to_owned();
    }
    let [low, high] = estimate.ci95.map(|end| as_precise(estimate, end));
    format!("{} ({low} to {high})", value(estimate))
}

/// Value and unit of [`interval`].
pub(crate) fn value(estimate: &Estimate) -> String {
    let unit = unit(estimate.unit);
    let space = if unit.is_empty() { "" } else { " " };
    format!("{}{space}{unit}", as_precise(estimate, estimate.value))
}

/// A number with as many decimals as the interval of the estimate bears.
fn as_precise(estimate: &Estimate, number: f64) -> String {
    let [low, high] = estimate.ci95;
    let places = places(0.5 * (high - low)).unwrap_or(places(estimate.value).unwrap_or(0));
    if number.is_finite() { decimals(number, places) } else { "-".to_owned() }
}

/// Decimals that show two significant digits of `size`.
fn places(size: f64) -> Option<i32> {
    (size.is_finite() && size.abs() > f64::MIN_POSITIVE)
        .then(|| 1 - size.abs().log10().floor() as i32)
}

/// A number with so many decimals, rounded to tens or hundreds when there are fewer than none.
fn decimals(value: f64, places: i32) -> String {
    let text = if places >= 0 {
        format!("{value:.*}", places.min(12) as usize)
    } else {
        let step = 10_f64.powi(-places);
        format!("{:.0}", (value / step).round() * step)
    };
    let is_zero = text.chars().all(|c| matches!(c, '-' | '0' | '.'));
    if is_zero { text.trim_start_matches('-').to_owned() } else { text }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn significant_digits_are_kept_over_all_sizes() {
        let cases = [
            (0.0, "0"),
            (12_345.6, "12300"),
            (1.2345, "1.23"),
            (-0.012_345, "-0.0123"),
            (1.234e-9, "1.23e-9"),
            (f64::NAN, "-"),
        ];
        for (value, expected) in cases {
            assert_eq!(significant(value, 3), expected);
        }
    }

    #[test]
    fn an_interval_sets_the_number_of_decimals() {
        let estimate = |value, ci95, unit| Estimate {
            name: "level",
            value,
            ci95,
            noise95: ci95,
            nominal: 0.0,
            unit,
            determined: true,
        };
        assert_eq!(interval(&estimate(3.2123, [3.05, 3.37], "N m")), "3.21 N·m (3.05 to 3.37)");
        assert_eq!(interval(&estimate(1.0, [0.7, 1.3], "1")), "1.00 (0.70 to 1.30)");
        assert_eq!(
            interval(&estimate(9_876.0, [9_000.0, 10_752.0], "N")),
            "9880 N (9000 to 10750)"
        );
        assert_eq!(interval(&estimate(2.0, [2.0, 2.0], "m")), "2.0 m (2.0 to 2.0)");
        let open = Estimate { determined: false, ..estimate(0.0, [-0.1, 0.1], "rad") };
        assert_eq!(interval(&open), "not determined by this log");
    }

    #[test]
    fn shares_near_the_ends_are_not_rounded_to_them() {
        assert_eq!(percent(0.004), "0.4 %");
        assert_eq!(percent(0.997), "99.7 %");
        assert_eq!(percent(1.0), "100 %");
        assert_eq!(percent(-0.31), "-31 %");
        assert_eq!(percent(f64::NAN), "-");
        assert_eq!(percents(&[0.2, f64::NAN, 0.114]), "11-20 %");
        assert_eq!((percents(&[0.2]), percents(&[])), ("20 %".into(), "-".into()));
    }
}
