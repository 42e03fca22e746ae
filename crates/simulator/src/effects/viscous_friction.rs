use catalogue::EffectKind;
use rand_chacha::ChaCha8Rng;
use robot::Robot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::effects::mistake::{Mistake, joint_of, within};
use crate::effects::scenario_effect::ScenarioEffect;
use crate::effects::surroundings::Surroundings;
use crate::effects::truth::Truth;
use crate::mechanics::inject::Inject;
use crate::mechanics::plant::Plant;

/// Largest coefficient (N m s/rad): a hundred times that of a WAM's shoulder.
const MAX_VISCOUS: f64 = 1000.0;

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
    /// Friction per unit of velocity (N m s/rad; N s/m for a prismatic joint), 0 to 1000.
    pub viscous_nm_s_per_rad: f64,
}

impl ScenarioEffect for ViscousFriction {
    const KIND: EffectKind = EffectKind::ViscousFriction;

    fn truth(&self) -> Truth {
        Truth::at_joint(Self::KIND, &self.joint, &[("viscous", self.viscous_nm_s_per_rad)])
    }

    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        let joint = joint_of(robot, &self.joint)?;
        within("viscous_nm_s_per_rad", self.viscous_nm_s_per_rad, 0.0, MAX_VISCOUS)?;
        Ok(Box::new(Injected { joint, viscous: self.viscous_nm_s_per_rad }))
    }

    fn draw(at: &Surroundings<'_>, share: f64, _: &mut ChaCha8Rng) -> Self {
        let viscous = share * at.torque_rms / at.speed_rms;
        Self { joint: at.joint_name(), viscous_nm_s_per_rad: viscous.min(MAX_VISCOUS) }
    }
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
