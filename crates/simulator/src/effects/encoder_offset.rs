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

/// Largest offset that is drawn (rad or m): a joint that stands 17 degrees off is seen by eye.
const LARGEST_DRAWN: f64 = 0.3;

/// An encoder whose zero is not the joint's.
///
/// ```text
/// q reported = q + offset
/// ```
///
/// The controller sees it too, so the arm goes elsewhere than it was sent.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EncoderOffset {
    /// The joint.
    pub joint: String,
    /// Position reported at true position zero (rad; m for a prismatic joint), -10 to 10.
    pub offset_rad: f64,
}

impl ScenarioEffect for EncoderOffset {
    const KIND: EffectKind = EffectKind::EncoderOffset;

    fn truth(&self) -> Truth {
        Truth::at_joint(Self::KIND, &self.joint, &[("offset", self.offset_rad)])
    }

    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        let joint = joint_of(robot, &self.joint)?;
        within("offset_rad", self.offset_rad, -10.0, 10.0)?;
        Ok(acting(joint, self.offset_rad))
    }

    /// The torque is off by about `offset d(tau)/dq`.
    fn draw(at: &Surroundings<'_>, share: f64, random: &mut ChaCha8Rng) -> Self {
        let offset = (share * at.torque_rms / at.torque_per_position()).min(LARGEST_DRAWN);
        Self { joint: at.joint_name(), offset_rad: if random.random() { offset } else { -offset } }
    }
}

/// The offset (rad or m) of a joint's encoder, ready to act.
pub(super) fn acting(joint: usize, offset: f64) -> Box<dyn Inject> {
    Box::new(Injected { joint, offset })
}

struct Injected {
    joint: usize,
    offset: f64,
}

impl Inject for Injected {
    fn on_reading(&mut self, reading: &mut Reading) {
        reading.q[self.joint] += self.offset;
    }
}
