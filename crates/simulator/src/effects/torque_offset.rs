use catalogue::EffectKind;
use rand::RngExt;
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

/// A constant in the reported effort.
///
/// ```text
/// effort = tau + offset
/// ```
///
/// It adds to the robot's own `torque_offset`: an effort of `offset` is asked for and reported
/// where the motor gives no torque.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TorqueOffset {
    /// The joint.
    pub joint: String,
    /// Effort at zero torque (N m; N for a prismatic joint), -1000 to 1000.
    pub offset_nm: f64,
}

impl ScenarioEffect for TorqueOffset {
    const KIND: EffectKind = EffectKind::TorqueOffset;

    fn truth(&self) -> Truth {
        Truth::at_joint(Self::KIND, &self.joint, &[("offset", self.offset_nm)])
    }

    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        let joint = joint_of(robot, &self.joint)?;
        within("offset_nm", self.offset_nm, -1000.0, 1000.0)?;
        Ok(Box::new(Injected { joint, offset: self.offset_nm }))
    }

    fn draw(at: &Surroundings<'_>, share: f64, random: &mut ChaCha8Rng) -> Self {
        let offset = (share * at.torque_rms).min(1000.0);
        Self { joint: at.joint_name(), offset_nm: if random.random() { offset } else { -offset } }
    }
}

struct Injected {
    joint: usize,
    offset: f64,
}

impl Inject for Injected {
    fn on_build(&mut self, plant: &mut Plant) {
        if let Some(link) = plant.robot.link_mut(self.joint) {
            link.actuator.torque_offset += self.offset;
        }
    }
}
