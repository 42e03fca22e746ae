use logs::{Prepared, PreparedJoint, PreparedRun};
use robot::{Joint, Robot};

use crate::thresholds::readiness::ReadinessThresholds;

/// For every joint, the reason why the logs say nothing of it, if there is one.
pub(crate) fn inadequate(
    robot: &Robot,
    prepared: &Prepared,
    t: &ReadinessThresholds,
) -> Vec<Option<String>> {
    let reason = |(j, link): (usize, &robot::Link)| {
        let range = range(prepared, j);
        let least = least_to_show(robot, prepared, j, t);
        if range <= least {
            let unit = if link.joint.kind.is_rotation() { "rad" } else { "m" };
            return Some(format!(
                "the joint moves over {range:.4} {unit} in these logs, at least {least:.3} are needed"
            ));
        }
        let run = prepared.runs.iter().find(|run| is_unrecorded(run, j, moving_range(link, t)))?;
        Some(format!("its effort never changes in {}: it was not recorded there", run.name))
    };
    robot.links().iter().enumerate().map(reason).collect()
}

/// Removes runs in which the effort of a joint is constant while it moves, with a warning for each run. All runs stay
/// where these have half of the samples or more.
pub(crate) fn drop_runs_without_effort(
    robot: &Robot,
    prepared: &mut Prepared,
    t: &ReadinessThresholds,
) -> Vec<String> {
    let joints: Vec<(&str, f64)> = robot
        .links()
        .iter()
        .map(|link| (link.joint.name.as_str(), moving_range(link, t)))
        .collect();
    let joints_without_effort = |run: &PreparedRun| -> Vec<&str> {
        let those =
            joints.iter().enumerate().filter(|(j, (_, least))| is_unrecorded(run, *j, *least));
        those.map(|(_, (name, _))| *name).collect()
    };
    let found: Vec<Vec<&str>> = prepared.runs.iter().map(joints_without_effort).collect();
    let samples = |with: bool| -> usize {
        let those = prepared.runs.iter().zip(&found).filter(|(_, names)| names.is_empty() != with);
        those.map(|(run, _)| run.time.len()).sum()
    };
    if samples(true) >= samples(false) {
        return Vec::new();
    }
    let of = |(run, names): (&PreparedRun, &Vec<&str>)| {
        (!names.is_empty()).then(|| {
            format!(
                "{} was left out: the effort of {} never changes in it, though the arm moves",
                run.name,
                names.join(", ")
            )
        })
    };
    let warnings = prepared.runs.iter().zip(&found).filter_map(of).collect();
    let mut recorded = found.iter().map(Vec::is_empty);
    prepared.runs.retain(|_| recorded.next().unwrap_or(true));
    warnings
}

/// Whether the effort of joint `j` is constant in a run in which it moves over more than `least`.
fn is_unrecorded(run: &PreparedRun, j: usize, least: f64) -> bool {
    let PreparedJoint { q, effort, .. } = &run.joints[j];
    let span = |(low, high): (f64, f64), q: &f64| (low.min(*q), high.max(*q));
    let (low, high) = q.iter().fold((f64::INFINITY, f64::NEG_INFINITY), span);
    let first = effort.first().copied().unwrap_or(0.0);
    high - low > least && effort.iter().all(|e| (e - first).abs() <= f64::EPSILON * first.abs())
}

/// Range of motion above which a joint counts as moved, whatever its encoder is (rad or m).
fn moving_range(link: &robot::Link, t: &ReadinessThresholds) -> f64 {
    t.unmoved_range * full_range(&link.joint)
}

/// Range of motion above which the logs show a joint (rad or m): that of [`moving_range`], or a smaller one that is many steps of
/// its encoder and a part of what other joints move. A joint that is held is shaken by those that move: that of a WAM turns
/// over .04 rad while its shoulder sweeps over 2.2.
fn least_to_show(robot: &Robot, prepared: &Prepared, j: usize, t: &ReadinessThresholds) -> f64 {
    let link = &robot.links()[j];
    let Some(noise) = prepared.noise.get(j) else { return moving_range(link, t) };
    let (step, rms) = (noise.position.step, noise.position_rms(prepared.cutoff_hz));
    if step.is_none() && rms == 0.0 {
        return moving_range(link, t);
    }
    let steps = t.encoder_steps * step.unwrap_or(0.0).max(rms);
    let share = t.least_range.max(t.held_range * largest_share(prepared, robot));
    moving_range(link, t).min(steps.max(share * full_range(&link.joint)))
}

/// Range of motion of joint `j` over all runs (rad or m).
pub(crate) fn range(prepared: &Prepared, j: usize) -> f64 {
    let (low, high) = prepared.span(j);
    high - low
}

/// The largest range of motion of a joint, as a share of its full range (1).
fn largest_share(prepared: &Prepared, robot: &Robot) -> f64 {
    let links = robot.links().iter().enumerate();
    links.map(|(j, link)| range(prepared, j) / full_range(&link.joint)).fold(0.0, f64::max)
}

/// The span of a joint's limits, at most a full turn (rad); one metre for a prismatic
/// joint without limits.
fn full_range(joint: &Joint) -> f64 {
    let unlimited = if joint.kind.is_rotation() { std::f64::consts::TAU } else { 1.0 };
    joint.limits.position.map_or(unlimited, |(low, high)| (high - low).min(unlimited))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A hinge that turns over `range` with an effort that changes by `swing` N m either way.
    fn run(name: &str, samples: usize, range: f64, swing: f64) -> PreparedRun {
        let wave: Vec<f64> = (0..samples).map(|k| (0.1 * k as f64).sin()).collect();
        let q = wave.iter().map(|w| 0.5 * range * w).collect();
        let effort = wave.iter().map(|w| 0.7 + swing * w).collect();
        let time = (0..samples).map(|k| 0.01 * k as f64).collect();
        let joint = PreparedJoint::exact([q, wave.clone(), wave], effort);
        PreparedRun {
            name: name.to_owned(),
            rate_hz: 100.0,
            time,
            session_start_s: 0.0,
            joints: vec![joint],
        }
    }

    fn pendulum() -> Robot {
        let text = r#"<robot name="pendulum"><link name="base"/><link name="arm"><inertial><mass value="2"/>
            <inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
            <joint name="hinge" type="continuous"><parent link="base"/><child link="arm"/></joint></robot>"#;
        Robot::from_urdf(text).unwrap()
    }

    #[test]
    fn a_joint_moves_that_turns_over_a_fiftieth_of_a_turn() {
        let reason = |range| {
            let prepared = Prepared::exact(vec![run("a", 1000, range, 2.0)], 5.0);
            inadequate(&pendulum(), &prepared, &ReadinessThresholds::default()).remove(0)
        };
        assert_eq!(reason(0.13), None);
        let expected = "the joint moves over 0.1200 rad in these logs, at least 0.126 are needed";
        assert_eq!(reason(0.12).as_deref(), Some(expected));
    }

    /// A fine encoder shows a smaller motion: 200 of its steps, and .025 rad at least.
    #[test]
    fn a_fine_encoder_shows_a_small_motion() {
        let reason = |range, step| {
            let mut prepared = Prepared::exact(vec![run("a", 1000, range, 2.0)], 5.0);
            prepared.noise[0].position.step = Some(step);
            inadequate(&pendulum(), &prepared, &ReadinessThresholds::default()).remove(0)
        };
        assert_eq!(reason(0.05, 2e-4), None);
        assert!(reason(0.05, 4e-4).is_some_and(|told| told.contains("at least 0.080")));
        assert!(reason(0.024, 1e-6).is_some_and(|told| told.contains("at least 0.025")));
        assert!(reason(0.12, 0.1).is_some_and(|told| told.contains("at least 0.126")));
    }

    #[test]
    fn a_short_run_without_effort_is_left_out_and_a_long_one_spoils_the_joint() {
        let observe = |samples| {
            let runs = vec![run("a", 1000, 1.0, 2.0), run("b", samples, 1.0, 0.0)];
            let mut prepared = Prepared::exact(runs, 5.0);
            let warnings = drop_runs_without_effort(
                &pendulum(),
                &mut prepared,
                &ReadinessThresholds::default(),
            );
            (
                warnings,
                prepared.runs.len(),
                inadequate(&pendulum(), &prepared, &ReadinessThresholds::default()).remove(0),
            )
        };
        let expected =
            "b was left out: the effort of hinge never changes in it, though the arm moves"
                .to_owned();
        assert_eq!(observe(900), (vec![expected], 1, None));
        let expected = "its effort never changes in b: it was not recorded there".to_owned();
        assert_eq!(observe(1100), (Vec::new(), 2, Some(expected)));
    }
}
