use std::f64::consts::{PI, SQRT_2, TAU};

use catalogue::EffectKind;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use robot::{CounterbalanceTerm, Robot};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::effects::mistake::{Mistake, joint_of, within};
use crate::effects::scenario_effect::ScenarioEffect;
use crate::effects::surroundings::Surroundings;
use crate::effects::truth::Truth;
use crate::mechanics::inject::{Efforts, Inject, Moment};

/// A spring or counterweight at the link that carries part of its weight.
///
/// ```text
/// torque on the link = -amplitude sin(q + phase)
/// ```
///
/// What a spring of no free length gives that is held at two points off the axis, and a
/// counterweight whose inertia does not count.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Counterbalance {
    /// The joint, one that turns.
    pub joint: String,
    /// Largest torque (N m), 0 to 1e5.
    pub amplitude_nm: f64,
    /// Phase at position zero (rad), -2 pi to 2 pi.
    #[serde(default)]
    pub phase_rad: f64,
}

impl ScenarioEffect for Counterbalance {
    const KIND: EffectKind = EffectKind::Counterbalance;

    fn truth(&self) -> Truth {
        let parameters = [("amplitude", self.amplitude_nm), ("phase", self.phase_rad)];
        Truth::at_joint(Self::KIND, &self.joint, &parameters)
    }

    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        let joint = joint_of(robot, &self.joint)?;
        if !robot.links()[joint].joint.kind.is_rotation() {
            let found = format!("{} slides, a joint that turns was expected", self.joint);
            return Err(Mistake { key: "joint", found });
        }
        within("amplitude_nm", self.amplitude_nm, 0.0, 1e5)?;
        within("phase_rad", self.phase_rad, -TAU, TAU)?;
        Ok(acting(
            joint,
            CounterbalanceTerm { amplitude: self.amplitude_nm, phase: self.phase_rad },
        ))
    }

    /// A sine whose root mean square over a turn is the share, in any phase.
    fn draw(at: &Surroundings<'_>, share: f64, random: &mut ChaCha8Rng) -> Self {
        Self {
            joint: at.joint_name(),
            amplitude_nm: (SQRT_2 * share * at.torque_rms).min(1e5),
            phase_rad: random.random_range(-PI..PI),
        }
    }
}

/// A counterbalance of a joint, ready to act.
pub(super) fn acting(joint: usize, balance: CounterbalanceTerm) -> Box<dyn Inject> {
    Box::new(Injected { joint, balance })
}

struct Injected {
    joint: usize,
    balance: CounterbalanceTerm,
}

impl Inject for Injected {
    fn on_substep(&mut self, moment: &Moment<'_>, efforts: &mut Efforts) {
        let CounterbalanceTerm { amplitude, phase } = self.balance;
        efforts.link[self.joint] -= amplitude * (moment.q[self.joint] + phase).sin();
    }

    /// Its steepest slope.
    fn springs(&self) -> Vec<(usize, f64)> {
        vec![(self.joint, self.balance.amplitude)]
    }
}
