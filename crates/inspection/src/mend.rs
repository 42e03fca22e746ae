use std::f64::consts::PI;

use dynamics::Dynamics;
use logs::{Channels, Run};
use robot::{Actuator, PdGain, Robot};

use crate::inspect::inspect_with;
use crate::observation::{CountedTogether, Observation, ObservationKind, Spoils};
use crate::pieces::usual_step;
use crate::thresholds::InspectionThresholds;

/// Logs with the errors corrected that have one possible correction.
#[derive(Debug, Clone, PartialEq)]
pub struct CorrectedLogs {
    /// The corrected runs, where anything is corrected.
    pub runs: Option<Vec<Run>>,
    /// The errors that are corrected.
    pub mended: Vec<Observation>,
    /// The errors that the runs still have.
    pub left: Vec<Observation>,
}

/// Corrects errors that spoil whole logs and have one possible correction: a turned sign, exchanged columns, another unit,
/// degrees, efforts that lack the torque of gravity, a position loop that follows the velocity of its goal.
///
/// Logs that are still spoilt after the corrections stay as they are: these errors were not the cause then.
pub fn correct(robot: &Robot, runs: &[Run]) -> CorrectedLogs {
    correct_with(robot, runs, &InspectionThresholds::default())
}

/// [`correct`] with other thresholds.
pub fn correct_with(robot: &Robot, runs: &[Run], t: &InspectionThresholds) -> CorrectedLogs {
    let seen = inspect_with(robot, runs, t);
    let as_they_stand = |seen| CorrectedLogs { runs: None, mended: Vec::new(), left: seen };
    if !seen.iter().any(Observation::spoils_whole_logs) {
        return as_they_stand(seen);
    }
    let mut read = runs.to_vec();
    let is_mended = |o: &&Observation| o.spoils_whole_logs() && o.mend(robot, &mut read, t);
    let mended: Vec<Observation> = seen.iter().filter(is_mended).cloned().collect();
    if mended.is_empty() {
        return as_they_stand(seen);
    }
    let mut left = inspect_with(robot, &read, t);
    if left.iter().any(Observation::spoils_whole_logs) {
        return as_they_stand(seen);
    }
    left.extend(mended.iter().filter_map(Observation::unknown_unit));
    CorrectedLogs { runs: Some(read), mended, left }
}

impl Observation {
    fn spoils_whole_logs(&self) -> bool {
        let is_of_the_arm = !matches!(self.kind, ObservationKind::AtLimit { .. });
        is_of_the_arm && matches!(self.spoils, Spoils::Joints | Spoils::Everything)
    }

    /// The joints whose unit their motion does not show, where those that show it have each their own.
    fn unknown_unit(&self) -> Option<Self> {
        let unknown = self.units.iter().filter(|unit| unit.factor.is_none());
        let joints: Vec<usize> = unknown.map(|unit| unit.joint).collect();
        (!joints.is_empty()).then(|| {
            Self::of_runs(ObservationKind::UnknownUnit, joints, self.runs.clone(), Spoils::Nothing)
        })
    }

    /// Corrects the runs, if there is one possible correction; whether there is.
    fn mend(&self, robot: &Robot, runs: &mut [Run], t: &InspectionThresholds) -> bool {
        use ObservationKind as K;
        if !self.or.is_empty() {
            return false;
        }
        match (self.kind, self.joints.as_slice()) {
            (K::EffortSign, joints) => at(runs, joints, |joint| scale_effort(joint, -1.0)),
            (K::PositionSign, joints) => at(runs, joints, |joint| scale_motion(joint, -1.0)),
            (K::AxisSign, joints) => at(runs, joints, |joint| {
                scale_motion(joint, -1.0);
                scale_effort(joint, -1.0);
            }),
            (K::Degrees, joints) => at(runs, joints, |joint| scale_motion(joint, PI / 180.0)),
            (K::EffortUnit { factor: middle }, _) => {
                for unit in &self.units {
                    let factor = unit.factor.unwrap_or(middle);
                    at(runs, &[unit.joint], |joint| scale_effort(joint, 1.0 / factor));
                }
            }
            (K::TimeUnit { factor }, _) => {
                let Some(unit) = power_of_ten(factor, t.time_unit) else { return false };
                runs.iter_mut().flat_map(|run| &mut run.time).for_each(|t| *t /= unit);
            }
            (K::OtherClock { factor }, _) => {
                for &run in &self.runs {
                    runs[run].time.iter_mut().for_each(|t| *t /= factor);
                }
            }
            (K::ZerosOfRuns, _) => {
                for zero in &self.zeros {
                    shift_effort(&mut runs[zero.run].joints[zero.joint], -zero.offset);
                }
            }
            (K::GoalVelocity, joints) => {
                for run in runs.iter_mut() {
                    joints.iter().for_each(|&j| follow_velocity(robot, run, j));
                }
            }
            (K::CountedTogether(counted), _) => {
                runs.iter_mut().for_each(|run| count_apart(run, counted));
            }
            (K::JointsExchanged, &[a, b]) => runs.iter_mut().for_each(|run| exchange(run, a, b)),
            (K::EffortsExchanged, &[a, b]) => {
                runs.iter_mut().for_each(|run| exchange_efforts(run, a, b));
            }
            // One joint may as well be balanced.
            (K::EffortWithoutGravity, &[_, _, ..]) => {
                runs.iter_mut().for_each(|run| add_gravity(robot, run));
            }
            _ => return false,
        }
        true
    }
}

/// Adds the torque of gravity to efforts that lack it, with the described drives:
///
/// ```text
/// effort += ratio gain g(q),   q = ratio (q_log - offset)
/// ```
///
/// The masses of the description are then in the efforts whatever the arm weighs.
fn add_gravity(robot: &Robot, run: &mut Run) {
    let dynamics = Dynamics::new(robot);
    let mut workspace = dynamics.workspace();
    let drives: Vec<&Actuator> = robot.links().iter().map(|link| &link.actuator).collect();
    let (mut q, mut tau) = (vec![0.0; drives.len()], vec![0.0; drives.len()]);
    let still = vec![0.0; drives.len()];
    for t in 0..run.time.len() {
        for ((q, drive), joint) in q.iter_mut().zip(&drives).zip(&run.joints) {
            *q = drive.transmission_ratio * (joint.position[t] - drive.encoder_offset);
        }
        dynamics.inverse_dynamics_into(&mut workspace, &q, &still, &still, &mut tau);
        for ((joint, drive), tau) in run.joints.iter_mut().zip(&drives).zip(&tau) {
            joint.effort[t] += drive.transmission_ratio * drive.torque_gain * tau;
        }
    }
}

/// Adds what a loop does that follows the velocity of its goal, `kd d goal/dt`, to effort and its part that follows the goal.
fn follow_velocity(robot: &Robot, run: &mut Run, joint: usize) {
    let gains = robot.links().get(joint).and_then(|link| link.actuator.position_loop);
    let (Some(PdGain { kp, kd }), Channels { effort, goal_effort: Some(goal), .. }) =
        (gains, &mut run.joints[joint])
    else {
        return;
    };
    // One goal has no rate.
    if goal.values.len() < 2 || run.time.is_empty() {
        return;
    }
    let step_s = usual_step(&run.time);
    let time = |k: usize| match k.checked_sub(goal.lead) {
        Some(row) => run.time[row],
        None => run.time[0] - (goal.lead - k) as f64 * step_s,
    };
    let last = goal.values.len().saturating_sub(1);
    let rate = |k: usize| {
        let (before, after) = (k.saturating_sub(1), (k + 1).min(last));
        (goal.values[after] - goal.values[before]) / (time(after) - time(before))
    };
    let added: Vec<f64> = (0..=last).map(|k| kd / kp * rate(k)).collect();
    effort.iter_mut().zip(&added[goal.lead..]).for_each(|(effort, more)| *effort += more);
    goal.values.iter_mut().zip(&added).for_each(|(effort, more)| *effort += more);
}

/// The power of ten that a factor is near to, other than one.
fn power_of_ten(factor: f64, nearly: f64) -> Option<f64> {
    let unit = 10_f64.powf(factor.log10().round());
    let is_near =
        (factor / unit).ln().abs() < nearly.ln() && (unit - 1.0).abs() > 0.5 * unit.min(1.0);
    is_near.then_some(unit)
}

/// Changes some joints of every run.
fn at(runs: &mut [Run], joints: &[usize], change: impl Fn(&mut Channels)) {
    for run in runs {
        joints.iter().for_each(|&j| change(&mut run.joints[j]));
    }
}

fn scale(signal: &mut [f64], by: f64) {
    signal.iter_mut().for_each(|x| *x *= by);
}

/// Scales the effort of a joint, and the part of it that follows a goal.
fn scale_effort(joint: &mut Channels, by: f64) {
    scale(&mut joint.effort, by);
    if let Some(goal) = &mut joint.goal_effort {
        scale(&mut goal.values, by);
    }
}

/// Adds an offset to the effort of a joint, and to the part of it that follows a goal.
fn shift_effort(joint: &mut Channels, by: f64) {
    joint.effort.iter_mut().for_each(|effort| *effort += by);
    if let Some(goal) = &mut joint.goal_effort {
        goal.values.iter_mut().for_each(|effort| *effort += by);
    }
}

/// Scales the positions of a joint, and its velocities and accelerations where they follow the positions.
fn scale_motion(joint: &mut Channels, by: f64) {
    let of_the_positions = follows(joint);
    scale(&mut joint.position, by);
    joint.link_position.iter_mut().for_each(|link| scale(link, by));
    if of_the_positions {
        joint.velocity.iter_mut().chain(&mut joint.acceleration).for_each(|x| scale(x, by));
    }
}

/// Whether a velocity column has the sign of the change of the positions; true where there is none.
fn follows(joint: &Channels) -> bool {
    let Some(velocity) = &joint.velocity else { return true };
    let steps = joint.position.windows(2).map(|q| q[1] - q[0]);
    let product = |(step, v): (f64, &f64)| if v.is_finite() { step * v } else { 0.0 };
    steps.zip(velocity).map(product).sum::<f64>() >= 0.0
}

/// Takes the position of the joint before it from that of a joint, and gives that joint the effort of the other drive
/// where it does not carry it.
fn count_apart(run: &mut Run, counted: CountedTogether) {
    let CountedTogether { joint, with, sign, is_driven } = counted;
    let Channels { position, velocity, acceleration, link_position, .. } = run.joints[with].clone();
    let own = &mut run.joints[joint];
    add(&mut own.position, &position, -sign);
    let others = [
        (&mut own.velocity, velocity),
        (&mut own.acceleration, acceleration),
        (&mut own.link_position, link_position),
    ];
    for (own, before) in others {
        match (own.as_mut(), before) {
            (Some(own), Some(before)) => add(own, &before, -sign),
            _ => *own = None,
        }
    }
    if is_driven {
        let effort = run.joints[joint].effort.clone();
        add(&mut run.joints[with].effort, &effort, sign);
    }
}

fn add(signal: &mut [f64], other: &[f64], factor: f64) {
    signal.iter_mut().zip(other).for_each(|(x, y)| *x += factor * y);
}

/// Exchanges the efforts of two joints.
fn exchange_efforts(run: &mut Run, a: usize, b: usize) {
    let effort = std::mem::take(&mut run.joints[a].effort);
    run.joints[a].effort = std::mem::replace(&mut run.joints[b].effort, effort);
    let goal = run.joints[a].goal_effort.take();
    run.joints[a].goal_effort = std::mem::replace(&mut run.joints[b].goal_effort, goal);
}

/// Exchanges all columns of two joints, whose names stay.
fn exchange(run: &mut Run, a: usize, b: usize) {
    run.joints.swap(a, b);
    let name = std::mem::take(&mut run.joints[a].name);
    run.joints[a].name = std::mem::replace(&mut run.joints[b].name, name);
}

#[cfg(test)]
mod tests {
    use logs::GoalEffort;

    use super::*;
    use crate::testing::{pendulum, swing};

    fn read(change: fn(&mut Run)) -> (CorrectedLogs, Vec<Run>) {
        let true_runs = vec![swing(0.3), swing(1.1)];
        let mut runs = true_runs.clone();
        runs.iter_mut().for_each(change);
        (correct(&pendulum(), &runs), true_runs)
    }

    /// Beside a velocity column of a slow pendulum it may be that column that is in another unit.
    #[test]
    fn time_in_milliseconds_is_read_as_such() {
        let (mended, true_runs) = read(|run| {
            run.time.iter_mut().for_each(|t| *t *= 1e3);
            run.joints[0].velocity = None;
        });
        let kinds: Vec<ObservationKind> = mended.mended.iter().map(|o| o.kind).collect();
        assert!(matches!(kinds.as_slice(), [ObservationKind::TimeUnit { .. }]), "{kinds:?}");
        assert_eq!(mended.left, []);
        let runs = mended.runs.unwrap();
        assert_eq!(runs.len(), true_runs.len());
        for (read, run) in runs.iter().zip(&true_runs) {
            let apart = |(a, b): (&f64, &f64)| (a - b).abs();
            assert!(read.time.iter().zip(&run.time).map(apart).fold(0.0, f64::max) < 1e-9);
            assert_eq!(read.joints[0].position, run.joints[0].position);
            assert_eq!(read.joints[0].effort, run.joints[0].effort);
        }
    }

    /// A pendulum whose gravity torque is `m g l sin(q)`, with `m g l` = 9.81 N m.
    #[test]
    fn efforts_without_gravity_get_that_of_the_description() {
        let whole = swing(0.3);
        let mut run = whole.clone();
        let Channels { effort, position, .. } = &mut run.joints[0];
        effort.iter_mut().zip(&*position).for_each(|(e, q)| *e -= 9.81 * q.sin());
        add_gravity(&pendulum(), &mut run);
        let efforts = run.joints[0].effort.iter().zip(&whole.joints[0].effort);
        assert!(efforts.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max) < 1e-9);
    }

    /// 1.25 is no unit: how much of it is the clock's is not known.
    #[test]
    fn time_that_runs_slowly_stays_as_it_is() {
        let (mended, _) = read(|run| run.time.iter_mut().for_each(|t| *t *= 1.25));
        assert_eq!(mended.mended, []);
        assert!(mended.left.iter().any(Observation::spoils_whole_logs), "{:?}", mended.left);
        assert_eq!(mended.runs, None);
    }

    /// A pendulum has the same logs with its effort turned and with its position turned.
    #[test]
    fn a_sign_that_may_be_another_one_stays_as_it_is() {
        let (mended, _) = read(|run| scale(&mut run.joints[0].effort, -1.0));
        assert_eq!(mended.mended, []);
        assert!(!mended.left.is_empty());
    }

    /// A loop of 100 N m/rad and 5 N m s/rad that follows a goal close by, logged without the velocity of the goal: its
    /// effort is what the pendulum needs less 5 N m s/rad of its speed, which no friction takes.
    #[test]
    fn a_loop_that_follows_the_velocity_of_its_goal_is_read_as_such() {
        let mut robot = pendulum();
        robot.link_mut(0).unwrap().actuator.position_loop = Some(PdGain { kp: 100.0, kd: 5.0 });
        let true_runs = vec![swing(0.3), swing(1.1)];
        let mut runs = true_runs.clone();
        for joint in runs.iter_mut().map(|run| &mut run.joints[0]) {
            let speeds = joint.velocity.as_ref().unwrap();
            joint.effort.iter_mut().zip(speeds).for_each(|(effort, qd)| *effort -= 5.0 * qd);
            let values = joint.position.iter().map(|q| 100.0 * q).collect();
            joint.goal_effort = Some(GoalEffort { values, lead: 0, delay_s: 0.0 });
        }
        let read = correct(&robot, &runs);
        let kinds: Vec<ObservationKind> = read.mended.iter().map(|o| o.kind).collect();
        assert_eq!(kinds, [ObservationKind::GoalVelocity], "{:?}", read.left);
        for (read, run) in read.runs.unwrap().iter().zip(&true_runs) {
            let apart = read.joints[0].effort.iter().zip(&run.joints[0].effort);
            let most = apart.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
            assert!(most < 0.2, "{most}");
        }
    }

    #[test]
    fn units_of_time_are_powers_of_ten() {
        assert_eq!(power_of_ten(400.0, 1.05), None);
        assert_eq!(power_of_ten(1001.0, 1.05), Some(1e3));
        assert_eq!(power_of_ten(1100.0, 1.05), None);
    }

    #[test]
    fn a_velocity_column_of_its_own_sign_keeps_it() {
        let mut joint = swing(0.3).joints.remove(0);
        let velocity = joint.velocity.clone();
        scale(&mut joint.position, -1.0);
        scale_motion(&mut joint, -1.0);
        assert_eq!(joint.velocity, velocity);
        let position = joint.position.clone();
        scale_motion(&mut joint, -1.0);
        scale_motion(&mut joint, -1.0);
        assert_eq!((joint.position, joint.velocity), (position, velocity));
    }
}
