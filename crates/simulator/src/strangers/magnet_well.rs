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
use crate::strangers::scenario_stranger::{ScenarioStranger, span, stiffest};
use crate::strangers::truth::StrangerTruth;

/// A place that attracts the link, as two magnets that pass each other do.
///
/// ```text
/// U = -peak width sqrt(e) exp(-x² / (2 width²)),  x = q - centre
/// torque = -dU/dq = -peak sqrt(e) (x / width) exp(-x² / (2 width²))
/// ```
///
/// The torque is largest, `peak`, at `width` from the centre. No energy is lost.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct MagnetWell {
    /// The joint.
    pub joint: String,
    /// Position that attracts (rad; m for a prismatic joint), -100 to 100.
    pub centre_rad: f64,
    /// Distance from it at which the torque is largest (rad; m), 0.0001 to 100.
    pub width_rad: f64,
    /// Largest torque (N m; N), 0 to 1000.
    pub peak_nm: f64,
}

impl MagnetWell {
    fn bump(&self) -> Bump<'_> {
        let (centre, width) = (self.centre_rad, self.width_rad);
        Bump { joint: &self.joint, centre, width, peak: self.peak_nm }
    }
}

impl ScenarioStranger for MagnetWell {
    const KIND: StrangerKind = StrangerKind::MagnetWell;

    fn truth(&self) -> StrangerTruth {
        self.bump().truth(Self::KIND)
    }

    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        let joint = self.bump().check(robot)?;
        Ok(Box::new(Injected { joint, well: self.clone() }))
    }

    /// A well of a tenth to a quarter of the range: over positions that are evenly spread,
    /// `rms(torque) = peak sqrt(e sqrt(pi)/2 width/range)`.
    fn draw(at: &Surroundings<'_>, share: f64, random: &mut ChaCha8Rng) -> Self {
        let part = random.random_range(0.1..0.25);
        let width = (part * span(at)).clamp(1e-4, 100.0);
        let peak = share * at.torque_rms / (2.41 * part).sqrt();
        Self {
            joint: at.joint_name(),
            centre_rad: at.range.0 + random.random_range(0.35..0.65) * span(at),
            width_rad: width,
            peak_nm: peak.min(0.6 * width * stiffest(at)).min(1000.0),
        }
    }
}

struct Injected {
    joint: usize,
    well: MagnetWell,
}

impl Inject for Injected {
    fn on_substep(&mut self, moment: &Moment<'_>, efforts: &mut Efforts) {
        let x = (moment.q[self.joint] - self.well.centre_rad) / self.well.width_rad;
        efforts.link[self.joint] -= self.well.peak_nm * x * (0.5 * (1.0 - x * x)).exp();
    }

    /// The slope at the centre.
    fn springs(&self) -> Vec<(usize, f64)> {
        vec![(self.joint, self.well.peak_nm * 0.5_f64.exp() / self.well.width_rad)]
    }
}
