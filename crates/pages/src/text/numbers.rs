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
    with_decimals(value, digits as i32 - 1 - exponent)
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
pub fn percent_range(shares: &[f64]) -> String {
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

/// Decimals that show two significant digits of `size`.
pub fn decimals_for(size: f64) -> Option<i32> {
    (size.is_finite() && size.abs() > f64::MIN_POSITIVE)
        .then(|| 1 - size.abs().log10().floor() as i32)
}

/// A number with so many decimals, round_px to tens or hundreds when there are fewer than none.
pub fn with_decimals(value: f64, places: i32) -> String {
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
    fn shares_near_the_ends_are_not_rounded_to_them() {
        assert_eq!(percent(0.004), "0.4 %");
        assert_eq!(percent(0.997), "99.7 %");
        assert_eq!(percent(1.0), "100 %");
        assert_eq!(percent(-0.31), "-31 %");
        assert_eq!(percent(f64::NAN), "-");
        assert_eq!(percent_range(&[0.2, f64::NAN, 0.114]), "11-20 %");
        assert_eq!((percent_range(&[0.2]), percent_range(&[])), ("20 %".into(), "-".into()));
    }
}
