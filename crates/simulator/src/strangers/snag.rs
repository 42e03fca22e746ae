use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use robot::Robot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::effects::mistake::Mistake;
use crate::effects::surroundings::Surroundings;
use crate::mechanics::inject::{Efforts, Inject, Moment};
use crate::strangers::bump::Bump;
use crate::strangers::kind::StrangerKind;
use crate::strangers::scenario_stranger::{ScenarioStranger, span};
use crate::strangers::truth::StrangerTruth;

/// A place where the joint rubs: a narrow bump of dry friction.
///
/// ```text
/// friction = -peak exp(-x² / (2 width²)) sign(qd),  x = q - centre
/// ```
///
/// A constraint of the engine at the motor, whose level follows the position. A pass takes
/// `peak width sqrt(2 pi)` of energy.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Snag {
    /// The joint.
    pub joint: String,
    /// Where it rubs most (rad; m for a prismatic joint), -100 to 100.
    pub centre_rad: f64,
    /// Distance over which it falls to 61 % (rad; m), 0.0001 to 100.
    pub width_rad: f64,
    /// Level at the centre (N m; N), 0 to 1000.
    pub peak_nm: f64,
}

impl Snag {
    fn bump(&self) -> Bump<'_> {
        let (centre, width) = (self.centre_rad, self.width_rad);
        Bump { joint: &self.joint, centre, width, peak: self.peak_nm }
    }
}

impl ScenarioStranger for Snag {
    const KIND: StrangerKind = StrangerKind::Snag;

    fn truth(&self) -> StrangerTruth {
        self.bump().truth(Self::KIND)
    }

    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        let joint = self.bump().check(robot)?;
        Ok(Box::new(Injected { joint, snag: self.clone() }))
    }

    /// A bump of a thirtieth to a twelfth of the range: over positions that are evenly spread,
    /// `rms(torque) = peak sqrt(sqrt(pi) width/range)`.
    fn draw(at: &Surroundings<'_>, share: f64, random: &mut ChaCha8Rng) -> Self {
        let part = random.random_range(0.03..0.08);
        Self {
            joint: at.joint_name(),
            centre_rad: at.range.0 + random.random_range(0.35..0.65) * span(at),
            width_rad: (part * span(at)).clamp(1e-4, 100.0),
            peak_nm: (share * at.torque_rms / (1.77 * part).sqrt()).min(1000.0),
        }
    }
}

struct Injected {
    joint: usize,
    snag: Snag,
}

impl Inject for Injected {
    fn on_substep(&mut self, moment: &Moment<'_>, efforts: &mut Efforts) {
        let x = (moment.motor_q[self.joint] - self.snag.centre_rad) / self.snag.width_rad;
        efforts.add_dry(self.joint, self.snag.peak_nm * (-0.5 * x * x).exp());
    }
}
