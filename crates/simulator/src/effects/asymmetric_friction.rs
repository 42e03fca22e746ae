use catalogue::EffectKind;
use rand::RngExt;
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

/// Dry friction with one level for each direction of motion.
///
/// ```text
/// friction = -forward  for qd > 0,  backward  for qd < 0
/// ```
///
/// A joint at rest is held against a torque of up to `forward`, and down to `-backward`.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct AsymmetricFriction {
    /// The joint.
    pub joint: String,
    /// Level against positive motion (N m; N for a prismatic joint), 0 to 1000.
    pub forward_nm: f64,
    /// Level against negative motion (N m; N for a prismatic joint), 0 to 1000.
    pub backward_nm: f64,
}

impl ScenarioEffect for AsymmetricFriction {
    const KIND: EffectKind = EffectKind::AsymmetricFriction;

    fn truth(&self) -> Truth {
        let parameters = [("forward", self.forward_nm), ("backward", self.backward_nm)];
        Truth::at_joint(Self::KIND, &self.joint, &parameters)
    }

    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        let joint = joint_of(robot, &self.joint)?;
        within("forward_nm", self.forward_nm, 0.0, MOST_DRY)?;
        within("backward_nm", self.backward_nm, 0.0, MOST_DRY)?;
        Ok(Box::new(Injected { joint, forward: self.forward_nm, backward: self.backward_nm }))
    }

    /// The two levels differ from their mean by 10 to 40 per cent, either way.
    fn draw(at: &Surroundings<'_>, share: f64, random: &mut ChaCha8Rng) -> Self {
        let mean = share * at.torque_rms;
        let side = if random.random_bool(0.5) { 1.0 } else { -1.0 };
        let shift = side * random.random_range(0.1..0.4) * mean;
        let [forward_nm, backward_nm] =
            [mean + shift, mean - shift].map(|level| level.min(MOST_DRY));
        Self { joint: at.joint_name(), forward_nm, backward_nm }
    }
}

struct Injected {
    joint: usize,
    forward: f64,
    backward: f64,
}

impl Inject for Injected {
    fn on_build(&mut self, plant: &mut Plant) {
        if let Some(link) = plant.robot.link_mut(self.joint) {
            link.actuator.coulomb_forward += self.forward;
            link.actuator.coulomb_backward += self.backward;
        }
    }
}
