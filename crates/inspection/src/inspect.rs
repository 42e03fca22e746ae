use logs::Run;
use robot::Robot;

use crate::another_robot::another_robot;
use crate::clock::clock;
use crate::clocks_of_runs::clocks_of_runs;
use crate::effort_shift::effort_shift;
use crate::judge::Judge;
use crate::limits::at_limits;
use crate::moments::moments;
use crate::motion_samples::Thinned;
use crate::normalised::normalised_positions;
use crate::observation::{Observation, ObservationKind, Spoils};
use crate::overlaps::overlaps;
use crate::pieces::pieces;
use crate::readings::readings;
use crate::thresholds::InspectionThresholds;
use crate::zeros::zeros_of_runs;

/// Looks for errors of logs as a whole, before causes are sought.
///
/// Joints of the runs are in the order of the robot, as [`logs::read_run`] gives them. Runs whose signals have
/// not all the length of their time, or that have other joints, are skipped: [`logs::prepare`] refuses them.
pub fn inspect(robot: &Robot, runs: &[Run]) -> Vec<Observation> {
    inspect_with(robot, runs, &InspectionThresholds::default())
}

/// [`inspect`] with other thresholds.
pub fn inspect_with(
    robot: &Robot,
    runs: &[Run],
    thresholds: &InspectionThresholds,
) -> Vec<Observation> {
    if runs.is_empty() || !runs.iter().all(|run| is_whole(robot, run)) {
        return Vec::new();
    }
    let mut moments = moments(robot, runs, thresholds);
    let mut observations = moments.found;
    moments.corrected.iter_mut().for_each(|run| remove_described_effects(robot, run));
    observations.extend(overlaps(runs, thresholds));
    observations.extend(at_limits(robot, runs, thresholds));
    observations.extend(normalised_positions(robot, runs, thresholds));
    if let Some(wide) = wide_inertias(robot, runs.len()) {
        observations.push(wide);
        return observations;
    }
    let all = moments.corrected.iter().enumerate().zip(&moments.left_out);
    let pieces: Vec<_> =
        all.flat_map(|(run, left_out)| pieces(run, left_out, thresholds)).collect();
    let Some(thinned) = Thinned::of(runs, &pieces, thresholds) else { return observations };
    let samples = thinned.samples(0, 0);
    if samples.rows() < thresholds.least_rows {
        return observations;
    }
    let other_clocks = clocks_of_runs(&samples, runs.len(), thresholds);
    if !other_clocks.is_empty() {
        observations.extend(other_clocks);
        return observations;
    }
    let mut judge = Judge::new(robot, thresholds, samples);
    observations.extend(clock(robot, &mut judge, runs.len()));
    let errors = readings(&mut judge, runs.len());
    // With the description of another arm, a reading may improve a joint by chance; a true one leaves no contradiction.
    let errors = another_robot(&judge, runs.len()).map_or(errors, |other| vec![other]);
    // An effort that is computed from a goal is of the rows of the motion, and not shifted against it.
    let first = errors.first().filter(|o| o.kind != ObservationKind::GoalVelocity);
    let gain = first.and_then(|o| o.evidence).map(|e| e.gain);
    if let Some(gain) = gain
        && let Some(shift) = effort_shift(robot, &thinned, thresholds, gain, runs.len())
    {
        observations.push(shift);
        return observations;
    }
    if errors.is_empty() {
        observations.extend(zeros_of_runs(&judge, runs.len()));
    }
    observations.extend(errors);
    observations
}

/// Inertias in another unit, where the description has some: no torque of such a model says anything of logs.
fn wide_inertias(robot: &Robot, runs: usize) -> Option<Observation> {
    let is_wide = !robot.wide_inertias().is_empty();
    let joints = (0..robot.joint_count()).collect();
    let kind = ObservationKind::InertiaUnit;
    is_wide.then(|| Observation::of_runs(kind, joints, (0..runs).collect(), Spoils::Everything))
}

fn is_whole(robot: &Robot, run: &Run) -> bool {
    let n = run.time.len();
    let right = |joint: &logs::Channels| {
        let whole = |x: &[f64]| x.len() == n && x.iter().all(|v| v.is_finite());
        whole(&joint.position)
            && whole(&joint.effort)
            && joint.velocity.as_ref().is_none_or(|v| v.len() == n)
    };
    n > 1
        && run.joints.len() == robot.joint_count()
        && run.joints.iter().all(right)
        && run.time.windows(2).all(|t| t[1] > t[0])
}

/// Removes the described gear ratios, zeros and torque constants from the signals:
///
/// ```text
/// q = ratio (q_log - offset),   qd = ratio qd_log,   tau = effort_log / (ratio gain)
/// ```
fn remove_described_effects(robot: &Robot, run: &mut Run) {
    for (link, joint) in robot.links().iter().zip(&mut run.joints) {
        let drive = &link.actuator;
        let (ratio, effort) =
            (drive.transmission_ratio, drive.transmission_ratio * drive.torque_gain);
        joint.position.iter_mut().for_each(|q| *q = ratio * (*q - drive.encoder_offset));
        joint.velocity.iter_mut().flatten().for_each(|v| *v *= ratio);
        if effort.abs() > 0.0 {
            joint.effort.iter_mut().for_each(|e| *e /= effort);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    use crate::mend::correct;
    use crate::testing::{pendulum, swing};

    fn observe(change: fn(&mut Run)) -> Vec<Observation> {
        let mut runs = vec![swing(0.3), swing(1.1)];
        runs.iter_mut().for_each(change);
        inspect(&pendulum(), &runs)
    }

    #[test]
    fn nothing_is_told_of_a_pendulum_as_it_is() {
        assert_eq!(observe(|_| {}), []);
    }

    /// A turned effort and a turned position are the same for a pendulum.
    #[test]
    fn a_turned_sign_is_told() {
        let found = observe(|run| run.joints[0].effort.iter_mut().for_each(|e| *e = -*e));
        let kinds =
            |o: &Observation| [o.kind].into_iter().chain(o.or.iter().map(|r| r.kind)).collect();
        let kinds: Vec<ObservationKind> = found.first().map(kinds).unwrap_or_default();
        assert!(kinds.contains(&ObservationKind::EffortSign), "{found:?}");
        assert!(kinds.contains(&ObservationKind::PositionSign), "{found:?}");
    }

    #[test]
    fn time_in_milliseconds_is_told_with_its_factor() {
        let found = observe(|run| run.time.iter_mut().for_each(|t| *t *= 1e3));
        let ObservationKind::TimeUnit { factor } = found[0].kind else { panic!("{found:?}") };
        assert!((factor / 1e3 - 1.0).abs() < 0.01 && found[0].spoils == Spoils::Everything);
    }

    #[test]
    fn a_torque_constant_that_is_off_by_a_third_is_no_unit() {
        assert_eq!(observe(|run| run.joints[0].effort.iter_mut().for_each(|e| *e *= 1.33)), []);
    }

    #[test]
    fn a_zero_that_differs_from_run_to_run_is_told_with_its_size_and_taken_off() {
        let mut runs = vec![swing(0.3), swing(1.1), swing(2.0)];
        for (run, zero) in runs.iter_mut().zip([0.5, 1.5, -0.2]) {
            run.joints[0].effort.iter_mut().for_each(|e| *e += zero);
        }
        let found = inspect(&pendulum(), &runs);
        let [Observation { kind: ObservationKind::ZerosOfRuns, zeros, .. }] = &found[..] else {
            panic!("{found:?}")
        };
        for (zero, put_in) in zeros.iter().zip([0.5, 1.5, -0.2]) {
            assert!((zero.offset - put_in).abs() < 0.02, "{zeros:?}");
        }
        let sentence = found[0].sentence(&pendulum(), &runs);
        let begin = "The zero of the effort of joint hinge differs from run to run: 0.50";
        assert!(sentence.starts_with(begin), "{sentence}");
        let read = correct(&pendulum(), &runs).runs.unwrap();
        let clean = swing(1.1).joints.remove(0).effort;
        let off = read[1].joints[0].effort.iter().zip(&clean).map(|(a, b)| (a - b).abs());
        assert!(off.fold(0.0, f64::max) < 0.02);
    }

    /// An offset of all runs is a cause for the search; a wrong mass about two postures leaves two offsets.
    #[test]
    fn one_zero_and_a_wrong_mass_are_no_zeros_of_runs() {
        assert_eq!(observe(|run| run.joints[0].effort.iter_mut().for_each(|e| *e += 0.7)), []);
        let about = |posture: f64, phase: f64| {
            let mut run = swing(phase);
            let joint = &mut run.joints[0];
            for (q, effort) in joint.position.iter_mut().zip(&mut joint.effort) {
                // A tenth of the motion, and a centre of mass that lies off the line of the description.
                *effort = 0.1 * (*effort - 9.81 * q.sin());
                *q = posture + 0.1 * *q;
                *effort += 9.81 * (q.sin() + 0.3 * q.cos());
            }
            joint.velocity.iter_mut().flatten().for_each(|v| *v *= 0.1);
            run
        };
        assert_eq!(inspect(&pendulum(), &[about(0.5, 0.3), about(PI - 0.5, 1.1)]), []);
    }

    #[test]
    fn runs_that_do_not_fit_the_robot_are_not_looked_at() {
        assert_eq!(observe(|run| run.joints[0].effort.truncate(10)), []);
        assert_eq!(observe(|run| run.joints.clear()), []);
        assert_eq!(inspect(&pendulum(), &[]), []);
    }

    #[test]
    fn a_sentence_names_joint_numbers_and_remedy() {
        let mut runs = vec![swing(0.3)];
        runs[0].joints[0].position[2000] += 0.05;
        let found = inspect(&pendulum(), &runs);
        let sentence = found[0].sentence(&pendulum(), &runs);
        let expected = "The position of joint hinge has single samples that are off: 1, by up to 0.050 rad (run \
                        swing 0.3, 8.000 s). Leave these samples out.";
        assert_eq!(sentence, expected);
    }
}
