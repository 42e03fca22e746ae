use std::f64::consts::PI;

use catalogue::EffectKind;
use nalgebra::{Matrix3, Vector3};
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use robot::{Inertia, Robot};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::effects::mistake::{Mistake, link_of, within};
use crate::effects::scenario_effect::ScenarioEffect;
use crate::effects::surroundings::{Surroundings, direction};
use crate::effects::truth::Truth;
use crate::mechanics::inject::Inject;
use crate::mechanics::plant::Plant;

/// Density of what is hung on an arm to load it (kg/m³): steel.
const DENSITY: f64 = 7850.0;

/// A body fixed to a link.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct Payload {
    /// The link that carries it.
    pub link: String,
    /// Mass (kg), 1e-6 to 1000.
    pub mass_kg: f64,
    /// Centre of mass (m), in the frame of the link, up to 10 along each axis.
    pub com_m: [f64; 3],
    /// Inertia about the centre of mass (kg m²), axes of the link: xx, yy, zz, xy, xz, yz. Left
    /// out, the body is a ball of steel.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inertia_kg_m2: Option<[f64; 6]>,
}

impl ScenarioEffect for Payload {
    const KIND: EffectKind = EffectKind::Payload;

    fn truth(&self) -> Truth {
        Truth::at_link(Self::KIND, &self.link, &mass_and_com(self.mass_kg, self.com_m))
    }

    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        let link = link_of(robot, &self.link)?;
        let about_com = self.inertia_kg_m2.map_or_else(|| ball(self.mass_kg), symmetric);
        let body = body(self.mass_kg, self.com_m, about_com)?;
        Ok(Box::new(Injected { link, body }))
    }

    /// A body 0.05 to 0.15 m from the link's origin, whose weight at that lever is the torque.
    fn draw(at: &Surroundings<'_>, share: f64, random: &mut ChaCha8Rng) -> Self {
        let com = direction(random) * random.random_range(0.05..0.15);
        let mass = share * at.torque_rms / (at.fall() * com.norm());
        Self {
            link: at.tip_name(),
            mass_kg: mass.clamp(1e-6, 1000.0),
            com_m: com.into(),
            inertia_kg_m2: None,
        }
    }
}

struct Injected {
    link: usize,
    body: Inertia,
}

impl Inject for Injected {
    fn on_build(&mut self, plant: &mut Plant) {
        plant.attach(self.link, &self.body);
    }
}

/// The parameters of a body, under the catalogue's names.
pub(super) fn mass_and_com(mass: f64, com: [f64; 3]) -> [(&'static str, f64); 4] {
    [("mass", mass), ("com_x", com[0]), ("com_y", com[1]), ("com_z", com[2])]
}

/// A body as a scenario states it; refuses one that no distribution of mass has.
pub(super) fn body(mass: f64, com: [f64; 3], about_com: Matrix3<f64>) -> Result<Inertia, Mistake> {
    within("mass_kg", mass, 1e-6, 1000.0)?;
    for c in com {
        within("com_m", c, -10.0, 10.0)?;
    }
    for i in about_com.iter() {
        within("inertia_kg_m2", *i, -1e5, 1e5)?;
    }
    let body = Inertia { mass, com_in_link: Vector3::from(com), about_com };
    match body.defects().first() {
        Some(defect) => Err(Mistake { key: "inertia_kg_m2", found: defect.to_string() }),
        None => Ok(body),
    }
}

/// The matrix with the entries xx, yy, zz, xy, xz, yz.
pub(super) fn symmetric([xx, yy, zz, xy, xz, yz]: [f64; 6]) -> Matrix3<f64> {
    Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz)
}

/// Inertia of a homogeneous ball of steel about its centre (kg m²): `2/5 m r²`.
fn ball(mass: f64) -> Matrix3<f64> {
    let radius = (3.0 * mass / (4.0 * PI * DENSITY)).cbrt();
    Matrix3::identity() * (0.4 * mass * radius * radius)
}
