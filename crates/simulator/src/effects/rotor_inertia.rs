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

/// Inertia of rotor and gear beyond that of the robot's description.
///
/// ```text
/// torque = inertia qdd
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct RotorInertia {
    /// The joint.
    pub joint: String,
    /// What is added (kg m², seen at the joint; kg for a prismatic joint), up to 100; negative
    /// down to what takes away all that the description says.
    pub inertia_kg_m2: f64,
}

impl ScenarioEffect for RotorInertia {
    const KIND: EffectKind = EffectKind::RotorInertia;

    fn truth(&self) -> Truth {
        Truth::at_joint(Self::KIND, &self.joint, &[("inertia", self.inertia_kg_m2)])
    }

    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        let joint = joint_of(robot, &self.joint)?;
        let nominal = robot.links()[joint].actuator.rotor_inertia;
        within("inertia_kg_m2", self.inertia_kg_m2, -nominal, 100.0)?;
        Ok(Box::new(Injected { joint, inertia: self.inertia_kg_m2 }))
    }

    fn draw(at: &Surroundings<'_>, share: f64, _: &mut ChaCha8Rng) -> Self {
        let inertia = share * at.torque_rms / at.acceleration_rms.max(1e-9);
        Self { joint: at.joint_name(), inertia_kg_m2: inertia.min(100.0) }
    }
}

struct Injected {
    joint: usize,
    inertia: f64,
}

impl Inject for Injected {
    fn on_build(&mut self, plant: &mut Plant) {
        if let Some(link) = plant.robot.link_mut(self.joint) {
            link.actuator.rotor_inertia += self.inertia;
        }
    }
}
