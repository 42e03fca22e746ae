use std::f64::consts::TAU;

use catalogue::EffectKind;
use nalgebra::Vector3;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use robot::Robot;
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::effects::mistake::{Mistake, within};
use crate::effects::scenario_effect::ScenarioEffect;
use crate::effects::surroundings::Surroundings;
use crate::effects::truth::Truth;
use crate::mechanics::inject::Inject;
use crate::mechanics::plant::Plant;

/// A base that does not stand as the description says: seen from it, gravity is turned.
///
/// ```text
/// g = exp((tilt_1 e_1 + tilt_2 e_2) x) g_nominal
/// ```
///
/// with two horizontal axes of the base: `e_1` is the part of x that is orthogonal to
/// `g_nominal`, and `e_2` follows from up and `e_1` by the right hand: x and y for an upright
/// arm. (With x within 26 degrees of the vertical, y takes its part.) The base itself has tilted
/// by the opposite rotation.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct GravityDirection {
    /// Turn of gravity about the first horizontal axis, x for an upright arm (rad), -1 to 1.
    pub tilt_x_rad: f64,
    /// Turn of gravity about the second horizontal axis, y for an upright arm (rad), -1 to 1.
    pub tilt_y_rad: f64,
}

impl ScenarioEffect for GravityDirection {
    const KIND: EffectKind = EffectKind::GravityDirection;

    fn truth(&self) -> Truth {
        let parameters = [("tilt_1", self.tilt_x_rad), ("tilt_2", self.tilt_y_rad)];
        Truth::everywhere(Self::KIND, &parameters)
    }

    fn inject(&self, _: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        within("tilt_x_rad", self.tilt_x_rad, -1.0, 1.0)?;
        within("tilt_y_rad", self.tilt_y_rad, -1.0, 1.0)?;
        Ok(Box::new(Injected { tilt: [self.tilt_x_rad, self.tilt_y_rad] }))
    }

    /// A tilt changes the torque of gravity by about its own angle.
    fn draw(_: &Surroundings<'_>, share: f64, random: &mut ChaCha8Rng) -> Self {
        let heading: f64 = random.random_range(0.0..TAU);
        let tilt = share.min(1.0);
        Self { tilt_x_rad: tilt * heading.cos(), tilt_y_rad: tilt * heading.sin() }
    }
}

struct Injected {
    tilt: [f64; 2],
}

impl Inject for Injected {
    fn on_build(&mut self, plant: &mut Plant) {
        let [first, second] = horizontal(plant.robot.gravity_in_base());
        plant.tilt(first * self.tilt[0] + second * self.tilt[1]);
    }
}

/// The two horizontal axes, unit vectors; zero without gravity, which has no direction.
pub(crate) fn horizontal(gravity: Vector3<f64>) -> [Vector3<f64>; 2] {
    let Some(up) = (-gravity).try_normalize(0.0) else { return [Vector3::zeros(); 2] };
    let start = if up.x.abs() < 0.9 { Vector3::x() } else { Vector3::y() };
    let first = (start - up * up.dot(&start)).normalize();
    [first, up.cross(&first)]
}
