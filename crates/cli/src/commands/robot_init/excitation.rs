use std::path::Path;

use dynamics::Dynamics;
use motion::MotionSpec;
use robot::Robot;

use super::quote::key;

/// Highest frequencies that are tried, the liveliest first (Hz).
const FREQUENCIES_HZ: [f64; 4] = [0.6, 0.4, 0.25, 0.15];
/// Shares of the position range that are tried.
const SHARES: [f64; 3] = [0.8, 0.5, 0.3];
/// Share of the effort limit that a motion may need; the controller takes the rest.
const EFFORT_SHARE: f64 = 0.7;
/// Samples a second at which the effort is looked at.
const SAMPLES_HZ: f64 = 40.0;
/// Length of a run (s).
pub const DURATION_S: f64 = 15.0;
/// Way from the middle of a joint without limits (rad or m).
const FREE_WAY: f64 = 1.0;
const FREE_WAY_M: f64 = 0.1;
/// Speed of a joint without limit (rad/s or m/s).
const FREE_SPEED: f64 = 1.0;
/// Seeds of the runs.
pub const SEEDS: [u64; 3] = [11, 12, 13];

/// Sinusoids at every joint that the drives can follow.
#[derive(Debug, Clone, PartialEq)]
pub struct Excitation {
    pub highest_hz: f64,
    pub position_share: f64,
    /// Whether the efforts stay within their limits.
    pub fits: bool,
    /// Joints without limits of position and their ways, ...
    pub ways: Vec<(String, f64)>,
    /// ... and those without a limit of speed, with their speeds.
    pub speeds: Vec<(String, f64)>,
}

impl Excitation {
    /// The liveliest of the motions whose efforts are well within the limits, or the slowest.
    pub fn within_limits(robot: &Robot) -> Self {
        let free = |link: &&robot::Link| link.joint.limits.position.is_none();
        let name = |link: &robot::Link| link.joint.name.clone();
        let links = robot.links().iter();
        let ways = links.clone().filter(free).map(|link| {
            let way = if link.joint.kind.is_rotation() { FREE_WAY } else { FREE_WAY_M };
            (name(link), way)
        });
        let quick = links.filter(|link| link.joint.limits.velocity.is_none());
        let mut excitation = Self {
            highest_hz: 0.0,
            position_share: 0.0,
            fits: false,
            ways: ways.collect(),
            speeds: quick.map(|link| (name(link), FREE_SPEED)).collect(),
        };
        for share in SHARES {
            for frequency in FREQUENCIES_HZ {
                (excitation.highest_hz, excitation.position_share) = (frequency, share);
                if SEEDS.iter().all(|seed| excitation.is_within(robot, *seed)) {
                    return Self { fits: true, ..excitation };
                }
            }
        }
        excitation
    }

    /// The motion of a run, as a scenario says it.
    pub fn motion(&self, seed: u64) -> String {
        let table = |name: &str, pairs: &[(String, f64)]| {
            if pairs.is_empty() {
                return String::new();
            }
            let pair = |(joint, value): &(String, f64)| format!("{} = {value:?}", key(joint));
            let pairs: Vec<String> = pairs.iter().map(pair).collect();
            format!(", {name} = {{ {} }}", pairs.join(", "))
        };
        format!(
            "{{ seed = {seed}, terms = 4, lowest_hz = {:?}, highest_hz = {:?}, duration_s = {DURATION_S:?}, position_share = {:?}{}{} }}",
            0.25 * self.highest_hz,
            self.highest_hz,
            self.position_share,
            table("amplitude_rad", &self.ways),
            table("max_speed_rad_per_s", &self.speeds)
        )
    }

    /// Whether the effort of a run stays within its share of the limits.
    fn is_within(&self, robot: &Robot, seed: u64) -> bool {
        let text = format!("sinusoids = {}", self.motion(seed));
        let Ok(spec) = toml::from_str::<MotionSpec>(&text) else { return false };
        let Ok(motion) = spec.build(robot, Path::new("")) else { return false };
        let dynamics = Dynamics::new(robot);
        let samples = (motion.duration_s() * SAMPLES_HZ) as usize;
        (0..samples).all(|k| {
            let state = motion.at(k as f64 / SAMPLES_HZ);
            let Ok(tau) = dynamics.inverse_dynamics(&state.q, &state.qd, &state.qdd) else {
                return false;
            };
            robot.links().iter().enumerate().all(|(j, link)| {
                let a = &link.actuator;
                let friction = a.coulomb_forward + a.viscous * state.qd[j].abs();
                let needed = (tau[j] + a.rotor_inertia * state.qdd[j]).abs() + friction;
                link.joint.limits.effort.is_none_or(|limit| needed < EFFORT_SHARE * limit)
            })
        })
    }
}
