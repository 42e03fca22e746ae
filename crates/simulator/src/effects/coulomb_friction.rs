use catalogue::EffectKind;
use rand_chacha::ChaCha8Rng;
use robot::Robot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::effects::mistake::{Mistake, joint_of, within};
use crate::effects::scenario_effect::ScenarioEffect;
use crate::effects::surroundings::{MOST_DRY, Surroundings};
use crate::effects::truth::Truth;
use crate::mechanics::inject::Inject;
use crate::mechanics::plant::Plant;

/// Torque of constant size against the motion; a joint at rest is held by up to as much.
///
/// ```text
/// friction = -level sign(qd)
/// ```
///
/// A constraint of the engine: a joint that sticks does not creep.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct CoulombFriction {
    /// The joint.
    pub joint: String,
    /// Level in both directions (N m; N for a prismatic joint), 0 to 1000.
    pub level_nm: f64,
}

impl ScenarioEffect for CoulombFriction {
    const KIND: EffectKind = EffectKind::CoulombFriction;

    fn truth(&self) -> Truth {
        Truth::at_joint(Self::KIND, &self.joint, &[("level", self.level_nm)])
    }

    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        let joint = joint_of(robot, &self.joint)?;
        within("level_nm", self.level_nm, 0.0, MOST_DRY)?;
        Ok(Box::new(Injected { joint, level: self.level_nm }))
    }

    fn draw(at: &Surroundings<'_>, share: f64, _: &mut ChaCha8Rng) -> Self {
        Self { joint: at.joint_name(), level_nm: at.dry(share) }
    }
}

struct Injected {
    joint: usize,
    level: f64,
}

impl Inject for Injected {
    fn on_build(&mut self, plant: &mut Plant) {
        if let Some(link) = plant.robot.link_mut(self.joint) {
            link.actuator.coulomb_forward += self.level;
            link.actuator.coulomb_backward += self.level;
        }
    }
}
