use diagnosis::Estimate;

use pages::{decimals_for, unit, with_decimals};

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
    let places =
        decimals_for(0.5 * (high - low)).unwrap_or(decimals_for(estimate.value).unwrap_or(0));
    if number.is_finite() { with_decimals(number, places) } else { "-".to_owned() }
}

#[cfg(test)]
mod tests {
    use super::*;

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
}
