use rand_chacha::ChaCha8Rng;
use robot::Robot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::effects::mistake::{Mistake, joint_of, within};
use crate::effects::surroundings::Surroundings;
use crate::mechanics::inject::{Inject, Moment};
use crate::strangers::kind::StrangerKind;
use crate::strangers::scenario_stranger::ScenarioStranger;
use crate::strangers::truth::StrangerTruth;

/// A drive to which small commands are none.
///
/// ```text
/// tau = command - clamp(command, -width, width)
/// ```
///
/// The width is in the unit of the command. It acts on the command before saturation, delay and
/// lag.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct DriveDeadZone {
    /// The joint.
    pub joint: String,
    /// Largest command that gives no torque (N m; N for a prismatic joint), 0 to 1000.
    pub width_nm: f64,
}

impl ScenarioStranger for DriveDeadZone {
    const KIND: StrangerKind = StrangerKind::DriveDeadZone;

    fn truth(&self) -> StrangerTruth {
        StrangerTruth::at_joint(Self::KIND, &self.joint, &[("width", self.width_nm)])
    }

    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        let joint = joint_of(robot, &self.joint)?;
        within("width_nm", self.width_nm, 0.0, 1000.0)?;
        Ok(Box::new(Injected { joint, width: self.width_nm }))
    }

    /// A controller asks for `width` more than it needs.
    fn draw(at: &Surroundings<'_>, share: f64, _: &mut ChaCha8Rng) -> Self {
        Self { joint: at.joint_name(), width_nm: (share * at.torque_rms).min(1000.0) }
    }
}

struct Injected {
    joint: usize,
    width: f64,
}

impl Inject for Injected {
    fn on_command(&mut self, _: &Moment<'_>, tau: &mut [f64]) {
        tau[self.joint] -= tau[self.joint].clamp(-self.width, self.width);
    }
}
