use catalogue::EffectKind;
use rand_chacha::ChaCha8Rng;
use robot::Robot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::effects::mistake::{Mistake, by_kind, joint_of, within};
use crate::effects::scenario_effect::ScenarioEffect;
use crate::effects::surroundings::Surroundings;
use crate::effects::truth::Truth;
use crate::mechanics::inject::Inject;
use crate::mechanics::plant::Plant;

/// Largest coefficient of a joint that turns (N m s/rad): a hundred times that of a WAM's shoulder.
const MOST_TURNING: f64 = 1000.0;

/// Largest coefficient of a joint that slides (N s/m): a thousand newtons at a centimetre per second. What a screw of
/// lead `l` makes of a motor's friction grows with `(2 pi / l)^2`, 4e5 for 10 mm and 1.6e6 for 5 mm.
const MOST_SLIDING: f64 = 1e5;

/// Torque against the motion in proportion to velocity.
///
/// ```text
/// friction = -viscous qd
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ViscousFriction {
    /// The joint.
    pub joint: String,
    /// Friction per unit of velocity, 0 to 1000 N m s/rad; 0 to 1e5 N s/m for a prismatic joint.
    pub viscous_nm_s_per_rad: f64,
}

impl ScenarioEffect for ViscousFriction {
    const KIND: EffectKind = EffectKind::ViscousFriction;

    fn truth(&self) -> Truth {
        Truth::at_joint(Self::KIND, &self.joint, &[("viscous", self.viscous_nm_s_per_rad)])
    }

    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        let joint = joint_of(robot, &self.joint)?;
        within("viscous_nm_s_per_rad", self.viscous_nm_s_per_rad, 0.0, most(robot, joint))?;
        Ok(Box::new(Injected { joint, viscous: self.viscous_nm_s_per_rad }))
    }

    fn draw(at: &Surroundings<'_>, share: f64, _: &mut ChaCha8Rng) -> Self {
        let viscous = share * at.torque_rms / at.speed_rms;
        Self { joint: at.joint_name(), viscous_nm_s_per_rad: viscous.min(most(at.robot, at.joint)) }
    }
}

fn most(robot: &Robot, joint: usize) -> f64 {
    by_kind(robot, joint, MOST_TURNING, MOST_SLIDING)
}

struct Injected {
    joint: usize,
    viscous: f64,
}

impl Inject for Injected {
    fn on_build(&mut self, plant: &mut Plant) {
        if let Some(link) = plant.robot.link_mut(self.joint) {
            link.actuator.viscous += self.viscous;
        }
    }
}
