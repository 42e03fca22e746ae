use catalogue::EffectKind;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use robot::{Reading, Robot};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::effects::mistake::{Mistake, joint_of, within};
use crate::effects::scenario_effect::ScenarioEffect;
use crate::effects::surroundings::Surroundings;
use crate::effects::truth::Truth;
use crate::mechanics::inject::Inject;
use crate::mechanics::plant::Plant;

/// Largest factor that is drawn: a pulley of 24 teeth taken for one of 20.
const LARGEST_DRAWN: f64 = 1.2;

/// A gear ratio that is not the one the drive was told.
///
/// ```text
/// q = ratio q_reported,   qd = ratio qd_reported,   tau = effort / ratio
/// ```
///
/// Power is the same on both sides. A command is an effort too, and so is a measured torque.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TransmissionRatio {
    /// The joint.
    pub joint: String,
    /// True over reported position, 0.1 to 10; 1 is right.
    pub ratio: f64,
}

impl ScenarioEffect for TransmissionRatio {
    const KIND: EffectKind = EffectKind::TransmissionRatio;

    fn truth(&self) -> Truth {
        Truth::at_joint(Self::KIND, &self.joint, &[("ratio", self.ratio)])
    }

    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        let joint = joint_of(robot, &self.joint)?;
        within("ratio", self.ratio, 0.1, 10.0)?;
        Ok(acting(joint, self.ratio))
    }

    /// A ratio too high or too low by the share.
    fn draw(at: &Surroundings<'_>, share: f64, random: &mut ChaCha8Rng) -> Self {
        let ratio = (1.0 + share).min(LARGEST_DRAWN);
        let ratio = if random.random() { ratio } else { ratio.recip() };
        Self { joint: at.joint_name(), ratio }
    }
}

/// The ratio of a joint, ready to act.
pub(super) fn acting(joint: usize, ratio: f64) -> Box<dyn Inject> {
    Box::new(Injected { joint, ratio })
}

struct Injected {
    joint: usize,
    ratio: f64,
}

impl Inject for Injected {
    fn on_build(&mut self, plant: &mut Plant) {
        if let Some(link) = plant.robot.link_mut(self.joint) {
            link.actuator.torque_gain *= self.ratio;
        }
    }

    fn on_reading(&mut self, reading: &mut Reading) {
        reading.q[self.joint] /= self.ratio;
        reading.qd[self.joint] /= self.ratio;
    }
}
