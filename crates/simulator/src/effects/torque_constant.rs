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

/// Largest factor that is drawn: constants of one motor differ by a tenth, and what is off by more
/// than this nobody takes for a torque.
const LARGEST_DRAWN: f64 = 1.5;

/// Effort reported and commanded in a wrong unit of torque.
///
/// ```text
/// effort = gain tau
/// ```
///
/// It multiplies the robot's own `torque_gain`, which also scales the log's effort: a command is
/// divided by it, a measured torque multiplied.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TorqueConstant {
    /// The joint.
    pub joint: String,
    /// Reported effort per unit of torque, 0.1 to 10; 1 is right.
    pub gain: f64,
}

impl ScenarioEffect for TorqueConstant {
    const KIND: EffectKind = EffectKind::TorqueConstant;

    fn truth(&self) -> Truth {
        Truth::at_joint(Self::KIND, &self.joint, &[("gain", self.gain)])
    }

    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        let joint = joint_of(robot, &self.joint)?;
        within("gain", self.gain, 0.1, 10.0)?;
        Ok(Box::new(Injected { joint, gain: self.gain }))
    }

    /// A gain too high or too low by the share.
    fn draw(at: &Surroundings<'_>, share: f64, random: &mut ChaCha8Rng) -> Self {
        let gain = (1.0 + share).min(LARGEST_DRAWN);
        let gain = if random.random() { gain } else { gain.recip() };
        Self { joint: at.joint_name(), gain }
    }
}

struct Injected {
    joint: usize,
    gain: f64,
}

impl Inject for Injected {
    fn on_build(&mut self, plant: &mut Plant) {
        if let Some(link) = plant.robot.link_mut(self.joint) {
            link.actuator.torque_gain *= self.gain;
        }
    }
}
