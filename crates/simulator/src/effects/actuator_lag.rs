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

/// Torque that follows its command as through a first-order filter.
///
/// ```text
/// time_constant d(tau)/dt + tau = command
/// ```
///
/// Solved exactly for a command that is linear from step to step, so that any time constant does,
/// zero too. Before the start, the first command was held.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct ActuatorLag {
    /// The joint.
    pub joint: String,
    /// Time in which the torque covers 63 % of a step (ms), 0 to 1000.
    pub time_constant_ms: f64,
}

impl ScenarioEffect for ActuatorLag {
    const KIND: EffectKind = EffectKind::ActuatorLag;

    fn truth(&self) -> Truth {
        let time_constant_s = 1e-3 * self.time_constant_ms;
        Truth::at_joint(Self::KIND, &self.joint, &[("time_constant", time_constant_s)])
    }

    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        let joint = joint_of(robot, &self.joint)?;
        within("time_constant_ms", self.time_constant_ms, 0.0, 1000.0)?;
        Ok(acting(joint, 1e-3 * self.time_constant_ms))
    }

    /// The torque is late by `time_constant d(tau)/dt`.
    fn draw(at: &Surroundings<'_>, share: f64, _: &mut ChaCha8Rng) -> Self {
        let time_constant_ms = 1e3 * share * at.torque_rms / at.torque_rate_rms;
        Self { joint: at.joint_name(), time_constant_ms: time_constant_ms.min(1000.0) }
    }
}

/// The lag of a joint, ready to act.
pub(super) fn acting(joint: usize, time_constant_s: f64) -> Box<dyn Inject> {
    Box::new(Injected { joint, time_constant_s, last: None })
}

struct Injected {
    joint: usize,
    time_constant_s: f64,
    /// Command and torque of the last step (N m or N).
    last: Option<(f64, f64)>,
}

impl Inject for Injected {
    fn on_start(&mut self, _: &[f64]) {
        self.last = None;
    }

    /// With `u` the command, linear over the step, and `x = dt / time_constant`:
    ///
    /// ```text
    /// tau(k+1) = e tau(k) + (m - e) u(k) + (1 - m) u(k+1),   e = exp(-x),  m = (1 - e) / x
    /// ```
    fn on_command(&mut self, moment: &Moment<'_>, tau: &mut [f64]) {
        let tau = &mut tau[self.joint];
        let command = *tau;
        if let Some((last_command, last_torque)) = self.last
            && self.time_constant_s > 0.0
        {
            let x = moment.step_s / self.time_constant_s;
            let (kept, mean) = ((-x).exp(), -(-x).exp_m1() / x);
            *tau = kept * last_torque + (mean - kept) * last_command + (1.0 - mean) * command;
        }
        self.last = Some((command, *tau));
    }
}
