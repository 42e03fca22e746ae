use logs::Run;
use robot::Robot;

use crate::{Observation, ObservationKind, Spoils, Thresholds};

/// How near to its limit an effort is at it, as a share of the limit.
const NEAR: f64 = 1e-3;

/// Efforts of more than so many limits are not clipped there.
const BEYOND: f64 = 1.05;

/// Fewest values of an effort that has no steps to speak of.
const VALUES: usize = 20;

/// Joints whose effort is at its limit for much of the time: the description's, or the extreme value at which
/// it is clipped both ways.
pub(crate) fn at_limits(robot: &Robot, runs: &[Run], t: &Thresholds) -> Vec<Observation> {
    let joint = |j: usize| {
        let all = || runs.iter().filter_map(move |r| r.joints.get(j)).flat_map(|c| &c.effort);
        let count = all().count();
        let size = all().fold(0.0_f64, |most, e| most.max(e.abs()));
        let stated = robot.links()[j]
            .joint
            .limits
            .effort
            .filter(|l| *l > 0.0 && *l <= size && size <= BEYOND * l);
        let limit = stated.unwrap_or(size);
        let at = |e: &&f64| e.abs() >= limit * (1.0 - NEAR);
        let share = all().filter(at).count() as f64 / count.max(1) as f64;
        let both = stated.is_some() || {
            let low = all().filter(|e| **e <= -limit * (1.0 - NEAR)).count();
            let high = all().filter(|e| **e >= limit * (1.0 - NEAR)).count();
            low.min(high) > 2
        };
        let told = share >= t.at_limit && both && values(all().copied()) >= VALUES;
        told.then(|| Observation {
            kind: ObservationKind::AtLimit { share, limit },
            or: Vec::new(),
            joints: vec![j],
            runs: (0..runs.len()).collect(),
            stretches: Vec::new(),
            spoils: Spoils::Joints,
            evidence: None,
        })
    };
    (0..robot.joint_count()).filter_map(joint).collect()
}

/// Number of different values, counted up to a few dozen.
fn values(all: impl Iterator<Item = f64>) -> usize {
    let mut found: Vec<u64> = Vec::new();
    for value in all {
        if found.len() > VALUES {
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
        let (robot, t, mut run) = (pendulum(), Thresholds::default(), swing(0.3));
        assert_eq!(at_limits(&robot, &[run.clone()], &t), []);
        run.joints[0].effort.iter_mut().for_each(|e| *e = e.clamp(-3.0, 3.0));
        let told = at_limits(&robot, &[run], &t);
        let ObservationKind::AtLimit { share, limit } = told[0].kind else { panic!("{told:?}") };
        assert!(share > 0.4 && (limit - 3.0).abs() < 1e-9);
    }
}
