use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use robot::Robot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::effects::mistake::{Mistake, joint_of, within};
use crate::effects::surroundings::Surroundings;
use crate::mechanics::inject::{Efforts, Inject, Moment};
use crate::strangers::kind::StrangerKind;
use crate::strangers::scenario_stranger::{ScenarioStranger, span, stiffest};
use crate::strangers::truth::StrangerTruth;

/// Something soft in the way of a link: a spring with damping on one side.
///
/// ```text
/// above:  torque = -max(0, stiffness x + damping qd),  x = q - wall > 0
/// below:  torque = -min(0, stiffness x + damping qd),  x = q - wall < 0
/// ```
///
/// It pushes back towards the free side and never pulls; off the wall there is no torque.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SoftWall {
    /// The joint.
    pub joint: String,
    /// Position at which it is touched (rad; m for a prismatic joint), -100 to 100.
    pub wall_rad: f64,
    /// On which side of that position it is.
    pub side: Side,
    /// Torque per unit of depth (N m/rad; N/m), 0 to 1e5.
    pub stiffness_nm_per_rad: f64,
    /// Torque per unit of velocity while it is touched (N m s/rad; N s/m), 0 to 1e4.
    #[serde(default)]
    pub damping_nm_s_per_rad: f64,
}

/// On which side of a position something is.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize, JsonSchema)]
#[serde(rename_all = "snake_case")]
pub enum Side {
    /// Above.
    Above,
    /// Below.
    Below,
}

impl Side {
    /// 1 above, -1 below.
    fn sign(self) -> f64 {
        match self {
            Self::Above => 1.0,
            Self::Below => -1.0,
        }
    }
}

impl ScenarioStranger for SoftWall {
    const KIND: StrangerKind = StrangerKind::SoftWall;

    fn truth(&self) -> StrangerTruth {
        let parameters = [
            ("wall", self.wall_rad),
            ("side", self.side.sign()),
            ("stiffness", self.stiffness_nm_per_rad),
            ("damping", self.damping_nm_s_per_rad),
        ];
        StrangerTruth::at_joint(Self::KIND, &self.joint, &parameters)
    }

    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        let joint = joint_of(robot, &self.joint)?;
        within("wall_rad", self.wall_rad, -100.0, 100.0)?;
        within("stiffness_nm_per_rad", self.stiffness_nm_per_rad, 0.0, 1e5)?;
        within("damping_nm_s_per_rad", self.damping_nm_s_per_rad, 0.0, 1e4)?;
        Ok(Box::new(Injected { joint, wall: self.clone() }))
    }

    /// A wall that a sine over the range `2 A` meets at `0.4 A`: `rms(depth) = 0.26 A`.
    fn draw(at: &Surroundings<'_>, share: f64, random: &mut ChaCha8Rng) -> Self {
        let half = 0.5 * span(at);
        let middle = 0.5 * (at.range.0 + at.range.1);
        let side = if random.random() { Side::Above } else { Side::Below };
        let stiffness = (share * at.torque_rms / (0.26 * half)).min(stiffest(at));
        Self {
            joint: at.joint_name(),
            wall_rad: middle + 0.4 * half * side.sign(),
            side,
            stiffness_nm_per_rad: stiffness,
            damping_nm_s_per_rad: (stiffness * random.random_range(0.002..0.02)).min(1e4),
        }
    }
}

struct Injected {
    joint: usize,
    wall: SoftWall,
}

impl Inject for Injected {
    fn on_substep(&mut self, moment: &Moment<'_>, efforts: &mut Efforts) {
        let (wall, sign) = (&self.wall, self.wall.side.sign());
        let depth = sign * (moment.q[self.joint] - wall.wall_rad);
        if depth <= 0.0 {
            return;
        }
        let speed = sign * moment.qd[self.joint];
        let push = wall.stiffness_nm_per_rad * depth + wall.damping_nm_s_per_rad * speed;
        efforts.link[self.joint] -= sign * push.max(0.0);
    }

    fn springs(&self) -> Vec<(usize, f64)> {
        vec![(self.joint, self.wall.stiffness_nm_per_rad)]
    }
}
