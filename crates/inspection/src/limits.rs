use logs::Run;
use robot::Robot;

use crate::observation::{Observation, ObservationKind, Spoils};
use crate::thresholds::InspectionThresholds;

/// Joints whose effort is at its limit for much of the time: the described limit, or an extreme value at which the effort is
/// clipped both ways.
pub(crate) fn at_limits(robot: &Robot, runs: &[Run], t: &InspectionThresholds) -> Vec<Observation> {
    let joint = |j: usize| {
        let all = || runs.iter().filter_map(move |r| r.joints.get(j)).flat_map(|c| &c.effort);
        let count = all().count();
        let size = all().fold(0.0_f64, |most, e| most.max(e.abs()));
        let stated = robot.links()[j]
            .joint
            .limits
            .effort
            .filter(|l| *l > 0.0 && *l <= size && size <= t.beyond_limit * l);
        let limit = stated.unwrap_or(size);
        let at = |e: &&f64| e.abs() >= limit * (1.0 - t.near_limit);
        let share = all().filter(at).count() as f64 / count.max(1) as f64;
        let both = stated.is_some() || {
            let low = all().filter(|e| **e <= -limit * (1.0 - t.near_limit)).count();
            let high = all().filter(|e| **e >= limit * (1.0 - t.near_limit)).count();
            low.min(high) > t.clipped_rows
        };
        let is_clipped = share >= t.at_limit
            && both
            && count_values(all().copied(), t.fewest_values) >= t.fewest_values;
        let kind = ObservationKind::AtLimit { share, limit };
        let all = (0..runs.len()).collect();
        is_clipped.then(|| Observation::of_runs(kind, vec![j], all, Spoils::Joints))
    };
    (0..robot.joint_count()).filter_map(joint).collect()
}

/// Number of different values, counted until it exceeds `most`.
fn count_values(all: impl Iterator<Item = f64>, most: usize) -> usize {
    let mut found: Vec<u64> = Vec::new();
    for value in all {
        if found.len() > most {
            break;
        }
        if !found.contains(&value.to_bits()) {
            found.push(value.to_bits());
        }
    }
    found.len()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::testing::{pendulum, swing};

    #[test]
    fn an_effort_that_is_clipped_for_half_of_the_time_is_told() {
        let (robot, t, mut run) = (pendulum(), InspectionThresholds::default(), swing(0.3));
        assert_eq!(at_limits(&robot, &[run.clone()], &t), []);
        run.joints[0].effort.iter_mut().for_each(|e| *e = e.clamp(-3.0, 3.0));
        let observations = at_limits(&robot, &[run], &t);
        let ObservationKind::AtLimit { share, limit } = observations[0].kind else {
            panic!("{observations:?}")
        };
        assert!(share > 0.4 && (limit - 3.0).abs() < 1e-9);
    }
}
