use rand::RngExt;
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

/// Torque at one joint from the speed of another, as from a hose that is bent by both, or from
/// the motor of one whose back-EMF reaches the drive of the other.
///
/// ```text
/// torque(joint) = -coefficient qd(other)
/// ```
///
/// Nothing acts back on the other joint.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct SpeedCrosstalk {
    /// The joint that the torque acts at.
    pub joint: String,
    /// The joint whose speed it comes from.
    pub other: String,
    /// Torque per unit of speed (N m s/rad; N s/m for two prismatic joints), -1e4 to 1e4.
    pub coefficient_nm_s_per_rad: f64,
}

impl ScenarioStranger for SpeedCrosstalk {
    const KIND: StrangerKind = StrangerKind::SpeedCrosstalk;

    /// The joint is the one that the torque acts at.
    fn truth(&self) -> StrangerTruth {
        let parameters = [("coefficient", self.coefficient_nm_s_per_rad)];
        StrangerTruth::at_joint(Self::KIND, &self.joint, &parameters)
    }

    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        let joint = joint_of(robot, &self.joint)?;
        let other = joint_of(robot, &self.other).map_err(|m| Mistake { key: "other", ..m })?;
        if other == joint {
            let found = format!("{} itself, another joint was expected", self.other);
            return Err(Mistake { key: "other", found });
        }
        let coefficient = self.coefficient_nm_s_per_rad;
        within("coefficient_nm_s_per_rad", coefficient, -1e4, 1e4)?;
        Ok(Box::new(Injected { joint, other, coefficient }))
    }

    /// From one of the joints that move at least half as fast as the fastest other one.
    fn draw(at: &Surroundings<'_>, share: f64, random: &mut ChaCha8Rng) -> Self {
        let speed = |j: usize| at.joints.get(j).map_or(0.0, |joint| joint.speed_rms);
        let others = || (0..at.robot.joint_count()).filter(|j| *j != at.joint);
        let fastest = others().map(speed).fold(0.0, f64::max);
        let quick: Vec<usize> = others().filter(|j| speed(*j) >= 0.5 * fastest).collect();
        let pick = random.random_range(0..quick.len().max(1));
        let other = quick.get(pick).copied().unwrap_or(at.joint);
        let size = (share * at.torque_rms / speed(other).max(1e-6)).min(1e4);
        Self {
            joint: at.joint_name(),
            other: Surroundings { joint: other, ..*at }.joint_name(),
            coefficient_nm_s_per_rad: if random.random() { size } else { -size },
        }
    }
}

struct Injected {
    joint: usize,
    other: usize,
    coefficient: f64,
}

impl Inject for Injected {
    fn on_substep(&mut self, moment: &Moment<'_>, efforts: &mut Efforts) {
        efforts.link[self.joint] -= self.coefficient * moment.qd[self.other];
    }
}
