use std::f64::consts::TAU;

use catalogue::EffectKind;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use robot::{FrictionWave, Robot};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::effects::mistake::{Mistake, joint_of, within};
use crate::effects::scenario_effect::ScenarioEffect;
use crate::effects::surroundings::{MOST_DRY, Surroundings};
use crate::effects::truth::Truth;
use crate::mechanics::inject::{Efforts, Inject, Moment};

/// Dry friction that varies with the position of the motor.
///
/// ```text
/// friction = -level (1 + share cos(periods_per_turn q + phase)) sign(qd)
/// ```
///
/// A constraint of the engine, whose level follows the position.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct PositionDependentFriction {
    /// The joint.
    pub joint: String,
    /// Mean level over the positions (N m; N for a prismatic joint), 0 to 1000.
    pub level_nm: f64,
    /// Amplitude of the variation over the mean (no unit), 0 to 1.
    pub share: f64,
    /// Periods in a turn of the joint (rad of phase per metre for a prismatic joint), 0 to 10000.
    pub periods_per_turn: f64,
    /// Phase at position zero (rad).
    #[serde(default)]
    pub phase_rad: f64,
}

impl ScenarioEffect for PositionDependentFriction {
    const KIND: EffectKind = EffectKind::PositionDependentFriction;

    fn truth(&self) -> Truth {
        let parameters = [
            ("level", self.level_nm),
            ("share", self.share),
            ("periods_per_turn", self.periods_per_turn),
            ("phase", self.phase_rad),
        ];
        Truth::at_joint(Self::KIND, &self.joint, &parameters)
    }

    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        let joint = joint_of(robot, &self.joint)?;
        within("level_nm", self.level_nm, 0.0, MOST_DRY)?;
        within("share", self.share, 0.0, 1.0)?;
        within("periods_per_turn", self.periods_per_turn, 0.0, 10_000.0)?;
        within("phase_rad", self.phase_rad, -TAU, TAU)?;
        let wave = FrictionWave {
            share: self.share,
            periods: self.periods_per_turn,
            phase: self.phase_rad,
        };
        Ok(Box::new(Injected { joint, level: self.level_nm, wave }))
    }

    /// A variation of 10 to 50 per cent with one to ten periods in a turn.
    fn draw(at: &Surroundings<'_>, share: f64, random: &mut ChaCha8Rng) -> Self {
        Self {
            joint: at.joint_name(),
            level_nm: at.dry(share),
            share: random.random_range(0.1..0.5),
            periods_per_turn: f64::from(random.random_range(1..=10_u8)),
            phase_rad: random.random_range(0.0..TAU),
        }
    }
}

/// What makes the dry friction that a joint has so far vary with its position.
pub(super) fn varying(joint: usize, wave: FrictionWave) -> Box<dyn Inject> {
    Box::new(Varying { joint, wave })
}

/// `1 + share cos(periods q + phase)`.
fn over_mean(wave: &FrictionWave, q: f64) -> f64 {
    1.0 + wave.share * (wave.periods * q + wave.phase).cos()
}

struct Injected {
    joint: usize,
    level: f64,
    wave: FrictionWave,
}

impl Inject for Injected {
    fn on_substep(&mut self, moment: &Moment<'_>, efforts: &mut Efforts) {
        let factor = over_mean(&self.wave, moment.motor_q[self.joint]);
        efforts.add_dry(self.joint, self.level * factor);
    }
}

struct Varying {
    joint: usize,
    wave: FrictionWave,
}

impl Inject for Varying {
    fn on_substep(&mut self, moment: &Moment<'_>, efforts: &mut Efforts) {
        let factor = over_mean(&self.wave, moment.motor_q[self.joint]);
        efforts.dry_forward[self.joint] *= factor;
        efforts.dry_backward[self.joint] *= factor;
    }
}
