use std::f64::consts::PI;

use nalgebra::{Matrix3, Vector3};
use rand_chacha::ChaCha8Rng;
use robot::{Inertia, Robot};
use simulator::effects::{EffectSpec, Payload};

use crate::dice::{between, direction, log_uniform_between, round_to_digits};

/// Mass of a tool over that of all links: a Panda's hand .04, a UR10's gripper .03 to .08.
const SHARE_OF_ARM: [f64; 2] = [0.02, 0.08];

/// Mean density of a gripper with its motor (kg/m3).
const DENSITY: f64 = 1500.0;

/// A tool at the end of an arm: a ball that touches the end of the last link.
///
/// ```text
/// r = (3 m / (4 pi rho))^(1/3),   I = 2/5 m r^2 1,   c = (2 |c_last| + r) u,   u the direction of c_last
/// ```
///
/// with `c_last` the centre of mass of the last link, halfway to its end.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SampledTool {
    /// The link that carries it.
    pub link: String,
    /// Its body in the frame of that link.
    pub body: Inertia,
}

impl SampledTool {
    /// A tool for an arm; `None` for an arm without a link.
    pub fn draw(robot: &Robot, random: &mut ChaCha8Rng) -> Option<Self> {
        let last = robot.links().last()?;
        let whole: f64 = robot.links().iter().map(|link| link.inertia.mass).sum();
        let mass = round_to_digits(whole * log_uniform_between(random, SHARE_OF_ARM), 4);
        let radius = (3.0 * mass / (4.0 * PI * DENSITY)).cbrt();
        let middle = last.inertia.com_in_link;
        let along = middle.try_normalize(1e-6).unwrap_or_else(Vector3::z);
        let aside = direction(random).into_inner() * (0.3 * radius * between(random, [0.0, 1.0]));
        let com = along * (2.0 * middle.norm() + radius) + aside;
        let moment = round_to_digits(0.4 * mass * radius * radius, 5);
        let body = Inertia {
            mass,
            com_in_link: com.map(|c| round_to_digits(c, 6)),
            about_com: Matrix3::identity() * moment,
        };
        Some(Self { link: last.name.clone(), body })
    }

    /// The tool as a payload of the simulator.
    pub fn payload(&self) -> EffectSpec {
        let moment = self.body.about_com[(0, 0)];
        EffectSpec::Payload(Payload {
            link: self.link.clone(),
            mass_kg: self.body.mass,
            com_m: self.body.com_in_link.into(),
            inertia_kg_m2: Some([moment, moment, moment, 0.0, 0.0, 0.0]),
        })
    }
}
