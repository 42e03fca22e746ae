use std::f64::consts::{FRAC_PI_2, TAU};

use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use robot::{Reading, Robot};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::effects::mistake::{Mistake, joint_of, within};
use crate::effects::surroundings::Surroundings;
use crate::mechanics::inject::Inject;
use crate::strangers::kind::StrangerKind;
use crate::strangers::scenario_stranger::ScenarioStranger;
use crate::strangers::truth::StrangerTruth;

/// Largest eccentricity that is drawn (rad): a disc of 20 mm that is 2 mm off.
const LARGEST_DRAWN: f64 = 0.1;

/// An encoder whose disc is off its centre, on the axis of the joint.
///
/// ```text
/// q reported = q + eccentricity sin(q + phase)
/// qd reported = qd (1 + eccentricity cos(q + phase))
/// ```
///
/// The controller sees it too, so that the arm errs where it goes. An encoder at the link, where
/// there is a second one, is right.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct EccentricEncoder {
    /// The joint, one that turns.
    pub joint: String,
    /// Largest error: distance of the centres over the radius of the track (rad), 0 to 0.5.
    pub eccentricity_rad: f64,
    /// Phase at position zero (rad), -2 pi to 2 pi.
    #[serde(default)]
    pub phase_rad: f64,
}

impl ScenarioStranger for EccentricEncoder {
    const KIND: StrangerKind = StrangerKind::EccentricEncoder;

    fn truth(&self) -> StrangerTruth {
        let parameters = [("eccentricity", self.eccentricity_rad), ("phase", self.phase_rad)];
        StrangerTruth::at_joint(Self::KIND, &self.joint, &parameters)
    }

    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        let joint = joint_of(robot, &self.joint)?;
        if !robot.links()[joint].joint.kind.is_rotation() {
            let found = format!("{} slides, a joint that turns was expected", self.joint);
            return Err(Mistake { key: "joint", found });
        }
        within("eccentricity_rad", self.eccentricity_rad, 0.0, 0.5)?;
        within("phase_rad", self.phase_rad, -TAU, TAU)?;
        let (eccentricity, phase) = (self.eccentricity_rad, self.phase_rad);
        Ok(Box::new(Injected { joint, eccentricity, phase }))
    }

    /// A position that is off by `x` changes the torque by `x d(tau)/dq`. The error is near its
    /// largest, of either sign, in the middle of the range.
    fn draw(at: &Surroundings<'_>, share: f64, random: &mut ChaCha8Rng) -> Self {
        let eccentricity = share * at.torque_rms / at.torque_per_position().max(1e-9);
        let crest = if random.random() { FRAC_PI_2 } else { -FRAC_PI_2 };
        let middle = 0.5 * (at.range.0 + at.range.1);
        let phase = crest + random.random_range(-0.6..0.6) - middle;
        Self {
            joint: at.joint_name(),
            eccentricity_rad: eccentricity.min(LARGEST_DRAWN),
            phase_rad: phase.rem_euclid(TAU),
        }
    }
}

struct Injected {
    joint: usize,
    eccentricity: f64,
    phase: f64,
}

impl Inject for Injected {
    fn on_reading(&mut self, reading: &mut Reading) {
        let (sin, cos) = (reading.q[self.joint] + self.phase).sin_cos();
        reading.q[self.joint] += self.eccentricity * sin;
        reading.qd[self.joint] *= 1.0 + self.eccentricity * cos;
    }
}
