use std::collections::BTreeMap;

use logs::{Channels, PreparedRun, Run};
use rayon::prelude::*;
use robot::{Gain, Machine, MachineFault, Reading, Robot};

use crate::error::SimulatorError;
use crate::recorded::{State, begin, between, held, in_time, late_s, seen, warmed};
use crate::sensors::Sensors;
use crate::simulator::{Simulator, Stepping};

/// Longest step of the engine where no other is given (s).
const STEP_S: f64 = 1e-4;

/// Slowest rate of the controller that follows a recorded motion (Hz).
const CONTROL_HZ: f64 = 500.0;

/// Slowest record that is simulated (Hz): between two of its rows an arm moves as it likes.
const SLOWEST_HZ: f64 = 1.0;

/// How a record is rolled forward: in windows one after the other.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Windows {
    /// Time of a window (s), which becomes a whole number of samples.
    pub window_s: f64,
    /// Longest step of the engine (s): a sample of the record takes a whole number of steps.
    pub longest_step_s: f64,
}

impl Windows {
    /// Windows of this length (s), with steps of at most 0.1 ms.
    pub fn of(window_s: f64) -> Self {
        Self { window_s, longest_step_s: STEP_S }
    }
}

/// How far a simulation drifts from a record when it is rolled forward for a while.
#[derive(Debug, Clone, PartialEq)]
pub struct ForwardReplay {
    /// Time that was rolled forward from each start (s).
    pub window_s: f64,
    /// Number of windows, one after the other without overlap.
    pub windows: usize,
    /// Windows in which a joint ran away; they are left out of the drift.
    pub runaways: Vec<MachineFault>,
    /// Root mean square over the windows of `q_simulated - q_measured` at their ends, for each
    /// joint (rad or m); `None` when a joint ran away in every window.
    pub drift_rms: Option<Vec<f64>>,
    /// The simulated motion: positions and velocities of every sample of every window, with the
    /// measured positions as `<joint>.measured_position`.
    pub motion: Run,
}

/// Rolls a robot's simulation forward under the torques of a record, from its states.
///
/// ```text
/// (q, qd)(t_start) = measured,   tau(t) = measured,   drift = q_simulated - q_measured
/// ```
///
/// A torque that was commanded is held from its sample to the next, one that was measured is the
/// mean of both; where the robot says that efforts are logged late they are put back to their
/// time. Windows are simulated side by side. Transmissions start under the load that the drive's
/// description and the torque of the first sample say; what is compared is what the robot's
/// encoders would show. A spring that rings at the start of a window rings on from the
/// state of rest under that load, which one encoder cannot tell.
///
/// # Errors
///
/// [`SimulatorError`] when the robot cannot be simulated, [`SimulatorError::TooSlow`] below one row a
/// second, or [`SimulatorError::TooShort`] when no window fits into the record.
pub fn replay_torque(
    robot: &Robot,
    record: &PreparedRun,
    windows: Windows,
) -> Result<ForwardReplay, SimulatorError> {
    let Windows { window_s, longest_step_s } = windows;
    fast_enough(record)?;
    let record = &*in_time(robot, record);
    let samples = (window_s * record.rate_hz).round().max(1.0) as usize;
    let count = record.time.len().saturating_sub(1) / samples;
    if count == 0 {
        return Err(too_short(record, window_s));
    }
    let starts: Vec<usize> = (0..count).map(|w| w * samples).collect();
    let windows: Result<Vec<Window>, SimulatorError> = starts
        .par_iter()
        .map(|&start| roll(robot, record, start, samples, longest_step_s))
        .collect();
    let windows = windows?;
    let (mut squares, mut kept) = (vec![0.0; robot.joint_count()], 0_usize);
    for (window, start) in windows.iter().zip(&starts) {
        let (Some(State { q, .. }), None) = (window.states.last(), &window.fault) else { continue };
        kept += 1;
        for (i, square) in squares.iter_mut().enumerate() {
            *square += (q[i] - record.joints[i].q[start + samples]).powi(2);
        }
    }
    Ok(ForwardReplay {
        window_s: samples as f64 / record.rate_hz,
        windows: count,
        drift_rms: (kept > 0).then(|| squares.iter().map(|s| (s / kept as f64).sqrt()).collect()),
        motion: motion_of(robot, record, &starts, &windows),
        runaways: windows.into_iter().filter_map(|w| w.fault).collect(),
    })
}

fn fast_enough(record: &PreparedRun) -> Result<(), SimulatorError> {
    if record.rate_hz >= SLOWEST_HZ {
        return Ok(());
    }
    let (run, rate_hz) = (record.name.clone(), record.rate_hz);
    Err(SimulatorError::TooSlow { run, rate_hz, slowest_hz: SLOWEST_HZ })
}

fn too_short(record: &PreparedRun, window_s: f64) -> SimulatorError {
    let found_s = record.time.len().saturating_sub(1) as f64 / record.rate_hz;
    SimulatorError::TooShort { run: record.name.clone(), found_s, window_s }
}

/// What one window came to: positions and velocities at every sample after its start.
struct Window {
    states: Vec<State>,
    fault: Option<MachineFault>,
}

fn roll(
    robot: &Robot,
    record: &PreparedRun,
    start: usize,
    samples: usize,
    longest_step_s: f64,
) -> Result<Window, SimulatorError> {
    let robot = &*warmed(robot, record, start);
    let mut simulator = perfect(robot, record.rate_hz, longest_step_s)?;
    begin(&mut simulator, robot, record, start);
    let mut window = Window { states: Vec::with_capacity(samples), fault: None };
    for sample in start..start + samples {
        let tau = held(robot, record, sample);
        if let Err(fault) = simulator.actuate(&tau) {
            window.fault = Some(fault);
            break;
        }
        window.states.push(seen(&simulator, robot));
    }
    Ok(window)
}

/// A simulator that holds commands for one sample of a record.
fn perfect(robot: &Robot, rate_hz: f64, longest_step_s: f64) -> Result<Simulator, SimulatorError> {
    let steps = (1.0 / (rate_hz * longest_step_s)).ceil().max(1.0);
    let stepping = Stepping {
        step_s: 1.0 / (rate_hz * steps),
        steps_per_period: steps as usize,
        stops: false,
    };
    let mut robot = robot.clone();
    for i in 0..robot.joint_count() {
        if let Some(link) = robot.link_mut(i) {
            let a = &mut link.actuator;
            [a.delay_s, a.lag_s] = late_s(a);
        }
    }
    Simulator::new(&robot, Vec::new(), Sensors::perfect(robot.joint_count()), stepping)
}

fn motion_of(robot: &Robot, record: &PreparedRun, starts: &[usize], windows: &[Window]) -> Run {
    let sample = |start: usize, i: usize| start + 1 + i;
    let places: Vec<(usize, &State)> = windows
        .iter()
        .zip(starts)
        .flat_map(|(w, &s)| w.states.iter().enumerate().map(move |(i, x)| (sample(s, i), x)))
        .collect();
    let joint = |(j, name): (usize, &str)| Channels {
        name: name.to_owned(),
        position: places.iter().map(|(_, at)| at.q[j]).collect(),
        velocity: Some(places.iter().map(|(_, at)| at.qd[j]).collect()),
        effort: places.iter().map(|(k, _)| record.joints[j].effort[*k]).collect(),
        ..Channels::default()
    };
    let measured = |(j, name): (usize, &str)| {
        let column = places.iter().map(|(k, _)| record.joints[j].q[*k]).collect();
        (format!("{name}.measured_position"), column)
    };
    Run {
        name: record.name.clone(),
        source: Default::default(),
        sha256: String::new(),
        is_torn: false,
        mended: Vec::new(),
        time: places.iter().map(|(k, _)| record.time[*k]).collect(),
        joints: robot.joint_names().enumerate().map(joint).collect(),
        extra: robot.joint_names().enumerate().map(measured).collect::<BTreeMap<_, _>>(),
    }
}

/// The torque that a simulation asks for along a recorded motion.
#[derive(Debug, Clone, PartialEq)]
pub struct MotionReplay {
    /// Root mean square of `tau_simulated - tau_measured` for each joint (N m or N).
    pub torque_error_rms: Vec<f64>,
    /// Root mean square of `q_simulated - q_measured` for each joint (rad or m): what the
    /// controller could not follow.
    pub tracking_error_rms: Vec<f64>,
    /// The simulated log, with the measured torque as `<joint>.measured_effort`.
    pub log: Run,
}

/// Lets a robot's simulation follow a recorded motion, from its first state, with
///
/// ```text
/// tau_simulated = tau_measured + kp (q_measured - q) + kd (qd_measured - qd)
/// ```
///
/// with the measured torque at the time at which it acted. What is fed back is what the measured
/// torque lacks to move the simulation along the measured motion: the torque error. Feedback alone
/// would add to it what the controller cannot follow. An error that changes faster than the
/// controller answers does not show.
///
/// # Errors
///
/// [`SimulatorError`] when the robot cannot be simulated or a joint runs away, or
/// [`SimulatorError::TooShort`] when the record has no two samples.
pub fn replay_motion(
    robot: &Robot,
    gains: &[Gain],
    record: &PreparedRun,
) -> Result<MotionReplay, SimulatorError> {
    fast_enough(record)?;
    if record.time.len() < 2 {
        return Err(too_short(record, 1.0 / record.rate_hz));
    }
    let record = &*in_time(robot, record);
    let robot = &*warmed(robot, record, 0);
    // A controller at the rate of a slow log would not be stable.
    let turns = (CONTROL_HZ / record.rate_hz).ceil().max(1.0) as usize;
    let mut simulator = perfect(robot, record.rate_hz * turns as f64, STEP_S)?;
    begin(&mut simulator, robot, record, 0);
    let mut rows = Vec::with_capacity(record.time.len());
    let mut reading = Reading::zero(robot.joint_count());
    for tick in 0..(record.time.len() - 1) * turns {
        let mut turn = || {
            simulator.read(&mut reading)?;
            let State { q, qd } = seen(&simulator, robot);
            (reading.q, reading.qd) = (q, qd);
            let (sample, part) = (tick / turns, (tick % turns) as f64 / turns as f64);
            let mut tau = held(robot, record, sample);
            for (i, (joint, gain)) in record.joints.iter().zip(gains).enumerate() {
                let [q, qd] = between(joint, sample, part, 1.0 / record.rate_hz);
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
    Ok(compared(robot, record, &rows))
}

/// What rows of simulated motion, with what was fed back as their effort, say about a record.
fn compared(robot: &Robot, record: &PreparedRun, rows: &[Reading]) -> MotionReplay {
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
