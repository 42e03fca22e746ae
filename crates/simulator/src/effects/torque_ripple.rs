use std::f64::consts::{PI, SQRT_2};

use catalogue::EffectKind;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use robot::{Ripple, Robot};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::effects::mistake::{Mistake, joint_of, within};
use crate::effects::scenario_effect::ScenarioEffect;
use crate::effects::surroundings::Surroundings;
use crate::effects::truth::Truth;
use crate::mechanics::inject::{Efforts, Inject, Moment};

/// Cogging and ripple of a motor: torque that its angle alone decides.
///
/// ```text
/// ripple = amplitude sin(periods_per_turn theta + phase)
/// ```
///
/// `theta` is the motor's position seen at the joint. As friction does, the ripple stands on the
/// side of `M qdd + C qd + g`: the motor has to give it on top, so that it pulls at the motor
/// with the opposite sign, behind the place where current is measured.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct TorqueRipple {
    /// The joint.
    pub joint: String,
    /// Amplitude (N m; N for a prismatic joint), 0 to 1000.
    pub amplitude_nm: f64,
    /// Periods in one turn of the joint (for a prismatic joint phase per way, rad/m), 0.1 to
    /// 100000.
    pub periods_per_turn: f64,
    /// Phase at position zero (rad), -10 to 10.
    #[serde(default)]
    pub phase_rad: f64,
}

impl ScenarioEffect for TorqueRipple {
    const KIND: EffectKind = EffectKind::TorqueRipple;

    fn truth(&self) -> Truth {
        let parameters = [
            ("amplitude", self.amplitude_nm),
            ("periods_per_turn", self.periods_per_turn),
            ("phase", self.phase_rad),
        ];
        Truth::at_joint(Self::KIND, &self.joint, &parameters)
    }

    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        let joint = joint_of(robot, &self.joint)?;
        within("amplitude_nm", self.amplitude_nm, 0.0, 1000.0)?;
        within("periods_per_turn", self.periods_per_turn, 0.1, 1e5)?;
        within("phase_rad", self.phase_rad, -10.0, 10.0)?;
        let [amplitude, periods] = [self.amplitude_nm, self.periods_per_turn];
        Ok(acting(joint, Ripple { amplitude, periods, phase: self.phase_rad }))
    }

    /// As many periods in a turn as the WAM's motors have electrical ones, 39 to 252.
    fn draw(at: &Surroundings<'_>, share: f64, random: &mut ChaCha8Rng) -> Self {
        Self {
            joint: at.joint_name(),
            amplitude_nm: (SQRT_2 * share * at.torque_rms).min(1000.0),
            periods_per_turn: f64::from(random.random_range(39..=252)),
            phase_rad: random.random_range(-PI..PI),
        }
    }
}

/// The ripple of a joint, ready to act.
pub(super) fn acting(joint: usize, ripple: Ripple) -> Box<dyn Inject> {
    Box::new(Injected { joint, ripple })
}

struct Injected {
    joint: usize,
    ripple: Ripple,
}

impl Inject for Injected {
    fn on_substep(&mut self, moment: &Moment<'_>, efforts: &mut Efforts) {
        let Ripple { amplitude, periods, phase } = self.ripple;
        let angle = periods * moment.motor_q[self.joint] + phase;
        efforts.motor[self.joint] -= amplitude * angle.sin();
    }

    /// The steepest slope of the ripple.
    fn springs(&self) -> Vec<(usize, f64)> {
        vec![(self.joint, self.ripple.amplitude * self.ripple.periods)]
    }
}
