use std::borrow::Cow;

use logs::{PreparedJoint, PreparedRun};
use robot::{Actuator, Robot, SensingSide, TorqueSource};

use crate::error::SimulatorError;
use crate::mechanics::step_order::StepOrder;
use crate::mechanics::transmission::Transmission;
use crate::sensors::Sensors;
use crate::simulator::{Simulator, Stepping};

/// Positions (rad or m) and velocities (rad/s or m/s) as encoders report them, one per joint.
pub(crate) struct EncoderState {
    pub q: Vec<f64>,
    pub qd: Vec<f64>,
}

/// The record with its efforts shifted to the time at which they acted, for logs with a skew:
///
/// ```text
/// effort(t) = logged effort(t + skew)
/// ```
///
/// linear between samples; the first or last effort beyond the record. Of efforts computed from goals that are followed
/// later than the log has them, less `kp (goal(t) - goal(t - lateness))`.
pub(crate) fn with_efforts_in_time<'a>(
    robot: &Robot,
    record: &'a PreparedRun,
) -> Cow<'a, PreparedRun> {
    let drives = || robot.links().iter().map(|link| &link.actuator).zip(&record.joints);
    let is_in_time = |(drive, joint): (&Actuator, &PreparedJoint)| {
        drive.effort_skew_s.abs() <= 0.0 && goal_lateness_s(drive, joint).abs() <= 0.0
    };
    if drives().all(is_in_time) {
        return Cow::Borrowed(record);
    }
    let mut record = record.clone();
    for (joint, link) in record.joints.iter_mut().zip(robot.links()) {
        without_late_goals(&link.actuator, joint, record.rate_hz);
        let late = link.actuator.effort_skew_s * record.rate_hz;
        let last = joint.effort.len().saturating_sub(1);
        let at = |sample: usize| {
            let place = (sample as f64 + late).clamp(0.0, last as f64);
            let (before, part) = (place as usize, place.fract());
            let [a, b] = [joint.effort[before], joint.effort[(before + 1).min(last)]];
            a + part * (b - a)
        };
        joint.effort = (0..joint.effort.len()).map(at).collect();
    }
    Cow::Owned(record)
}

/// Time by which goals are followed later than in the effort that was computed from them (s); 0 where it is logged.
fn goal_lateness_s(drive: &Actuator, joint: &PreparedJoint) -> f64 {
    joint.goal_effort.as_ref().map_or(0.0, |goal| drive.goal_delay_s - goal.delay_s)
}

/// Replaces the goal in an effort that was computed from goals by that which the loop follows.
fn without_late_goals(drive: &Actuator, joint: &mut PreparedJoint, rate_hz: f64) {
    let rows = goal_lateness_s(drive, joint) * rate_hz;
    let Some(goal) = &joint.goal_effort else { return };
    let last = goal.values.len().saturating_sub(1);
    let at = |place: f64| {
        let place = place.clamp(0.0, last as f64);
        let (before, part) = (place as usize, place.fract());
        let [a, b] = [goal.values[before], goal.values[(before + 1).min(last)]];
        a + part * (b - a)
    };
    for (k, effort) in joint.effort.iter_mut().enumerate() {
        let row = (goal.lead + k) as f64;
        *effort += at(row - rows) - at(row);
    }
}

/// The robot with the friction of its drives at the time of a sample, after that much warming.
pub(crate) fn with_friction_of_sample<'a>(
    robot: &'a Robot,
    record: &PreparedRun,
    sample: usize,
) -> Cow<'a, Robot> {
    if robot.links().iter().all(|link| link.actuator.warming.is_none()) {
        return Cow::Borrowed(robot);
    }
    let mut robot = robot.clone();
    for j in 0..robot.joint_count() {
        let Some(link) = robot.link_mut(j) else { continue };
        link.actuator = link.actuator.after_warming(record.time[sample] - record.session_start_s);
    }
    Cow::Owned(robot)
}

/// Time constants of a lag after which older commands are negligible: 0.1 % is left.
const LAGS: f64 = 7.0;

/// Starts a simulation in the state of a sample: measured positions and velocities with known encoder
/// errors removed, transmissions deflected by the load of that instant, and earlier commands in delays
/// and lags.
pub(crate) fn start_at_sample(
    simulator: &mut Simulator,
    robot: &Robot,
    record: &PreparedRun,
    sample: usize,
) {
    let (mut motor_q, mut motor_qd, mut twist) = (Vec::new(), Vec::new(), Vec::new());
    for (link, joint) in robot.links().iter().zip(&record.joints) {
        let drive = &link.actuator;
        let load = load(drive, joint, sample, record.rate_hz);
        let behind = Transmission::of_actuator(drive).deflection_under(load);
        let at_link = drive.sensing == SensingSide::Link;
        motor_q.push(true_position(drive, joint.q[sample]) - if at_link { behind } else { 0.0 });
        motor_qd.push(drive.transmission_ratio * joint.qd[sample]);
        twist.push(behind);
    }
    simulator.start_with_deflection(&motor_q, &motor_qd, &twist);
    let memory_s = |drive| {
        let [delay_s, lag_s] = late_s(drive);
        delay_s + LAGS * lag_s
    };
    let longest_s = robot.links().iter().map(|l| memory_s(&l.actuator)).fold(0.0, f64::max);
    if longest_s > 0.0 {
        let first = sample.saturating_sub((longest_s * record.rate_hz).ceil() as usize + 1);
        let past: Vec<Vec<f64>> = (first..sample).map(|k| held_torque(robot, record, k)).collect();
        simulator.send_past_commands(&past);
    }
}

/// Torque through the transmission of a joint (N m or N):
///
/// ```text
/// tau  = (effort(t - delay - lag) - offset) / (ratio gain) - J qdd - viscous qd - ripple(q)
/// load = tau - (level + load_friction |load|) sign(qd)
/// ```
///
/// with `level` the dry friction of a joint without load that slides.
fn load(drive: &Actuator, joint: &PreparedJoint, sample: usize, rate_hz: f64) -> f64 {
    let ratio = drive.transmission_ratio;
    let [qd, qdd] = [ratio * joint.qd[sample], ratio * joint.qdd[sample]];
    let q = true_position(drive, joint.q[sample]);
    let late = (late_s(drive).iter().sum::<f64>() * rate_hz).round() as usize;
    let effort = joint.effort[sample.saturating_sub(late)];
    let (coulomb, direction) = match qd {
        qd if qd > 0.0 => (drive.coulomb_forward, 1.0),
        qd if qd < 0.0 => (drive.coulomb_backward, -1.0),
        _ => (0.0, 0.0),
    };
    let wave = drive.friction_wave.map_or(0.0, |w| w.share * (w.periods * q + w.phase).cos());
    let excess = drive.stribeck.map_or(0.0, |s| s.excess * (-(qd / s.velocity).powi(2)).exp());
    let ripple = drive.ripple.map_or(0.0, |r| r.amplitude * (r.periods * q + r.phase).sin());
    let tau = (effort - drive.torque_offset) / (ratio * drive.torque_gain)
        - drive.rotor_inertia * qdd
        - drive.viscous * qd
        - ripple
        - direction * (coulomb * (1.0 + wave) + excess);
    // The load has the sign of what is left, as long as less than all of it is lost.
    tau / (1.0 + direction * drive.load_friction.min(0.9).copysign(tau))
}

/// Delay and lag of the torque after the logged effort (s); zero for a measured effort.
pub(crate) fn late_s(drive: &Actuator) -> [f64; 2] {
    match drive.torque_source {
        TorqueSource::Commanded => [drive.delay_s, drive.lag_s],
        _ => [0.0; 2],
    }
}

/// True position of a joint whose encoder reports `q` (rad or m).
fn true_position(drive: &Actuator, q: f64) -> f64 {
    drive.transmission_ratio * (q - drive.encoder_offset)
}

/// The state that the robot's encoders would report.
pub(crate) fn encoder_state(simulator: &Simulator, robot: &Robot) -> EncoderState {
    let pick = |link: &[f64], motor: &[f64]| -> Vec<f64> {
        let sides = robot.links().iter().map(|l| l.actuator.sensing);
        let of = |(side, (link, motor)): (SensingSide, (&f64, &f64))| match side {
            SensingSide::Link => *link,
            SensingSide::Motor | SensingSide::Unknown => *motor,
        };
        sides.zip(link.iter().zip(motor)).map(of).collect()
    };
    let mut q = pick(simulator.q_true(), simulator.motor_q_true());
    let mut qd = pick(simulator.qd_true(), simulator.motor_qd_true());
    for (link, (q, qd)) in robot.links().iter().zip(q.iter_mut().zip(&mut qd)) {
        let a = &link.actuator;
        *q = *q / a.transmission_ratio + a.encoder_offset;
        *qd /= a.transmission_ratio;
    }
    EncoderState { q, qd }
}

/// Torques that act from one sample to the next.
pub(crate) fn held_torque(robot: &Robot, record: &PreparedRun, sample: usize) -> Vec<f64> {
    let of = |(joint, link): (&PreparedJoint, &robot::Link)| match link.actuator.torque_source {
        TorqueSource::Commanded => joint.effort[sample],
        _ => 0.5 * (joint.effort[sample] + joint.effort[sample + 1]),
    };
    record.joints.iter().zip(robot.links()).map(of).collect()
}

/// Position and velocity between two samples, from the cubic through the positions and velocities of
/// both.
pub(crate) fn interpolate(
    joint: &PreparedJoint,
    sample: usize,
    part: f64,
    interval_s: f64,
) -> [f64; 2] {
    let (a, b) = (joint.q[sample], joint.q[sample + 1]);
    let (va, vb) = (interval_s * joint.qd[sample], interval_s * joint.qd[sample + 1]);
    let (second, third) = (3.0 * (b - a) - 2.0 * va - vb, 2.0 * (a - b) + va + vb);
    let q = a + part * (va + part * (second + part * third));
    let qd = (va + part * (2.0 * second + 3.0 * part * third)) / interval_s;
    [q, qd]
}

/// Longest step of the second order (s): the tip of an arm is off by some 1e-7 m after a second
/// (`docs/lab/2026-11-30-simulator-steps.md`).
const LONGEST_STEP_S: f64 = 2.5e-4;

/// Shortest step that the spring of a drive is given (s).
const SHORTEST_STEP_S: f64 = 1e-4;

/// Part of the longest step that a spring allows (see [`SimulatorError::SpringTooStiff`]) which it is given.
const OF_ALLOWED: f64 = 0.9;

/// Slowest record that is simulated (Hz). Slower ones do not determine the motion between their rows.
pub(crate) const SLOWEST_HZ: f64 = 1.0;

pub(crate) fn check_rate(record: &PreparedRun) -> Result<(), SimulatorError> {
    if record.rate_hz >= SLOWEST_HZ {
        return Ok(());
    }
    let (run, rate_hz) = (record.name.clone(), record.rate_hz);
    Err(SimulatorError::TooSlow { run, rate_hz, slowest_hz: SLOWEST_HZ })
}

pub(crate) fn too_short(record: &PreparedRun, window_s: f64) -> SimulatorError {
    let found_s = record.time.len().saturating_sub(1) as f64 / record.rate_hz;
    SimulatorError::TooShort { run: record.name.clone(), found_s, window_s }
}

/// A simulator that holds commands for one sample of a record at this rate, in steps of the second order of at most
/// 0.25 ms, or shorter ones down to 0.1 ms where the spring of a drive needs them.
pub(crate) fn simulator_of_record(
    robot: &Robot,
    rate_hz: f64,
) -> Result<Simulator, SimulatorError> {
    let mut robot = robot.clone();
    for i in 0..robot.joint_count() {
        if let Some(link) = robot.link_mut(i) {
            let a = &mut link.actuator;
            [a.delay_s, a.lag_s] = late_s(a);
        }
    }
    match in_steps_of(&robot, rate_hz, LONGEST_STEP_S) {
        Err(SimulatorError::SpringTooStiff { longest_step_ms, .. })
            if 1e-3 * longest_step_ms > SHORTEST_STEP_S =>
        {
            let step_s = (1e-3 * OF_ALLOWED * longest_step_ms).max(SHORTEST_STEP_S);
            in_steps_of(&robot, rate_hz, step_s)
        }
        built => built,
    }
}

/// The simulator in the longest steps up to a length (s) of which a sample takes a whole number.
fn in_steps_of(
    robot: &Robot,
    rate_hz: f64,
    longest_step_s: f64,
) -> Result<Simulator, SimulatorError> {
    let steps = (1.0 / (rate_hz * longest_step_s) - 1e-9).ceil().max(1.0);
    let stepping = Stepping {
        step_s: 1.0 / (rate_hz * steps),
        steps_per_period: steps as usize,
        stops: false,
        order: StepOrder::Second,
    };
    Simulator::new(robot, Vec::new(), Sensors::perfect(robot.joint_count()), stepping)
}

#[cfg(test)]
mod tests {
    use robot::{FrictionWave, Ripple, Stribeck};

    use super::*;

    /// An effort of 3 t + 1 logged every 2 ms, 5 ms late: two and a half samples.
    #[test]
    fn an_effort_that_was_logged_late_is_put_back_to_its_time() {
        let robot = |skew_s: f64| {
            let mut robot = Robot::from_urdf(
                r#"<robot name="r"><link name="base"/><link name="rim"/>
                <joint name="joint" type="continuous"><parent link="base"/><child link="rim"/>
                <axis xyz="0 0 1"/></joint></robot>"#,
            )
            .unwrap();
            robot.link_mut(0).unwrap().actuator.effort_skew_s = skew_s;
            robot
        };
        let time: Vec<f64> = (0..100).map(|k| 0.002 * f64::from(k)).collect();
        let effort = |t: f64| 3.0 * t.clamp(0.0, 0.198) + 1.0;
        let joint = |skew_s: f64| {
            let still = || vec![0.0; time.len()];
            let late = time.iter().map(|t| 3.0 * (t - skew_s) + 1.0).collect();
            PreparedJoint::exact([still(), still(), still()], late)
        };
        for skew_s in [0.0, 0.005, -0.005] {
            let joints = vec![joint(skew_s)];
            let name = "run".to_owned();
            let record = PreparedRun {
                name,
                rate_hz: 500.0,
                time: time.clone(),
                session_start_s: 0.0,
                joints,
            };
            let put_back = with_efforts_in_time(&robot(skew_s), &record);
            let inside = time.iter().zip(&put_back.joints[0].effort).skip(3).take(94);
            for (t, found) in inside {
                assert!((found - effort(*t)).abs() < 1e-12, "{found} at {t} s, {skew_s} s late");
            }
        }
    }

    /// The effort that carries a load is worked out forwards and given to what works backwards.
    #[test]
    fn a_load_is_found_behind_all_that_a_drive_can_say() {
        let drive = Actuator {
            rotor_inertia: 0.1,
            viscous: 0.3,
            coulomb_forward: 0.6,
            coulomb_backward: 0.4,
            stribeck: Some(Stribeck { excess: 0.2, velocity: 0.1 }),
            load_friction: 0.1,
            friction_wave: Some(FrictionWave { share: 0.3, periods: 3.0, phase: 0.5 }),
            ripple: Some(Ripple { amplitude: 0.2, periods: 40.0, phase: -1.0 }),
            torque_gain: 1.1,
            torque_offset: 0.05,
            encoder_offset: 0.02,
            transmission_ratio: 1.25,
            ..Actuator::default()
        };
        let (q, qdd) = (0.7_f64, -2.0);
        for (qd, coulomb) in [(0.1_f64, 0.6), (-0.1, 0.4)] {
            for carried in [-5.0, -0.01, 0.01, 5.0_f64] {
                let level = coulomb * (1.0 + 0.3 * (3.0 * q + 0.5).cos())
                    + 0.2 * (-1.0_f64).exp()
                    + 0.1 * carried.abs();
                let ripple = 0.2 * (40.0 * q - 1.0).sin();
                let tau = carried + 0.1 * qdd + 0.3 * qd + ripple + level * qd.signum();
                let state = [vec![q / 1.25 + 0.02], vec![qd / 1.25], vec![qdd / 1.25]];
                let joint = PreparedJoint::exact(state, vec![1.25 * 1.1 * tau + 0.05]);
                let found = load(&drive, &joint, 0, 500.0);
                assert!((found - carried).abs() < 1e-12, "{found}, not {carried} N m");
            }
        }
    }
}
