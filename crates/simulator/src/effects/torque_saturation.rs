use std::f64::consts::SQRT_2;

use catalogue::EffectKind;
use rand_chacha::ChaCha8Rng;
use robot::Robot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::effects::mistake::{Mistake, joint_of, within};
use crate::effects::scenario_effect::ScenarioEffect;
use crate::effects::surroundings::Surroundings;
use crate::effects::truth::Truth;
use crate::mechanics::inject::{Inject, Moment};

/// A drive that gives no more than its limit, whatever it is asked for.
///
/// ```text
/// tau = clamp(command, -limit, limit)
/// ```
///
/// The limit is in the unit of the command: where the drive has a gain or an offset, of effort.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TorqueSaturation {
    /// The joint.
    pub joint: String,
    /// Largest torque in both directions (N m; N for a prismatic joint), 0.000001 to 10000.
    pub limit_nm: f64,
}

impl ScenarioEffect for TorqueSaturation {
    const KIND: EffectKind = EffectKind::TorqueSaturation;

    fn truth(&self) -> Truth {
        Truth::at_joint(Self::KIND, &self.joint, &[("limit", self.limit_nm)])
    }

    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        let joint = joint_of(robot, &self.joint)?;
        within("limit_nm", self.limit_nm, 1e-6, 1e4)?;
        Ok(Box::new(Injected { joint, limit: self.limit_nm }))
    }

    /// What a limit of `sqrt(2) rms (1 - x)` cuts off the peaks of a sine has a root mean square
    /// of `rms sqrt(0.96 x^(5/2))`, to lowest order in `x`.
    fn draw(at: &Surroundings<'_>, share: f64, _: &mut ChaCha8Rng) -> Self {
        let cut = (share * share / 0.96).powf(0.4).min(0.99);
        let limit = SQRT_2 * at.torque_rms * (1.0 - cut);
        Self { joint: at.joint_name(), limit_nm: limit.clamp(1e-6, 1e4) }
    }
}

struct Injected {
    joint: usize,
    limit: f64,
}

impl Inject for Injected {
    fn on_command(&mut self, _: &Moment<'_>, tau: &mut [f64]) {
        tau[self.joint] = tau[self.joint].clamp(-self.limit, self.limit);
    }
}
