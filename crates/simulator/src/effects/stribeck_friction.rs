use catalogue::EffectKind;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use robot::{Robot, Stribeck};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::effects::mistake::{Mistake, joint_of, within};
use crate::effects::scenario_effect::ScenarioEffect;
use crate::effects::surroundings::{MOST_DRY, Surroundings};
use crate::effects::truth::Truth;
use crate::mechanics::inject::{Efforts, Inject, Moment};

/// Dry friction that is larger at rest and falls as the motor begins to move.
///
/// ```text
/// friction = -level sign(qd)
/// level = coulomb + (breakaway - coulomb) exp(-(qd / stribeck_velocity)^2)
/// ```
///
/// A constraint of the engine, whose level follows the velocity: a joint that sticks does not
/// creep and comes loose at `breakaway`. Source: Armstrong-Helouvry, Dupont & Canudas de Wit 1994.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct StribeckFriction {
    /// The joint.
    pub joint: String,
    /// Level at higher speed (N m; N for a prismatic joint), 0 to 1000.
    pub coulomb_nm: f64,
    /// Level at rest (N m; N for a prismatic joint), `coulomb_nm` to 1000.
    pub breakaway_nm: f64,
    /// Speed at which 1/e of the excess is left (rad/s; m/s for a prismatic joint), 0.0001 to 10.
    pub stribeck_velocity_rad_per_s: f64,
}

impl ScenarioEffect for StribeckFriction {
    const KIND: EffectKind = EffectKind::StribeckFriction;

    fn truth(&self) -> Truth {
        let parameters = [
            ("coulomb", self.coulomb_nm),
            ("breakaway", self.breakaway_nm),
            ("stribeck_velocity", self.stribeck_velocity_rad_per_s),
        ];
        Truth::at_joint(Self::KIND, &self.joint, &parameters)
    }

    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        let joint = joint_of(robot, &self.joint)?;
        within("coulomb_nm", self.coulomb_nm, 0.0, MOST_DRY)?;
        within("breakaway_nm", self.breakaway_nm, self.coulomb_nm, MOST_DRY)?;
        within("stribeck_velocity_rad_per_s", self.stribeck_velocity_rad_per_s, 1e-4, 10.0)?;
        let excess = self.breakaway_nm - self.coulomb_nm;
        let stribeck = Stribeck { excess, velocity: self.stribeck_velocity_rad_per_s };
        Ok(acting(joint, self.coulomb_nm, stribeck))
    }

    /// Breakaway at 1.2 to 2 times the Coulomb level, gone between 0.01 and 0.1 rad/s.
    fn draw(at: &Surroundings<'_>, share: f64, random: &mut ChaCha8Rng) -> Self {
        let coulomb = at.dry(share);
        Self {
            joint: at.joint_name(),
            coulomb_nm: coulomb,
            breakaway_nm: (coulomb * random.random_range(1.2..2.0)).min(MOST_DRY),
            stribeck_velocity_rad_per_s: random.random_range(0.01..0.1),
        }
    }
}

/// A Coulomb level (N m or N) and what is beyond it near rest, ready to act.
pub(super) fn acting(joint: usize, coulomb: f64, stribeck: Stribeck) -> Box<dyn Inject> {
    Box::new(Injected { joint, coulomb, stribeck })
}

struct Injected {
    joint: usize,
    coulomb: f64,
    stribeck: Stribeck,
}

impl Inject for Injected {
    fn on_substep(&mut self, moment: &Moment<'_>, efforts: &mut Efforts) {
        let Stribeck { excess, velocity } = self.stribeck;
        let speed = moment.motor_qd[self.joint] / velocity;
        efforts.add_dry(self.joint, self.coulomb + excess * (-speed * speed).exp());
    }
}
