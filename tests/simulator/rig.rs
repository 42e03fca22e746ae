//! Arms that are simple enough for a closed form, and a way to run them.

use nalgebra::{Complex, Isometry3, Matrix3, Unit, Vector3};
use robot::{
    Actuator, Inertia, Joint, JointKind, Limits, Link, Machine, MachineFault, Reading, Robot,
};
use simulator::effects::EffectSpec;
use simulator::{Sensors, Simulator, SimulatorError, StepOrder, Stepping};

pub const GRAVITY: f64 = 9.81;

/// A joint about the horizontal y axis at the origin that carries `mass` (kg) at `distance` (m)
/// along x, and nothing else: at `q` its gravity torque is `-m g l cos(q)` as `M qdd + g = tau`
/// counts it, since a positive turn about y lowers x. No rotor.
pub fn pendulum(mass: f64, distance: f64) -> Robot {
    let inertia = Inertia {
        mass,
        com_in_link: Vector3::new(distance, 0.0, 0.0),
        about_com: Matrix3::zeros(),
    };
    one_joint(JointKind::Continuous, inertia, Actuator::default())
}

/// A joint about the vertical, so without gravity, with the inertia `inertia` (kg m²) about its
/// axis and a rotor (kg m²).
pub fn flywheel(inertia: f64, rotor_inertia: f64) -> Robot {
    let body = Inertia {
        mass: 1.0,
        com_in_link: Vector3::zeros(),
        about_com: Matrix3::from_diagonal(&Vector3::new(inertia, inertia, inertia)),
    };
    let actuator = Actuator { rotor_inertia, ..Actuator::default() };
    let mut robot = one_joint(JointKind::Continuous, body, actuator);
    robot.link_mut(0).unwrap().joint.axis_in_joint = Vector3::z_axis();
    robot
}

fn one_joint(kind: JointKind, inertia: Inertia, actuator: Actuator) -> Robot {
    Robot::new(
        "rig",
        Vector3::new(0.0, 0.0, -GRAVITY),
        vec![link("joint", None, kind, inertia, actuator)],
    )
    .unwrap()
}

pub fn link(
    name: &str,
    parent: Option<usize>,
    kind: JointKind,
    inertia: Inertia,
    actuator: Actuator,
) -> Link {
    let joint = Joint {
        name: name.to_owned(),
        kind,
        parent_from_joint: Isometry3::identity(),
        axis_in_joint: Unit::new_normalize(Vector3::y()),
        limits: Limits::default(),
    };
    Link { name: format!("{name}_link"), parent, joint, inertia, actuator, merged: Vec::new() }
}

/// 500 Hz commands in steps of 0.1 ms, no stops.
pub const STEPPING: Stepping =
    Stepping { step_s: 1e-4, steps_per_period: 20, stops: false, order: StepOrder::First };

/// The effects of a piece of TOML in the shape of a scenario, such as
/// `[[effect]]` `coulomb_friction = { joint = "joint", level_nm = 1.0 }`.
pub fn effects(toml: &str) -> Vec<EffectSpec> {
    #[derive(serde::Deserialize)]
    struct Effects {
        effect: Vec<EffectSpec>,
    }
    toml::from_str::<Effects>(toml).unwrap().effect
}

/// A simulator with perfect sensors and the effects of a piece of TOML.
pub fn simulator(
    robot: &Robot,
    toml: &str,
    stepping: Stepping,
) -> Result<Simulator, SimulatorError> {
    sensing(robot, toml, stepping, Sensors::perfect(robot.joint_count()))
}

/// The same with other sensors.
pub fn sensing(
    robot: &Robot,
    toml: &str,
    stepping: Stepping,
    sensors: Sensors,
) -> Result<Simulator, SimulatorError> {
    let injected = effects(toml).iter().map(|e| e.inject(robot).unwrap()).collect();
    Simulator::new(robot, injected, sensors, stepping)
}

/// One row of a run: what is true, and what the log says.
#[derive(Debug, Clone, PartialEq)]
pub struct Row {
    pub time_s: f64,
    pub q_true: Vec<f64>,
    pub qd_true: Vec<f64>,
    pub motor_q_true: Vec<f64>,
    /// Torque of the motors in the last step before this instant.
    pub motor_torque_true: Vec<f64>,
    /// The row of the log at this instant.
    pub logged: Reading,
}

/// Runs for a time (s) under a torque that follows from what is read.
pub fn run(
    simulator: &mut Simulator,
    duration_s: f64,
    mut torque: impl FnMut(&Reading) -> Vec<f64>,
) -> Result<Vec<Row>, MachineFault> {
    let periods = (duration_s / simulator.period_s()).round() as usize;
    let mut reading = Reading::zero(simulator.joint_count());
    let mut logged = reading.clone();
    let mut rows = Vec::with_capacity(periods);
    for _ in 0..periods {
        simulator.read(&mut reading)?;
        let mut row = Row {
            time_s: simulator.time_s(),
            q_true: simulator.q_true().to_vec(),
            qd_true: simulator.qd_true().to_vec(),
            motor_q_true: simulator.motor_q_true().to_vec(),
            motor_torque_true: simulator.motor_torque_true().to_vec(),
            logged: Reading::default(),
        };
        simulator.actuate(&torque(&reading))?;
        simulator.record(&reading, &mut logged);
        row.logged = logged.clone();
        rows.push(row);
    }
    Ok(rows)
}

/// The same with every step of the engine in the rows.
pub const FINE: Stepping = Stepping { steps_per_period: 1, ..STEPPING };

/// Times (s) at which a value of the rows passes zero upwards, to a fraction of a row.
pub fn crossings(rows: &[Row], value: impl Fn(&Row) -> f64) -> Vec<f64> {
    let pass = |w: &[Row]| {
        let (a, b) = (value(&w[0]), value(&w[1]));
        let share = a / (a - b);
        (a < 0.0 && b >= 0.0).then(|| w[0].time_s + share * (w[1].time_s - w[0].time_s))
    };
    rows.windows(2).filter_map(pass).collect()
}

/// Mean time (s) from one of the times to the next.
pub fn period(times: &[f64]) -> f64 {
    assert!(times.len() > 3, "{times:?}");
    (times[times.len() - 1] - times[0]) / (times.len() - 1) as f64
}

/// Times (s) and torques (N m) that move a wheel of some inertia (kg m²), from the motion alone:
///
/// ```text
/// tau(k) = inertia (q(k+1) - 2 q(k) + q(k-1)) / dt²
/// ```
///
/// which a leapfrog makes exact where every step is a row.
pub fn acting(rows: &[Row], inertia: f64) -> Vec<(f64, f64)> {
    let torque = |w: &[Row]| {
        let (dt, q) = (w[1].time_s - w[0].time_s, [0, 1, 2].map(|k| w[k].motor_q_true[0]));
        (w[1].time_s, inertia * (q[2] - 2.0 * q[1] + q[0]) / (dt * dt))
    };
    rows.windows(3).map(torque).collect()
}

/// Projection of samples (time in s, value) on cosine and sine: `a` of `a sin(w t)` as `-i a`.
/// The samples span whole periods and are evenly spaced.
pub fn phasor(samples: &[(f64, f64)], frequency_hz: f64) -> Complex<f64> {
    let omega = std::f64::consts::TAU * frequency_hz;
    let turned = samples.iter().map(|&(t, value)| Complex::from_polar(value, -omega * t));
    turned.sum::<Complex<f64>>() * (2.0 / samples.len() as f64)
}
