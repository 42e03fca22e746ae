use catalogue::EffectKind;
use rand_chacha::ChaCha8Rng;
use robot::Robot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::effects::mistake::{Mistake, joint_of, within};
use crate::effects::scenario_effect::ScenarioEffect;
use crate::effects::surroundings::Surroundings;
use crate::effects::truth::Truth;
use crate::mechanics::inject::{Efforts, Inject, Moment};

/// Largest coefficient: a drive that loses as much as it carries does not move by itself.
const MAX_COEFFICIENT: f64 = 0.9;

/// Dry friction that grows with the torque that the transmission carries to the link.
///
/// ```text
/// friction = -coefficient |load| sign(qd)
/// ```
///
/// A constraint of the engine, with the load of the step before.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct LoadDependentFriction {
    /// The joint.
    pub joint: String,
    /// Friction per unit of load (no unit), 0 to 0.9.
    pub coefficient: f64,
}

impl ScenarioEffect for LoadDependentFriction {
    const KIND: EffectKind = EffectKind::LoadDependentFriction;

    fn truth(&self) -> Truth {
        Truth::at_joint(Self::KIND, &self.joint, &[("coefficient", self.coefficient)])
    }

    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        let joint = joint_of(robot, &self.joint)?;
        within("coefficient", self.coefficient, 0.0, MAX_COEFFICIENT)?;
        Ok(acting(joint, self.coefficient))
    }

    /// The load is about the joint's torque, so the coefficient is the share.
    fn draw(at: &Surroundings<'_>, share: f64, _: &mut ChaCha8Rng) -> Self {
        Self { joint: at.joint_name(), coefficient: share.min(MAX_COEFFICIENT) }
    }
}

/// The friction of a joint under load, ready to act.
pub(super) fn acting(joint: usize, coefficient: f64) -> Box<dyn Inject> {
    Box::new(Injected { joint, coefficient })
}

struct Injected {
    joint: usize,
    coefficient: f64,
}

impl Inject for Injected {
    fn on_substep(&mut self, moment: &Moment<'_>, efforts: &mut Efforts) {
        efforts.add_dry(self.joint, self.coefficient * moment.load[self.joint].abs());
    }

    fn needs_load(&self) -> bool {
        true
    }
}
