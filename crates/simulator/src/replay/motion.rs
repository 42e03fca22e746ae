use logs::{Channels, PreparedRun, Run};
use robot::{Machine, PdGain, Reading, Robot};

use crate::error::SimulatorError;
use crate::replay::record::{
    EncoderState, check_rate, encoder_state, held_torque, interpolate, simulator_of_record,
    start_at_sample, too_short, with_efforts_in_time, with_friction_of_sample,
};

/// Slowest rate of the controller that follows a recorded motion (Hz).
const CONTROL_HZ: f64 = 500.0;

/// The torque that a simulation needs along a recorded motion.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionReplay {
    /// Root mean square of `tau_simulated - tau_measured` for each joint (N m or N).
    pub torque_error_rms: Vec<f64>,
    /// Root mean square of `q_simulated - q_measured` for each joint (rad or m).
    pub tracking_error_rms: Vec<f64>,
    /// The simulated log, with the measured torque as `<joint>.measured_effort`.
    pub log: Run,
}

/// Simulates a robot along a recorded motion from its first state, with
///
/// ```text
/// tau_simulated = tau_measured + kp (q_measured - q) + kd (qd_measured - qd)
/// ```
///
/// with each measured torque at the time at which it acted. The feedback is the torque error: the
/// torque that the simulation needs beyond the measured one. Without the measured torque as
/// feedforward, tracking errors would add to it. Errors faster than the controller stay invisible.
///
/// # Errors
///
/// [`SimulatorError`] when the robot cannot be simulated or a joint runs away, or
/// [`SimulatorError::TooShort`] when the record has no two samples.
pub fn replay_motion(
    robot: &Robot,
    gains: &[PdGain],
    record: &PreparedRun,
) -> Result<MotionReplay, SimulatorError> {
    check_rate(record)?;
    if record.time.len() < 2 {
        return Err(too_short(record, 1.0 / record.rate_hz));
    }
    let record = &*with_efforts_in_time(robot, record);
    let robot = &*with_friction_of_sample(robot, record, 0);
    // A controller at the rate of a slow log would not be stable.
    let turns = (CONTROL_HZ / record.rate_hz).ceil().max(1.0) as usize;
    let mut simulator = simulator_of_record(robot, record.rate_hz * turns as f64)?;
    start_at_sample(&mut simulator, robot, record, 0);
    let mut rows = Vec::with_capacity(record.time.len());
    let mut reading = Reading::zero(robot.joint_count());
    for tick in 0..(record.time.len() - 1) * turns {
        let mut turn = || {
            simulator.read(&mut reading)?;
            let EncoderState { q, qd } = encoder_state(&simulator, robot);
            (reading.q, reading.qd) = (q, qd);
            let (sample, part) = (tick / turns, (tick % turns) as f64 / turns as f64);
            let mut tau = held_torque(robot, record, sample);
            for (i, (joint, gain)) in record.joints.iter().zip(gains).enumerate() {
                let [q, qd] = interpolate(joint, sample, part, 1.0 / record.rate_hz);
                let feedback = gain.kp * (q - reading.q[i]) + gain.kd * (qd - reading.qd[i]);
                tau[i] += feedback;
                reading.effort[i] = feedback;
            }
            simulator.actuate(&tau)
        };
        let fault = |fault| SimulatorError::Fault { run: record.name.clone(), fault };
        turn().map_err(fault)?;
        if tick % turns == 0 {
            rows.push(reading.clone());
        }
    }
    Ok(compare(robot, record, &rows))
}

/// Compares simulated rows, whose effort is the feedback, with a record.
fn compare(robot: &Robot, record: &PreparedRun, rows: &[Reading]) -> MotionReplay {
    let whole = |column: &[f64]| column[..rows.len()].to_vec();
    let rms = |of: &dyn Fn(usize) -> f64| {
        let squares = (0..rows.len()).map(|k| of(k).powi(2));
        (squares.sum::<f64>() / rows.len().max(1) as f64).sqrt()
    };
    let joints = 0..robot.joint_count();
    let torque = |j: usize| rms(&|k| rows[k].effort[j]);
    let tracking = |j: usize| rms(&|k| rows[k].q[j] - record.joints[j].q[k]);
    let channels = |(j, name): (usize, &str)| Channels {
        name: name.to_owned(),
        position: rows.iter().map(|r| r.q[j]).collect(),
        velocity: Some(rows.iter().map(|r| r.qd[j]).collect()),
        effort: rows
            .iter()
            .zip(&record.joints[j].effort)
            .map(|(r, tau)| tau + r.effort[j])
            .collect(),
        desired_position: Some(whole(&record.joints[j].q)),
        desired_velocity: Some(whole(&record.joints[j].qd)),
        desired_acceleration: Some(whole(&record.joints[j].qdd)),
        ..Channels::default()
    };
    let measured = |(j, name): (usize, &str)| {
        (format!("{name}.measured_effort"), whole(&record.joints[j].effort))
    };
    MotionReplay {
        torque_error_rms: joints.clone().map(torque).collect(),
        tracking_error_rms: joints.map(tracking).collect(),
        log: Run {
            name: record.name.clone(),
            source: Default::default(),
            sha256: String::new(),
            is_torn: false,
            mended: Vec::new(),
            time: whole(&record.time),
            joints: robot.joint_names().enumerate().map(channels).collect(),
            extra: robot.joint_names().enumerate().map(measured).collect(),
        },
    }
}
