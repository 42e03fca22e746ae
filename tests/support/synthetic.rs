//! Logs made from a robot by the project's own inverse dynamics, with noise, and with
//! effects that the caller writes down as formulas.

use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

use dynamics::Dynamics;
use logs::{Channels, Run};
use rand::{RngExt, SeedableRng};
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, StandardNormal};
use robot::{Robot, TorqueSource};

/// The WAM as it is described in the project.
pub fn wam() -> Robot {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../robots/wam7/robot.toml");
    let mut robot = Robot::load(&path).expect("robots/wam7 is part of the project").robot;
    // The efforts made here belong to the time of their samples, those of a command do not.
    for i in 0..robot.joint_count() {
        robot.link_mut(i).expect("a link of the robot").actuator.torque_source =
            TorqueSource::Measured;
    }
    robot
}

/// Standard deviations of white noise, per joint.
#[derive(Debug, Clone)]
pub struct Noise {
    /// Of the effort (N m).
    pub effort: Vec<f64>,
    /// Of the position (rad).
    pub position: f64,
    /// Of the velocity (rad/s).
    pub velocity: f64,
}

impl Noise {
    /// As wide as the fast part of what real WAM logs leave (IJRR 33(6):931-944, figure of
    /// the validation): 0.3 N m at the shoulder to 0.007 at the palm; a position to half a
    /// count of a motor encoder.
    pub fn of_a_wam() -> Self {
        Self {
            effort: vec![0.3, 0.3, 0.15, 0.12, 0.015, 0.012, 0.007],
            position: 2e-5,
            velocity: 1e-3,
        }
    }
}

/// State of one joint: position (rad), velocity (rad/s), acceleration (rad/s²).
pub type State = [f64; 3];

/// What makes the log differ from the robot it is compared with.
pub struct Truth<'a> {
    /// The robot whose rigid bodies and rotors move.
    pub robot: &'a Robot,
    /// Torque that acts at a joint besides (N m), as it enters the effort.
    pub torque: &'a dyn Fn(usize, State) -> f64,
    /// Reported effort of a joint for a true one.
    pub reading: &'a dyn Fn(usize, f64) -> f64,
}

impl<'a> Truth<'a> {
    /// The robot and nothing else.
    pub fn of(robot: &'a Robot) -> Self {
        Self { robot, torque: &|_, _| 0.0, reading: &|_, effort| effort }
    }
}

/// A motion: sums of harmonics of 0.1 Hz along a path that is walked in steps of three
/// seconds with a rest of one second between them.
struct Motion {
    centre: Vec<f64>,
    amplitude: Vec<[f64; 4]>,
    phase: Vec<[f64; 4]>,
}

impl Motion {
    fn new(robot: &Robot, rng: &mut ChaCha8Rng) -> Self {
        let (mut centre, mut amplitude, mut phase) = (Vec::new(), Vec::new(), Vec::new());
        for link in robot.links() {
            let (low, high) = link.joint.limits.position.unwrap_or((-3.0, 3.0));
            centre.push(0.5 * (low + high));
            let half = 0.4 * (high - low);
            let share: [f64; 4] = std::array::from_fn(|_| rng.random_range(0.2..1.0));
            let total: f64 = share.iter().sum();
            amplitude.push(share.map(|s| s * half / total));
            phase.push(std::array::from_fn(|_| rng.random_range(0.0..std::f64::consts::TAU)));
        }
        Self { centre, amplitude, phase }
    }

    /// The state of a joint, with the path walked so many times as fast as in three seconds a step.
    fn at(&self, joint: usize, time: f64, pace: f64) -> State {
        let (s, ds, dds) = path(pace * time);
        let (ds, dds) = (pace * ds, pace * pace * dds);
        let mut state = [self.centre[joint], 0.0, 0.0];
        for k in 0..4 {
            let w = std::f64::consts::TAU * 0.1 * (k + 1) as f64;
            let (a, angle) = (self.amplitude[joint][k], w * s + self.phase[joint][k]);
            state[0] += a * angle.sin();
            state[1] += a * w * angle.cos() * ds;
            state[2] += a * w * angle.cos() * dds - a * w * w * angle.sin() * ds * ds;
        }
        state
    }
}

/// Path length and its derivatives: `10 u^3 - 15 u^4 + 6 u^5` over three seconds, then rest.
fn path(time: f64) -> (f64, f64, f64) {
    let step = (time / 4.0).floor();
    let u = ((time - 4.0 * step) / 3.0).min(1.0);
    let s = 3.0 * (step + u.powi(3) * (10.0 - 15.0 * u + 6.0 * u * u));
    let ds = 30.0 * u * u * (1.0 - u).powi(2);
    let dds = (60.0 * u - 180.0 * u * u + 120.0 * u.powi(3)) / 3.0;
    (s, ds, dds)
}

/// One run of `seconds` at 250 Hz.
pub fn run(truth: &Truth, noise: &Noise, seconds: f64, seed: u64) -> Run {
    run_at(truth, noise, [seconds, 250.0], seed)
}

/// One run of so many seconds at so many hertz: every number follows from the seed.
pub fn run_at(truth: &Truth, noise: &Noise, [seconds, hertz]: [f64; 2], seed: u64) -> Run {
    run_paced(truth, noise, [seconds, hertz, 1.0], seed)
}

/// The same, with the motion so many times as fast.
pub fn run_paced(truth: &Truth, noise: &Noise, [seconds, hertz, pace]: [f64; 3], seed: u64) -> Run {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    let motion = Motion::new(truth.robot, &mut rng);
    let n = truth.robot.joint_count();
    let dynamics = Dynamics::new(truth.robot);
    let time: Vec<f64> = (0..(seconds * hertz) as usize).map(|t| t as f64 / hertz).collect();
    let channels = |link: &robot::Link| Channels {
        name: link.joint.name.clone(),
        velocity: Some(Vec::new()),
        ..Channels::default()
    };
    let mut joints: Vec<Channels> = truth.robot.links().iter().map(channels).collect();
    for &t in &time {
        let states: Vec<State> = (0..n).map(|j| motion.at(j, t, pace)).collect();
        let part = |k: usize| states.iter().map(|s| s[k]).collect::<Vec<_>>();
        let tau = dynamics.inverse_dynamics(&part(0), &part(1), &part(2)).unwrap();
        for (j, joint) in joints.iter_mut().enumerate() {
            let rotor = truth.robot.links()[j].actuator.rotor_inertia * states[j][2];
            let effort = (truth.reading)(j, tau[j] + rotor + (truth.torque)(j, states[j]));
            let mut draw = |sd: f64| -> f64 {
                let z: f64 = StandardNormal.sample(&mut rng);
                sd * z
            };
            joint.effort.push(effort + draw(noise.effort[j]));
            joint.position.push(states[j][0] + draw(noise.position));
            let velocity = states[j][1] + draw(noise.velocity);
            joint.velocity.as_mut().unwrap().push(velocity);
        }
    }
    whole_run(&format!("run_{seed}"), time, joints)
}

/// A run that is in no file, with nothing beside its joints.
pub fn whole_run(name: &str, time: Vec<f64>, joints: Vec<Channels>) -> Run {
    Run {
        name: name.to_owned(),
        source: PathBuf::new(),
        sha256: String::new(),
        is_torn: false,
        mended: Vec::new(),
        time,
        joints,
        extra: BTreeMap::new(),
    }
}

/// Three runs of 12 s with different motions.
pub fn log(truth: &Truth, seed: u64) -> Vec<Run> {
    (0..3).map(|k| run(truth, &Noise::of_a_wam(), 12.0, 10 * seed + k)).collect()
}
