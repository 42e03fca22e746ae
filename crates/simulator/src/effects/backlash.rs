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

/// Free play between motor and link.
///
/// ```text
/// no torque while |theta - q| < gap / 2,  theta the position of the motor
/// ```
///
/// The ends of the gap are stops of the engine, from which the link does not bounce; together
/// with a joint elasticity they are the ends of its spring. The motor moves on its own rotor
/// inertia, so it needs one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Backlash {
    /// The joint.
    pub joint: String,
    /// Play from one end to the other (rad; m for a prismatic joint), 0 to 0.5.
    pub gap_rad: f64,
}

/// Largest play that is drawn (rad or m).
const LARGEST: f64 = 0.03;

impl ScenarioEffect for Backlash {
    const KIND: EffectKind = EffectKind::Backlash;

    fn truth(&self) -> Truth {
        Truth::at_joint(Self::KIND, &self.joint, &[("gap", self.gap_rad)])
    }

    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        let joint = joint_of(robot, &self.joint)?;
        within("gap_rad", self.gap_rad, 0.0, 0.5)?;
        Ok(Box::new(Injected { joint, gap: self.gap_rad }))
    }

    /// The link is half a gap from where its motor is, on one side or the other:
    ///
    /// ```text
    /// share torque = gap / 2  d torque / dq
    /// ```
    ///
    /// A drive with more play than 30 mrad (1.7 degrees) is broken, and no longer to be diagnosed.
    fn draw(at: &Surroundings<'_>, share: f64, _: &mut ChaCha8Rng) -> Self {
        let gap = 2.0 * share * at.torque_rms / at.torque_per_position();
        Self { joint: at.joint_name(), gap_rad: gap.min(LARGEST) }
    }
}

struct Injected {
    joint: usize,
    gap: f64,
}

impl Inject for Injected {
    fn on_build(&mut self, plant: &mut Plant) {
        if let Some(transmission) = plant.transmissions.get_mut(self.joint) {
            transmission.gap += self.gap;
        }
    }
}
