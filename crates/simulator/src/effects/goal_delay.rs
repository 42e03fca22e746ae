use catalogue::EffectKind;
use rand_chacha::ChaCha8Rng;
use robot::Robot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::effects::mistake::{Mistake, within};
use crate::effects::scenario_effect::ScenarioEffect;
use crate::effects::surroundings::Surroundings;
use crate::effects::truth::Truth;
use crate::mechanics::inject::Inject;

/// Goals that reach the controllers of all joints later than the log has them.
///
/// ```text
/// tau = kp (goal(t - delay) - q) + kd (rate of the goal(t - delay) - qd),   logged is goal(t)
/// ```
///
/// Servos (`control.servo`) do not know the rate of their goals, and have a delay of their own besides.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GoalDelay {
    /// Time by which goals come late (ms), 0 to 1000.
    pub delay_ms: f64,
}

impl ScenarioEffect for GoalDelay {
    const KIND: EffectKind = EffectKind::GoalDelay;

    fn truth(&self) -> Truth {
        Truth::everywhere(Self::KIND, &[("delay", 1e-3 * self.delay_ms)])
    }

    fn inject(&self, _: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        within("delay_ms", self.delay_ms, 0.0, 1000.0)?;
        Ok(Box::new(Injected { delay_s: 1e-3 * self.delay_ms }))
    }

    /// The part of the torque that follows the goal changes about as fast as the torque.
    fn draw(at: &Surroundings<'_>, share: f64, _: &mut ChaCha8Rng) -> Self {
        Self { delay_ms: (1e3 * share * at.torque_rms / at.torque_rate_rms).min(1000.0) }
    }
}

struct Injected {
    delay_s: f64,
}

impl Inject for Injected {
    fn goal_delay_s(&self) -> f64 {
        self.delay_s
    }
}
