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

/// Largest coefficient, of a bearing whose neighbours carry little.
const MAX_COEFFICIENT: f64 = 10.0;

/// A bearing that tilts under a load across its axis: dry friction that grows with what the
/// neighbouring joints carry.
///
/// ```text
/// friction = -coefficient sqrt(sum of load² over the joints before and behind) sign(qd)
/// ```
///
/// A constraint of the engine, with the loads of the step before.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TiltingBearing {
    /// The joint.
    pub joint: String,
    /// Friction per unit of the neighbours' load (no unit), 0 to 10.
    pub coefficient: f64,
}

impl ScenarioStranger for TiltingBearing {
    const KIND: StrangerKind = StrangerKind::TiltingBearing;

    fn truth(&self) -> StrangerTruth {
        StrangerTruth::at_joint(Self::KIND, &self.joint, &[("coefficient", self.coefficient)])
    }

    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        let joint = joint_of(robot, &self.joint)?;
        within("coefficient", self.coefficient, 0.0, MAX_COEFFICIENT)?;
        let neighbours = neighbours(robot, joint);
        if neighbours.is_empty() {
            let found = format!("{} has no neighbour, a joint with one was expected", self.joint);
            return Err(Mistake { key: "joint", found });
        }
        Ok(Box::new(Injected { joint, neighbours, coefficient: self.coefficient }))
    }

    /// The load of a neighbour is about its torque.
    fn draw(at: &Surroundings<'_>, share: f64, _: &mut ChaCha8Rng) -> Self {
        let loads = neighbours(at.robot, at.joint).into_iter();
        let load = loads
            .filter_map(|j| at.joints.get(j))
            .fold(0.0, |sum: f64, joint| sum.hypot(joint.torque_rms));
        let coefficient = share * at.torque_rms / load.max(1e-9);
        Self { joint: at.joint_name(), coefficient: coefficient.min(MAX_COEFFICIENT) }
    }
}

/// The joints before and behind a joint.
fn neighbours(robot: &Robot, joint: usize) -> Vec<usize> {
    let links = robot.links();
    let before = links.get(joint).and_then(|link| link.parent);
    let behind = links.iter().enumerate().filter(|(_, l)| l.parent == Some(joint));
    before.into_iter().chain(behind.map(|(j, _)| j)).collect()
}

struct Injected {
    joint: usize,
    neighbours: Vec<usize>,
    coefficient: f64,
}

impl Inject for Injected {
    fn on_substep(&mut self, moment: &Moment<'_>, efforts: &mut Efforts) {
        let across = self.neighbours.iter().fold(0.0, |sum: f64, j| sum.hypot(moment.load[*j]));
        efforts.add_dry(self.joint, self.coefficient * across);
    }

    fn needs_load(&self) -> bool {
        true
    }
}
