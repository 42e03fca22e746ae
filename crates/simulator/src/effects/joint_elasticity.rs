use std::f64::consts::TAU;

use catalogue::EffectKind;
use rand::RngExt;
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
use crate::mechanics::transmission::damping;

/// A spring with damping between motor and link, such as a cable drive or a harmonic gear.
///
/// ```text
/// torque on the link = stiffness (theta - q) + damping (thetad - qd),  theta the motor's
/// ```
///
/// The motor moves on its own rotor inertia, so it needs one.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct JointElasticity {
    /// The joint.
    pub joint: String,
    /// Torque per unit of twist (N m/rad; N/m for a prismatic joint), 1 to 1e7.
    pub stiffness_nm_per_rad: f64,
    /// Torque per unit of the speed of twist (N m s/rad; N s/m), 0 to 1e5.
    pub damping_nm_s_per_rad: f64,
}

/// Lowest frequency at which a joint rings on the spring that is drawn (Hz).
const SLOWEST_HZ: f64 = 3.0;

impl ScenarioEffect for JointElasticity {
    const KIND: EffectKind = EffectKind::JointElasticity;

    fn truth(&self) -> Truth {
        let parameters =
            [("stiffness", self.stiffness_nm_per_rad), ("damping", self.damping_nm_s_per_rad)];
        Truth::at_joint(Self::KIND, &self.joint, &parameters)
    }

    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        let joint = joint_of(robot, &self.joint)?;
        within("stiffness_nm_per_rad", self.stiffness_nm_per_rad, 1.0, 1e7)?;
        within("damping_nm_s_per_rad", self.damping_nm_s_per_rad, 0.0, 1e5)?;
        Ok(Box::new(Injected {
            joint,
            stiffness: self.stiffness_nm_per_rad,
            damping: self.damping_nm_s_per_rad,
        }))
    }

    /// The link lags its motor by the twist `torque / stiffness`:
    ///
    /// ```text
    /// share torque = torque / stiffness  d torque / dq
    /// ```
    ///
    /// with 0.5 to 5 % of critical damping against the rotor. A drive so soft that the joint rings
    /// below 3 Hz is not drawn: arms with springs put in their drives on purpose are about as soft.
    fn draw(at: &Surroundings<'_>, share: f64, random: &mut ChaCha8Rng) -> Self {
        let softest = (TAU * SLOWEST_HZ).powi(2) * at.inertia;
        let stiffness = (at.torque_per_position() / share).max(softest).clamp(1.0, 1e7);
        let rotor = at.robot.links().get(at.joint).map_or(0.0, |l| l.actuator.rotor_inertia);
        let ratio = random.random_range(0.005..0.05);
        Self {
            joint: at.joint_name(),
            stiffness_nm_per_rad: stiffness,
            damping_nm_s_per_rad: damping(ratio, stiffness, rotor),
        }
    }
}

struct Injected {
    joint: usize,
    stiffness: f64,
    damping: f64,
}

impl Inject for Injected {
    /// Springs at one joint are in series: for slow motion their compliances add,
    ///
    /// ```text
    /// 1 / (k + i w d) = 1/k - i w d/k² + ...
    /// ```
    fn on_build(&mut self, plant: &mut Plant) {
        let Some(transmission) = plant.transmissions.get_mut(self.joint) else { return };
        let Some(before) = transmission.stiffness else {
            transmission.stiffness = Some(self.stiffness);
            transmission.damping = self.damping;
            return;
        };
        let stiffness = 1.0 / (1.0 / before + 1.0 / self.stiffness);
        let share = |damping: f64, of: f64| damping * (stiffness / of).powi(2);
        transmission.damping =
            share(transmission.damping, before) + share(self.damping, self.stiffness);
        transmission.stiffness = Some(stiffness);
    }
}
