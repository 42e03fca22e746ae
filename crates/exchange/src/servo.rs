use robot::{Link, Loaded, PdGain, Robot};

use crate::fate::Fate;
use crate::numbers::size;

/// The position loop of a drive between true position and true torque.
///
/// ```text
/// tau = goal_gain goal(t - late) - kp q - kd qd + constant,   |tau| <= limit
/// ```
///
/// With `kp0`, `kd0` the gains of the loop, which act on reported positions `q / ratio` and give the reported effort
/// `gain ratio tau + offset` (units: rad or m, N·m or N, s):
///
/// ```text
/// goal_gain = kp0 / (gain ratio)    kp = goal_gain / ratio    kd = kd0 / (gain ratio²)    constant = -offset / (gain ratio)
/// ```
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Servo {
    pub goal_gain: f64,
    pub kp: f64,
    pub kd: f64,
    pub constant: f64,
    pub limit: Option<f64>,
    /// Time by which a goal acts late: that of the goal and that of the torque.
    pub late_s: f64,
}

impl Servo {
    /// The loop of a link's drive; `None` where it has none.
    pub fn of(link: &Link) -> Option<Self> {
        let a = &link.actuator;
        let PdGain { kp, kd } = a.position_loop?;
        let scale = a.torque_gain * a.transmission_ratio;
        Some(Self {
            goal_gain: kp / scale,
            kp: kp / (scale * a.transmission_ratio),
            kd: kd / (scale * a.transmission_ratio),
            constant: -a.torque_offset / scale,
            limit: link.joint.limits.effort,
            late_s: a.goal_delay_s + a.delay_s + a.lag_s,
        })
    }

    /// What becomes of a delay or lag of a link's torque (s): simulators delay the goal alone.
    pub fn late_torque(&self, late_s: f64, link: &Link) -> Fate {
        let unit = if link.joint.kind.is_rotation() { "N·m·s/rad" } else { "N·s/m" };
        let damping = size(self.kp * late_s);
        Fate::near(format!(
            "goals act later by it, the feedback does not: a damping of {damping} {unit} too much"
        ))
    }
}

/// The robot with the gains of its controller as position loops of the joints that have none of their own.
pub fn with_controllers(loaded: &Loaded, robot: &Robot) -> Robot {
    let mut robot = robot.clone();
    for (index, gain) in loaded.control.gains.iter().enumerate() {
        let Some(link) = robot.link_mut(index) else { continue };
        link.actuator.position_loop = link.actuator.position_loop.or(*gain);
    }
    robot
}

/// What becomes of the delay of goals, which `place` holds.
pub fn goal_delay(link: &Link, place: &str) -> Fate {
    match link.actuator.goal_hold_s {
        Some(_) => Fate::exact(place),
        None => Fate::near(format!(
            "{place}; half the time for which goals were held is part of it, as goal_hold_hz is not given"
        )),
    }
}
