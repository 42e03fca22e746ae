use catalogue::EffectKind;
use logs::{Channel, Run};
use nalgebra::DMatrix;
use rand_chacha::ChaCha8Rng;
use robot::{Loaded, PdGain, Robot};
use simulator::Truth;
use simulator::effects::{EffectSpec, TorqueConstant, TorqueSaturation};
use simulator::scenario::{Logged, SensorSpec, ServoSpec};
use simulator::{EffortSource, VelocitySource};

use crate::bench::LabBench;
use crate::corner::EffortClass;
use crate::dice::{between, happens, one_of, round_to_digits};
use crate::error::PopulationError;
use crate::hidden::HiddenThings;
use crate::oracle::column::{StandIn, TorqueColumn};
use crate::oracle::motion::SeenRun;
use crate::oracle::noise::OracleNoise;
use crate::oracle::regression::strengths;
use crate::oracle::stand_ins::stand_ins;
use crate::robot_files::RobotFiles;
use crate::sheet::{CauseRole, Strength, TrueCause};
use crate::spec::ServoShareSpec;

/// Rates at which goals are sent (Hz), before they become a whole part of the controller's.
const GOALS_HZ: [f64; 4] = [30.0, 30.0, 50.0, 100.0];

/// Share of arms whose goals come as early as any.
const PUNCTUAL: f64 = 0.25;

/// Share of arms whose stated gains are off, and by how much they are at most.
const OFF: [f64; 2] = [0.5, 0.05];

/// Share of arms in which a servo is set to less torque, and that torque over the limit. Bodies need at most a third
/// of the limit ([`fit`](crate::arms::drives::fit)).
const CLIPPED: f64 = 0.3;
const CLIP: [f64; 2] = [0.4, 0.8];

/// The servos of an arm, which log goals and positions alone.
///
/// ```text
/// tau = kp (goal(t - delay) - q) - kd qd,   goal held from row to row
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct ServoDraw {
    /// Time by which goals come late (ms).
    pub delay_ms: f64,
    goal_hz: f64,
    /// Whether a row is logged with every goal; otherwise with every period of the loop.
    is_logged_with_goals: bool,
    is_off: bool,
    is_clipped: bool,
}

impl ServoDraw {
    /// Draws servos.
    pub fn draw(spec: &ServoShareSpec, random: &mut ChaCha8Rng) -> Self {
        let delay_ms = round_to_digits(between(random, spec.delay_ms), 2);
        Self {
            delay_ms: if happens(random, PUNCTUAL) { spec.delay_ms[0] } else { delay_ms },
            goal_hz: one_of(random, GOALS_HZ),
            is_logged_with_goals: happens(random, 0.5),
            is_off: happens(random, OFF[0]),
            is_clipped: happens(random, CLIPPED),
        }
    }

    /// Gives a bench servos: its controller follows goals, its logs have neither effort nor velocity, and both robots
    /// say `effort_source`. The servo damps the speed of its motor, which it has from the motor's voltage.
    pub fn prepare(
        &self,
        bench: &mut LabBench,
        low_rate_hz: Option<f64>,
    ) -> Result<(), PopulationError> {
        let loaded = bench.truth.load()?;
        let control_hz = loaded.control.rate_hz.unwrap_or(500.0);
        let goal_hz = whole_part(control_hz, low_rate_hz.unwrap_or(self.goal_hz));
        let with_goals = self.is_logged_with_goals || low_rate_hz.is_some();
        bench.control.servo =
            Some(ServoSpec { goal_rate_hz: goal_hz, goal_delay_ms: self.delay_ms });
        bench.effort = EffortClass::Command;
        bench.sensors = SensorSpec {
            effort: EffortSource::Commanded,
            velocity: VelocitySource::Ideal,
            velocity_logged: Logged::No,
            log_rate_hz: Some(if with_goals { goal_hz } else { control_hz }),
            effort_noise_nm: Default::default(),
            effort_resolution_nm: Default::default(),
            ..bench.sensors.clone()
        };
        let source = effort_source(&gains(&loaded), goal_hz);
        for files in [&mut bench.truth, &mut bench.nominal] {
            state(files, &source);
        }
        Ok(())
    }

    /// Adds what the stated gains and the torque limits of the servos are off by, as effects:
    ///
    /// ```text
    /// effort read with the stated gains = gain tau,   |effort| <= clip
    /// ```
    pub fn add_causes(&self, robot: &Robot, hidden: &mut HiddenThings, random: &mut ChaCha8Rng) {
        let clipped = (random_joint(robot, random), between(random, CLIP));
        for (j, link) in robot.links().iter().enumerate() {
            let joint = link.joint.name.clone();
            let has = |kind, joint: &str| {
                let at = |effect: &EffectSpec| effect.truth().joint.as_deref() == Some(joint);
                hidden.causes.iter().any(|effect| effect.kind() == kind && at(effect))
            };
            let gain = round_to_digits(1.0 + OFF[1] * between(random, [-1.0, 1.0]), 4);
            let limit = link.joint.limits.effort.filter(|_| self.is_clipped && j == clipped.0);
            let clip = limit.map(|limit| round_to_digits(clipped.1 * limit, 3));
            let constant = !has(EffectKind::TorqueConstant, &joint);
            if self.is_off && constant {
                let effect = TorqueConstant { joint: joint.clone(), gain };
                hidden.causes.push(EffectSpec::TorqueConstant(effect));
            }
            if let Some(limit_nm) = clip {
                let effect = TorqueSaturation { joint, limit_nm };
                hidden.causes.push(EffectSpec::TorqueSaturation(effect));
            }
        }
    }

    /// The lateness of the goals in the sheet: what the loop with goals that come at once leaves beyond the loop with those
    /// that the servos follow, both means over the time of a row. `None` where they come at once.
    ///
    /// ```text
    /// torque = kp mean over t_k -+ T / 2 of (goal(t) - goal(t - delay))
    /// ```
    ///
    /// `clean` are the logs without noise.
    pub fn late_goals(
        &self,
        truth: &Loaded,
        clean: &[Run],
        (noise, scales): (&[OracleNoise], &[f64]),
    ) -> Option<TrueCause> {
        if self.delay_ms <= 0.0 {
            return None;
        }
        let robot = &truth.robot;
        let runs: Vec<SeenRun> = clean.iter().map(|run| SeenRun::new(robot, run)).collect();
        let gains = gains(truth);
        let late = |(run, seen): (&Run, &SeenRun)| -> DMatrix<f64> {
            let mut late = run.clone();
            for (joint, gain) in late.joints.iter_mut().zip(&gains) {
                let goal = joint.desired_position.as_deref().unwrap_or(&joint.position);
                let [sent, followed] =
                    [0.0, 1e-3 * self.delay_ms].map(|late_s| late_mean(&run.time, goal, late_s));
                let late = sent.iter().zip(followed);
                joint.effort = late.map(|(sent, followed)| gain.kp * (sent - followed)).collect();
            }
            SeenRun::thin(robot, &late, seen.thinned).effort
        };
        let torque = clean.iter().zip(&runs).map(late).collect();
        let own = TorqueColumn { stands_for: StandIn::Itself, torque, prior: 0.0 };
        let columns: Vec<TorqueColumn> =
            std::iter::once(own).chain(stand_ins(robot, &runs)).collect();
        let none = Strength { sigmas: 0.0, share: 0.0, torque: 0.0 };
        let strength = strengths(&runs, &columns, 1, noise, scales).pop().unwrap_or(none);
        let truth = Truth::everywhere(EffectKind::GoalDelay, &[("delay", 1e-3 * self.delay_ms)]);
        Some(TrueCause { role: CauseRole::Hidden, truth, strength })
    }

    /// The noise-free held-out log with the goals that the servos follow, so that the loop of the stated gains tells
    /// their torque.
    pub fn follow(&self, held_out: &mut [Run]) {
        for run in held_out {
            for joint in &mut run.joints {
                if let Some(goal) = &mut joint.desired_position {
                    *goal = late_mean(&run.time, goal, 1e-3 * self.delay_ms);
                }
            }
        }
    }
}

/// The columns of a log without its efforts. A run whose joints have no effort cannot be written as one, so that all
/// of its columns are further ones.
pub(crate) fn without_efforts(run: Run) -> Run {
    let is_left =
        |channel: &Channel| !matches!(channel, Channel::Effort | Channel::CommandedEffort);
    let mut extra = run.extra;
    for joint in &run.joints {
        for channel in Channel::ALL.into_iter().filter(is_left) {
            let Some(samples) = joint.get(channel) else { continue };
            extra.insert(format!("{}.{}", joint.name, channel.suffix()), samples.to_vec());
        }
    }
    Run { extra, joints: Vec::new(), ..run }
}

/// The whole part of a rate that is nearest to another one (Hz).
pub(crate) fn whole_part(rate_hz: f64, near_hz: f64) -> f64 {
    rate_hz / (rate_hz / near_hz).round().max(1.0)
}

/// Mean over the time of each row of a goal that is held from row to row and followed late.
fn late_mean(time: &[f64], goal: &[f64], delay_s: f64) -> Vec<f64> {
    let (Some(first), Some(last)) = (time.first(), time.last()) else { return Vec::new() };
    let row_s = (last - first) / (time.len().max(2) - 1) as f64;
    let mut sums = vec![0.0; time.len()];
    for k in 1..time.len() {
        sums[k] = sums[k - 1] + goal[k - 1] * (time[k] - time[k - 1]);
    }
    // Before the first row its goal was held.
    let integral = |t: f64| {
        let row = time.partition_point(|time| *time <= t).saturating_sub(1);
        sums[row] + goal[row] * (t - time[row])
    };
    let mean = |t: &f64| {
        let [from, until] = [-0.5, 0.5].map(|half| integral(t - delay_s + half * row_s));
        (until - from) / row_s
    };
    time.iter().map(mean).collect()
}

fn gains(loaded: &Loaded) -> Vec<PdGain> {
    let none = PdGain { kp: 0.0, kd: 0.0 };
    loaded.control.gains.iter().map(|gain| gain.unwrap_or(none)).collect()
}

fn random_joint(robot: &Robot, random: &mut ChaCha8Rng) -> usize {
    let count = robot.joint_count();
    ((between(random, [0.0, 1.0]) * count as f64) as usize).min(count.saturating_sub(1))
}

/// The key of `robot.toml` with the gains of the loops and the rate of the goals.
fn effort_source(gains: &[PdGain], goal_hz: f64) -> String {
    let [kp, kd] = [|gain: &PdGain| gain.kp, |gain: &PdGain| gain.kd]
        .map(|of| gains.iter().map(of).collect::<Vec<f64>>());
    format!(
        "effort_source = {{ position_loop = {{ kp_nm_per_rad = {kp:?}, kd_nm_s_per_rad = {kd:?}, goal_hold_hz = {goal_hz:?} }} }}\n"
    )
}

/// States the loops in a robot: what a log has for effort is then what they ask for.
fn state(files: &mut RobotFiles, source: &str) {
    let commanded = "torque_source = \"commanded\"";
    let rest = files.toml.replace("torque_source = \"current\"", commanded);
    files.toml = format!("{source}{}", rest.replace("torque_source = \"measured\"", commanded));
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A ramp of slope 2 in goals of 0.1 s: followed 0.04 s late, and half a row as a mean.
    #[test]
    fn a_ramp_is_followed_late_by_the_delay_and_half_a_row() {
        let time: Vec<f64> = (0..50).map(|k| 0.1 * f64::from(k)).collect();
        let goal: Vec<f64> = time.iter().map(|t| 2.0 * t).collect();
        for delay_s in [0.0, 0.04, 0.23] {
            let late = late_mean(&time, &goal, delay_s);
            for (late, goal) in late.iter().zip(&goal).skip(5) {
                let expected = goal - 2.0 * (delay_s + 0.05);
                assert!((late - expected).abs() < 1e-9, "{late}, not {expected}, {delay_s} s");
            }
        }
    }

    /// Ten rows a goal: the staircase itself is logged, and a row's mean of it is late by half a row alone.
    #[test]
    fn a_staircase_that_is_logged_in_full_is_not_late() {
        let time: Vec<f64> = (0..500).map(|k| 0.01 * f64::from(k)).collect();
        let goal: Vec<f64> = (0..500).map(|k| f64::from(k / 10)).collect();
        let late = late_mean(&time, &goal, 0.0);
        let mean = goal.iter().zip(&late).map(|(goal, late)| goal - late).sum::<f64>() / 500.0;
        // Slope 10 a second, half a row of 0.01 s.
        assert!((mean - 10.0 * 0.005).abs() < 1e-3, "{mean}");
    }

    #[test]
    fn goals_are_a_whole_part_of_the_controllers_rate() {
        assert!((whole_part(200.0, 30.0) - 200.0 / 7.0).abs() < 1e-12);
        assert!((whole_part(500.0, 100.0) - 100.0).abs() < 1e-12);
        assert!((whole_part(50.0, 100.0) - 50.0).abs() < 1e-12);
    }
}
