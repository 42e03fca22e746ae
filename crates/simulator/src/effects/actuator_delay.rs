use catalogue::EffectKind;
use rand_chacha::ChaCha8Rng;
use robot::Robot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::delay_line::DelayLine;
use crate::effects::mistake::{Mistake, joint_of, within};
use crate::effects::scenario_effect::ScenarioEffect;
use crate::effects::surroundings::Surroundings;
use crate::effects::truth::Truth;
use crate::mechanics::inject::{Inject, Moment};

/// Torque that comes a fixed time after its command.
///
/// ```text
/// tau(t) = command(t - delay)
/// ```
///
/// The delay need not be whole steps. Before the start, the first command was held.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ActuatorDelay {
    /// The joint.
    pub joint: String,
    /// Time from command to torque (ms), 0 to 1000.
    pub delay_ms: f64,
}

impl ScenarioEffect for ActuatorDelay {
    const KIND: EffectKind = EffectKind::ActuatorDelay;

    fn truth(&self) -> Truth {
        Truth::at_joint(Self::KIND, &self.joint, &[("delay", 1e-3 * self.delay_ms)])
    }

    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        let joint = joint_of(robot, &self.joint)?;
        within("delay_ms", self.delay_ms, 0.0, 1000.0)?;
        Ok(acting(joint, 1e-3 * self.delay_ms))
    }

    /// The torque is off by about `delay d(tau)/dt`.
    fn draw(at: &Surroundings<'_>, share: f64, _: &mut ChaCha8Rng) -> Self {
        let delay_ms = 1e3 * share * at.torque_rms / at.torque_rate_rms;
        Self { joint: at.joint_name(), delay_ms: delay_ms.min(1000.0) }
    }
}

/// The delay of a joint, ready to act.
pub(super) fn acting(joint: usize, delay_s: f64) -> Box<dyn Inject> {
    Box::new(Injected { joint, command: DelayLine::new(delay_s) })
}

struct Injected {
    joint: usize,
    command: DelayLine,
}

impl Inject for Injected {
    fn on_start(&mut self, _: &[f64]) {
        self.command.clear();
    }

    fn on_command(&mut self, moment: &Moment<'_>, tau: &mut [f64]) {
        tau[self.joint] = self.command.pass(moment.time_s, tau[self.joint]);
    }
}
