use std::collections::BTreeMap;

use logs::{Channels, PreparedRun, Run};
use rayon::prelude::*;
use robot::{Machine, MachineFault, Robot};

use crate::error::SimulatorError;
use crate::replay::record::{
    EncoderState, check_rate, encoder_state, held_torque, simulator_of_record, start_at_sample,
    too_short, with_efforts_in_time, with_friction_of_sample,
};

/// Windows without overlap in which a record is simulated.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Windows {
    /// Length of a window (s), rounded to whole samples.
    pub window_s: f64,
    /// One of so many windows is simulated, the first of every group; 1 for all of them.
    pub one_in: usize,
}

impl Windows {
    /// All windows of this length (s).
    pub fn of(window_s: f64) -> Self {
        Self { window_s, one_in: 1 }
    }
}

/// Drift of a simulation from a record.
#[derive(Debug, Clone, PartialEq)]
pub struct ForwardReplay {
    /// Length of a window (s).
    pub window_s: f64,
    /// Sample of the record at which each window starts.
    pub starts: Vec<usize>,
    /// Faults of windows in which a joint ran away; these windows do not count in the drift.
    pub runaways: Vec<MachineFault>,
    /// Root mean square over the windows of `q_simulated - q_measured` at their ends, for each
    /// joint (rad or m); `None` when a joint ran away in every window.
    pub drift_rms: Option<Vec<f64>>,
    /// The simulated motion: positions and velocities of every sample of every window, with the
    /// measured positions as `<joint>.measured_position`.
    pub motion: Run,
}

/// Simulates a robot under the torques of a record, starting each window from a recorded state.
///
/// ```text
/// (q, qd)(t_start) = measured,   tau(t) = measured,   drift = q_simulated - q_measured
/// ```
///
/// A commanded torque is held from its sample to the next. A measured torque is the mean of both
/// samples. Efforts that are logged late are shifted back by the robot's skew. Windows run in
/// parallel. Positions are compared as the robot's encoders would report them. Steps are of the second
/// order and at most 0.25 ms long, or shorter ones down to 0.1 ms where the spring of a drive needs them.
///
/// Each transmission starts in static equilibrium under the load that follows from the drive's
/// description and the first torque. One encoder cannot show whether it was really oscillating.
///
/// # Errors
///
/// [`SimulatorError`] when the robot cannot be simulated, [`SimulatorError::TooSlow`] below one row a
/// second, or [`SimulatorError::TooShort`] when no window fits into the record. A joint without inertia runs away in
/// every window.
pub fn replay_torque(
    robot: &Robot,
    record: &PreparedRun,
    windows: Windows,
) -> Result<ForwardReplay, SimulatorError> {
    let Windows { window_s, one_in } = windows;
    check_rate(record)?;
    let record = &*with_efforts_in_time(robot, record);
    let samples = (window_s * record.rate_hz).round().max(1.0) as usize;
    let count = record.time.len().saturating_sub(1) / samples;
    if count == 0 {
        return Err(too_short(record, window_s));
    }
    let starts: Vec<usize> = (0..count).step_by(one_in.max(1)).map(|w| w * samples).collect();
    let windows: Result<Vec<Window>, SimulatorError> =
        starts.par_iter().map(|&start| roll_window(robot, record, start, samples)).collect();
    let windows = windows?;
    let (mut squares, mut kept) = (vec![0.0; robot.joint_count()], 0_usize);
    for (window, start) in windows.iter().zip(&starts) {
        let (Some(EncoderState { q, .. }), None) = (window.states.last(), &window.fault) else {
            continue;
        };
        kept += 1;
        for (i, square) in squares.iter_mut().enumerate() {
            *square += (q[i] - record.joints[i].q[start + samples]).powi(2);
        }
    }
    Ok(ForwardReplay {
        window_s: samples as f64 / record.rate_hz,
        drift_rms: (kept > 0).then(|| squares.iter().map(|s| (s / kept as f64).sqrt()).collect()),
        motion: motion_of(robot, record, &starts, &windows),
        runaways: windows.into_iter().filter_map(|w| w.fault).collect(),
        starts,
    })
}

/// Result of one window: positions and velocities at every sample after its start.
struct Window {
    states: Vec<EncoderState>,
    fault: Option<MachineFault>,
}

fn roll_window(
    robot: &Robot,
    record: &PreparedRun,
    start: usize,
    samples: usize,
) -> Result<Window, SimulatorError> {
    let robot = &*with_friction_of_sample(robot, record, start);
    let mut simulator = match simulator_of_record(robot, record.rate_hz) {
        // Its acceleration has no bound.
        Err(SimulatorError::NoInertia { joint }) => {
            return Ok(Window { states: Vec::new(), fault: Some(without_inertia(joint)) });
        }
        built => built?,
    };
    start_at_sample(&mut simulator, robot, record, start);
    let mut window = Window { states: Vec::with_capacity(samples), fault: None };
    for sample in start..start + samples {
        let tau = held_torque(robot, record, sample);
        if let Err(fault) = simulator.actuate(&tau) {
            window.fault = Some(fault);
            break;
        }
        window.states.push(encoder_state(&simulator, robot));
    }
    Ok(window)
}

fn without_inertia(joint: String) -> MachineFault {
    MachineFault {
        time_s: 0.0,
        joint,
        found: "neither its links nor its rotor have an inertia about its axis, a positive one was expected".to_owned(),
        advice: "give it rotor_inertia_kg_m2 in robot.toml".to_owned(),
    }
}

fn motion_of(robot: &Robot, record: &PreparedRun, starts: &[usize], windows: &[Window]) -> Run {
    let sample = |start: usize, i: usize| start + 1 + i;
    let places: Vec<(usize, &EncoderState)> = windows
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
