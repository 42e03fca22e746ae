use rand_chacha::ChaCha8Rng;
use robot::Robot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::effects::mistake::{Mistake, joint_of, within};
use crate::effects::surroundings::Surroundings;
use crate::mechanics::inject::{Efforts, Inject, Moment};
use crate::strangers::kind::StrangerKind;
use crate::strangers::scenario_stranger::ScenarioStranger;
use crate::strangers::truth::StrangerTruth;

/// Drag with the square of the speed, as of a link that moves through water, or of much oil.
///
/// ```text
/// torque = -coefficient |qd| qd
/// ```
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SquareDrag {
    /// The joint.
    pub joint: String,
    /// Torque per square of the speed (N m s²/rad²; N s²/m² for a prismatic joint), 0 to 1e4.
    pub coefficient_nm_s2_per_rad2: f64,
}

impl ScenarioStranger for SquareDrag {
    const KIND: StrangerKind = StrangerKind::SquareDrag;

    fn truth(&self) -> StrangerTruth {
        let parameters = [("coefficient", self.coefficient_nm_s2_per_rad2)];
        StrangerTruth::at_joint(Self::KIND, &self.joint, &parameters)
    }

    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        let joint = joint_of(robot, &self.joint)?;
        within("coefficient_nm_s2_per_rad2", self.coefficient_nm_s2_per_rad2, 0.0, 1e4)?;
        Ok(Box::new(Injected { joint, coefficient: self.coefficient_nm_s2_per_rad2 }))
    }

    /// `rms(qd²)` is 1.2 (a sine) to 1.7 (normal) times `rms(qd)²`. Up to a hundred times what the
    /// joint turns, so that an explicit step keeps it a drag.
    fn draw(at: &Surroundings<'_>, share: f64, _: &mut ChaCha8Rng) -> Self {
        let coefficient = share * at.torque_rms / (1.4 * at.speed_rms.powi(2)).max(1e-9);
        Self {
            joint: at.joint_name(),
            coefficient_nm_s2_per_rad2: coefficient.min(100.0 * at.inertia).min(1e4),
        }
    }
}

struct Injected {
    joint: usize,
    coefficient: f64,
}

impl Inject for Injected {
    fn on_substep(&mut self, moment: &Moment<'_>, efforts: &mut Efforts) {
        let qd = moment.qd[self.joint];
        efforts.link[self.joint] -= self.coefficient * qd.abs() * qd;
    }
}
