use catalogue::EffectKind;
use rand_chacha::ChaCha8Rng;
use robot::Robot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::effects::mistake::{Mistake, by_kind, joint_of, within};
use crate::effects::scenario_effect::ScenarioEffect;
use crate::effects::surroundings::Surroundings;
use crate::effects::truth::Truth;
use crate::mechanics::inject::Inject;
use crate::mechanics::plant::Plant;

/// Largest inertia of a joint that turns (kg m²).
const MOST_TURNING: f64 = 100.0;

/// Largest inertia of a joint that slides (kg): a rotor of 0.001 kg m² on a screw of lead `l` is `0.001 (2 pi / l)^2`,
/// 395 kg for 10 mm and 1580 kg for 5 mm.
const MOST_SLIDING: f64 = 1e4;

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
    /// What is added, seen at the joint: up to 100 kg m², up to 1e4 kg for a prismatic joint; negative
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
        within("inertia_kg_m2", self.inertia_kg_m2, -nominal, most(robot, joint))?;
        Ok(Box::new(Injected { joint, inertia: self.inertia_kg_m2 }))
    }

    fn draw(at: &Surroundings<'_>, share: f64, _: &mut ChaCha8Rng) -> Self {
        let inertia = share * at.torque_rms / at.acceleration_rms.max(1e-9);
        Self { joint: at.joint_name(), inertia_kg_m2: inertia.min(most(at.robot, at.joint)) }
    }
}

fn most(robot: &Robot, joint: usize) -> f64 {
    by_kind(robot, joint, MOST_TURNING, MOST_SLIDING)
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
