use crate::motion_samples::MotionSamples;
use crate::observation::{Observation, ObservationKind, Spoils};
use crate::thresholds::InspectionThresholds;

/// Runs whose clock goes otherwise than that of the others: every velocity of such a run is the same factor off the
/// derivative of its position, while those of another run agree with theirs.
///
/// ```text
/// s[j][r] = sum v dq/dt / sum (dq/dt)^2  over the samples of run r,   factor[r] = median over j of s[j][r]
/// ```
///
/// The velocities of the other runs show that the columns have the unit of the positions; so one of the clocks is wrong.
pub(crate) fn clocks_of_runs(
    samples: &MotionSamples,
    runs: usize,
    t: &InspectionThresholds,
) -> Vec<Observation> {
    let factors: Vec<Option<f64>> = (0..runs).map(|run| factor(samples, run, t)).collect();
    let is_right = |factor: &f64| (factor - 1.0).abs() < t.same_velocity_factor;
    if !factors.iter().flatten().any(is_right) {
        return Vec::new();
    }
    let wrong = |(run, factor): (usize, &Option<f64>)| {
        let factor = factor.filter(|factor| (factor - 1.0).abs() > t.velocity_factor)?;
        let joints = (0..samples.joints).collect();
        let kind = ObservationKind::OtherClock { factor };
        Some(Observation::of_runs(kind, joints, vec![run], Spoils::Everything))
    };
    factors.iter().enumerate().filter_map(wrong).collect()
}

/// Velocity per derivative of the position in a run, where every joint that moves has the same.
fn factor(samples: &MotionSamples, run: usize, t: &InspectionThresholds) -> Option<f64> {
    let of = |joint: usize| {
        let v = samples.column_of_run(&samples.velocity, joint, run);
        let d = samples.column_of_run(&samples.motion[1], joint, run);
        let pairs: Vec<(f64, f64)> = v.into_iter().zip(d).filter(|(v, _)| v.is_finite()).collect();
        let sum = |f: fn(&(f64, f64)) -> f64| pairs.iter().map(f).sum::<f64>();
        let (vv, vd, dd) = (sum(|p| p.0 * p.0), sum(|p| p.0 * p.1), sum(|p| p.1 * p.1));
        let is_close = vd > t.close_velocity_correlation * (vv * dd).sqrt() && dd > 0.0;
        (is_close && pairs.len() >= t.rows_of_clock).then_some(vd / dd)
    };
    let mut all: Vec<f64> = (0..samples.joints).filter_map(of).collect();
    all.sort_unstable_by(f64::total_cmp);
    let middle = *all.get(all.len() / 2)?;
    let is_same = |factor: &f64| (factor / middle - 1.0).abs() < t.same_velocity_factor;
    (all.len() >= samples.joints.min(2) && all.iter().all(is_same)).then_some(middle)
}

#[cfg(test)]
mod tests {
    use logs::Run;

    use crate::inspect::inspect;
    use crate::mend::correct;
    use crate::observation::ObservationKind;
    use crate::testing::{pendulum, swing};

    /// Two runs with velocities, of which the second has its times multiplied by `factor`.
    fn runs(factor: f64) -> Vec<Run> {
        let mut runs = vec![swing(0.3), swing(1.1)];
        for run in &mut runs {
            let (time, q) = (run.time.clone(), run.joints[0].position.clone());
            let slope = |k: usize| {
                let (a, b) = (k.saturating_sub(1), (k + 1).min(q.len() - 1));
                (q[b] - q[a]) / (time[b] - time[a])
            };
            run.joints[0].velocity = Some((0..q.len()).map(slope).collect());
        }
        runs[1].time.iter_mut().for_each(|t| *t *= factor);
        runs
    }

    #[test]
    fn a_run_with_another_clock_is_told_and_read_right() {
        for factor in [1.1, 0.8, 2.0] {
            let found = inspect(&pendulum(), &runs(factor));
            let ObservationKind::OtherClock { factor: told } = found[0].kind else {
                panic!("{found:?}")
            };
            assert!((told / factor - 1.0).abs() < 1e-3 && found[0].runs == [1], "{found:?}");
            let read = correct(&pendulum(), &runs(factor)).runs.unwrap();
            let [right, read] = [runs(1.0), read].map(|runs| *runs[1].time.last().unwrap());
            assert!((read / right - 1.0).abs() < 1e-3, "{read} {right}");
        }
    }

    /// Velocities of both runs that are off alike may be of another unit.
    #[test]
    fn clocks_that_agree_are_not_told_apart() {
        let is_clock =
            |o: &crate::Observation| matches!(o.kind, ObservationKind::OtherClock { .. });
        assert!(!inspect(&pendulum(), &runs(1.0)).iter().any(is_clock));
        let mut both = runs(1.0);
        both.iter_mut().for_each(|run| run.time.iter_mut().for_each(|t| *t *= 1.1));
        assert!(!inspect(&pendulum(), &both).iter().any(is_clock));
    }
}
