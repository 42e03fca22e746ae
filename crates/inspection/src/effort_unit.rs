use crate::fit::Drive;
use crate::judge::Judge;
use crate::log_reading::{LogReading, is_another_unit};
use crate::observation::JointUnit;
use crate::pooled::own_factor;

/// Unit of the efforts, where their factors to the nominal torque are such as no error of a drive makes.
///
/// Of joints that show it: a power of a thousand where most are near the same one (mN m), what errs about it being torque
/// constants; else the same factor where all are alike; else each its own (currents of motors of several sizes).
pub(crate) fn effort_unit(judge: &Judge) -> Option<LogReading> {
    let t = judge.thresholds;
    let all = factors(judge);
    let known: Vec<f64> = all.iter().copied().flatten().collect();
    let [low, high] = t.drive_gain;
    let is_unit = |c: &f64| *c > 0.0 && (*c > high || *c < low);
    let mut units: Vec<f64> = known.iter().copied().filter(is_unit).collect();
    let are_most = 2 * units.len() > known.len();
    let middle = median(&mut units)?;
    let is_alike = |c: &f64| (c / middle).ln().abs() < t.alike.ln_1p();
    if let Some(usual) = power_of_thousand(&known, t.alike) {
        let is_usual = |c: f64| (c / usual > low && c / usual < high) || is_unit(&c);
        let own = |c: &Option<f64>| Some(if c.is_none_or(is_usual) { usual } else { 1.0 });
        return Some(LogReading::Unit(all.iter().map(own).collect()));
    }
    if known.iter().all(is_alike) {
        return Some(LogReading::Unit(vec![Some(middle); all.len()]));
    }
    let own = |c: &Option<f64>| match c {
        Some(c) if are_most || is_unit(c) => Some(*c),
        None if are_most => None,
        _ => Some(1.0),
    };
    Some(LogReading::Unit(all.iter().map(own).collect()))
}

/// Logged effort over nominal torque of the joints that show it, beside friction and rotor.
fn factors(judge: &Judge) -> Vec<Option<f64>> {
    let t = judge.thresholds;
    let free = judge.fits(&judge.samples, &judge.whole, Drive { gain: [0.0, f64::INFINITY] });
    let none = judge.fits(&judge.samples, &judge.whole, Drive { gain: [0.0, 0.0] });
    let shows = |j: usize| {
        let (share, friction_alone) = (free[j].share, none[j].share);
        share < t.mended && friction_alone > t.shows_unit * (share + judge.floors[j])
    };
    (0..free.len()).map(|j| shows(j).then_some(free[j].coefficients[0])).collect()
}

/// The power of a thousand, other than one, that more than half of the factors are near to.
fn power_of_thousand(factors: &[f64], nearly: f64) -> Option<f64> {
    let power = |c: f64| 1000_f64.powf(c.log(1000.0).round());
    let usual = power(median(&mut factors.to_vec())?);
    let is_near = |c: &&f64| (**c / usual).ln().abs() < nearly.ln_1p();
    let near = factors.iter().filter(is_near).count();
    (is_another_unit(usual) && 2 * near > factors.len()).then_some(usual)
}

fn median(values: &mut [f64]) -> Option<f64> {
    values.sort_unstable_by(f64::total_cmp);
    values.get(values.len() / 2).copied()
}

/// The unit of each joint of a reading, with the standard error of the factors that these samples show.
pub(crate) fn joint_units(judge: &Judge, reading: &LogReading) -> Vec<JointUnit> {
    let LogReading::Unit(units) = reading else { return Vec::new() };
    let nothing = vec![0.0; judge.whole.len()];
    let rows = judge.thresholds.rows_of_independent;
    let is_common = |factor: f64| units.iter().filter(|u| **u == Some(factor)).count() > 1;
    let unit = |(joint, factor): (usize, &Option<f64>)| {
        let own = factor.is_some_and(|f| !is_common(f));
        let own = own.then(|| own_factor(&judge.samples, &nothing, &judge.whole, joint, rows));
        let standard_error = own.flatten().map(|[_, error]| error);
        let is_another = factor.is_none_or(is_another_unit);
        is_another.then_some(JointUnit { joint, factor: *factor, standard_error })
    };
    units.iter().enumerate().filter_map(unit).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn units_in_use_are_powers_of_a_thousand() {
        assert_eq!(power_of_thousand(&[1040.0, 960.0, 1400.0], 0.15), Some(1e3));
        assert_eq!(power_of_thousand(&[1.04e-3, 0.97e-3], 0.15), Some(1e-3));
        assert_eq!(power_of_thousand(&[400.0, 420.0], 0.15), None);
        assert_eq!(power_of_thousand(&[0.1, 0.099, 0.101], 0.15), None);
        assert_eq!(power_of_thousand(&[1.1, 0.9], 0.15), None);
        assert_eq!(power_of_thousand(&[], 0.15), None);
    }
}
