use std::f64::consts::PI;

use catalogue::EffectKind;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use robot::{Actuator, Robot};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::effects::mistake::{Mistake, joint_of, within};
use crate::effects::scenario_effect::ScenarioEffect;
use crate::effects::surroundings::Surroundings;
use crate::effects::truth::Truth;
use crate::mechanics::inject::{Efforts, Inject, Moment};

/// A hose or cable along the arm: a spring at the link with a loop.
///
/// ```text
/// friction = -(stiffness x + cubic x³ + h),  x = q - rest
/// hd = stiffness qd  while |h| < hysteresis, else 0
/// ```
///
/// The loop is a second spring of the same stiffness that slides at `hysteresis`; it starts
/// relaxed. Where it pulls on one side only, the cable is slack on the other (`x = 0`) and
/// never pushes.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CableSpring {
    /// The joint.
    pub joint: String,
    /// Torque per unit of displacement (N m/rad; N/m for a prismatic joint), 0 to 1e5.
    pub stiffness_nm_per_rad: f64,
    /// Position at which the spring is slack (rad; m), -100 to 100.
    pub rest_rad: f64,
    /// Torque per cube of displacement (N m/rad³; N/m³), 0 to 1e5.
    #[serde(default)]
    pub cubic_nm_per_rad3: f64,
    /// Half the width of the loop of torque over position (N m; N), 0 to 1000.
    #[serde(default)]
    pub hysteresis_nm: f64,
    /// On which side of the rest position it pulls.
    #[serde(default)]
    pub pulls: Pulls,
}

/// On which side of its rest position a cable pulls.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Pulls {
    /// On both.
    #[default]
    Both,
    /// Above its rest position, back down.
    Above,
    /// Below its rest position, back up.
    Below,
}

impl ScenarioEffect for CableSpring {
    const KIND: EffectKind = EffectKind::CableSpring;

    fn truth(&self) -> Truth {
        let parameters = [
            ("stiffness", self.stiffness_nm_per_rad),
            ("rest", self.rest_rad),
            ("cubic", self.cubic_nm_per_rad3),
            ("hysteresis", self.hysteresis_nm),
        ];
        Truth::at_joint(Self::KIND, &self.joint, &parameters)
    }

    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        let joint = joint_of(robot, &self.joint)?;
        within("stiffness_nm_per_rad", self.stiffness_nm_per_rad, 0.0, 1e5)?;
        within("rest_rad", self.rest_rad, -100.0, 100.0)?;
        within("cubic_nm_per_rad3", self.cubic_nm_per_rad3, 0.0, 1e5)?;
        within("hysteresis_nm", self.hysteresis_nm, 0.0, 1000.0)?;
        if self.hysteresis_nm > 0.0 && self.stiffness_nm_per_rad <= 0.0 {
            let found = format!("{} without a stiffness, 0 was expected", self.hysteresis_nm);
            return Err(Mistake { key: "hysteresis_nm", found });
        }
        Ok(Box::new(Injected::new(robot, joint, self.clone(), self.stiffness_nm_per_rad)))
    }

    /// A spring about a place in the joint's range, whose torque a quarter of the range away is
    /// the share; up to a quarter of it stiffens, a tenth to two fifths of it is the loop.
    fn draw(at: &Surroundings<'_>, share: f64, random: &mut ChaCha8Rng) -> Self {
        let (low, high) = at.range;
        let (torque, x) = (share * at.torque_rms, (0.25 * (high - low)).max(1e-3));
        let stiffness = (torque / x).min(1e5);
        Self {
            joint: at.joint_name(),
            stiffness_nm_per_rad: stiffness,
            rest_rad: low + (high - low) * random.random_range(0.25..0.75),
            cubic_nm_per_rad3: (stiffness / (x * x) * random.random_range(0.0..0.25)).min(1e5),
            hysteresis_nm: (torque * random.random_range(0.1..0.4)).min(1000.0),
            pulls: Pulls::Both,
        }
    }
}

/// How far the joint gets from a position (rad or m): to its farther limit, else half a turn
/// or 1 m.
fn reach(robot: &Robot, joint: usize, rest: f64) -> f64 {
    let joint = &robot.links()[joint].joint;
    match joint.limits.position {
        Some((low, high)) => (high - rest).abs().max((low - rest).abs()),
        None if joint.kind.is_rotation() => PI,
        None => 1.0,
    }
}

/// What the description says of a joint's cable apart from `stiffness x`, which is part of the
/// [`Plant`](crate::Plant).
pub(super) fn beyond_linear(
    robot: &Robot,
    joint: usize,
    drive: &Actuator,
) -> Option<Box<dyn Inject>> {
    let bends = drive.spring_cubic.abs() > 0.0 || drive.spring_hysteresis > 0.0;
    bends.then(|| {
        let cable = CableSpring {
            joint: String::new(),
            stiffness_nm_per_rad: drive.spring_stiffness,
            rest_rad: drive.spring_rest,
            cubic_nm_per_rad3: drive.spring_cubic,
            hysteresis_nm: drive.spring_hysteresis,
            pulls: Pulls::Both,
        };
        Box::new(Injected::new(robot, joint, cable, 0.0)) as Box<dyn Inject>
    })
}

struct Injected {
    joint: usize,
    cable: CableSpring,
    /// Torque per unit of displacement that acts here; the loop has the cable's.
    linear: f64,
    /// Farthest expected displacement (rad or m).
    reach: f64,
    /// Displacement at the last step (rad or m).
    x: f64,
    /// Torque of the sliding spring (N m or N).
    sliding: f64,
}

impl Injected {
    fn new(robot: &Robot, joint: usize, cable: CableSpring, linear: f64) -> Self {
        let reach = reach(robot, joint, cable.rest_rad);
        Self { joint, cable, linear, reach, x: 0.0, sliding: 0.0 }
    }

    /// How far the cable is drawn out of its slack (rad or m).
    fn displacement(&self, q: f64) -> f64 {
        let x = q - self.cable.rest_rad;
        match self.cable.pulls {
            Pulls::Both => x,
            Pulls::Above => x.max(0.0),
            Pulls::Below => x.min(0.0),
        }
    }
}

impl Inject for Injected {
    fn on_start(&mut self, q: &[f64]) {
        self.x = self.displacement(q[self.joint]);
        self.sliding = 0.0;
    }

    fn on_substep(&mut self, moment: &Moment<'_>, efforts: &mut Efforts) {
        let (cable, x) = (&self.cable, self.displacement(moment.q[self.joint]));
        let sliding = self.sliding + cable.stiffness_nm_per_rad * (x - self.x);
        self.sliding = sliding.clamp(-cable.hysteresis_nm, cable.hysteresis_nm);
        let pull = self.linear * x + cable.cubic_nm_per_rad3 * x.powi(3) + self.sliding;
        self.x = x;
        efforts.link[self.joint] -= match cable.pulls {
            Pulls::Both => pull,
            Pulls::Above => pull.max(0.0),
            Pulls::Below => pull.min(0.0),
        };
    }

    /// Both springs and the slope of the cubic term at the farthest.
    fn springs(&self) -> Vec<(usize, f64)> {
        let cable = &self.cable;
        let sliding = if cable.hysteresis_nm > 0.0 { cable.stiffness_nm_per_rad } else { 0.0 };
        let cubic = 3.0 * cable.cubic_nm_per_rad3 * self.reach.powi(2);
        vec![(self.joint, self.linear + sliding + cubic)]
    }
}
