use catalogue::EffectKind;
use nalgebra::Vector3;
use rand::RngExt;
use rand_chacha::ChaCha8Rng;
use robot::{Inertia, Robot};
use schemars::JsonSchema;
use serde::{Deserialize, Serialize};

use crate::effects::mistake::{Mistake, link_of};
use crate::effects::payload::{body, mass_and_com, symmetric};
use crate::effects::scenario_effect::ScenarioEffect;
use crate::effects::surroundings::{Surroundings, direction};
use crate::effects::truth::Truth;
use crate::mechanics::inject::Inject;
use crate::mechanics::plant::Plant;

/// The mass, centre of mass and inertia that a link truly has.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, JsonSchema)]
#[serde(deny_unknown_fields)]
pub struct InertialParameters {
    /// The link.
    pub link: String,
    /// Mass (kg), 1e-6 to 1000.
    pub mass_kg: f64,
    /// Centre of mass (m), in the frame of the link, up to 10 along each axis.
    pub com_m: [f64; 3],
    /// Inertia about the centre of mass (kg m²), axes of the link: xx, yy, zz, xy, xz, yz. Left
    /// out, it is that of the description times the ratio of the masses.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub inertia_kg_m2: Option<[f64; 6]>,
}

/// Least mass that is drawn, of the nominal mass: a link that weighs nothing is no mistake that
/// anyone makes.
const LEAST_DRAWN: f64 = 0.2;

/// Largest mass that is drawn, as a share of the described one: twice as heavy is another link.
const MOST_DRAWN: f64 = 2.0;

/// Longest way by which a drawn centre of mass is off (m).
const FARTHEST_DRAWN_M: f64 = 0.15;

impl ScenarioEffect for InertialParameters {
    const KIND: EffectKind = EffectKind::InertialParameters;

    fn truth(&self) -> Truth {
        Truth::at_link(Self::KIND, &self.link, &mass_and_com(self.mass_kg, self.com_m))
    }

    fn inject(&self, robot: &Robot) -> Result<Box<dyn Inject>, Mistake> {
        let link = link_of(robot, &self.link)?;
        let nominal = &robot.links()[link].inertia;
        let about_com = match self.inertia_kg_m2 {
            Some(entries) => symmetric(entries),
            None if nominal.mass > 0.0 => nominal.about_com * (self.mass_kg / nominal.mass),
            None => {
                let found = format!(
                    "missing, and link {} is massless: six numbers were expected",
                    self.link
                );
                return Err(Mistake { key: "inertia_kg_m2", found });
            }
        };
        let truth = body(self.mass_kg, self.com_m, about_com)?.parameters();
        let nominal = nominal.parameters();
        Ok(Box::new(Injected { link, change: std::array::from_fn(|i| truth[i] - nominal[i]) }))
    }

    /// A mass that is off by the share, and a centre of mass that is off by as much as makes
    /// its weight the torque.
    fn draw(at: &Surroundings<'_>, share: f64, random: &mut ChaCha8Rng) -> Self {
        let nominal =
            at.robot.links().get(at.joint).map_or_else(Inertia::zero, |l| l.inertia.clone());
        let factor = if random.random_bool(0.5) { 1.0 + share } else { 1.0 / (1.0 + share) };
        let mass = nominal.mass * factor.clamp(LEAST_DRAWN, MOST_DRAWN);
        let shift = (share * at.torque_rms / (at.fall() * mass)).min(FARTHEST_DRAWN_M);
        let com: Vector3<f64> = nominal.com_in_link + direction(random) * shift;
        Self { link: at.link_name(), mass_kg: mass, com_m: com.into(), inertia_kg_m2: None }
    }
}

struct Injected {
    link: usize,
    /// Change of the ten parameters about the link's origin, which add where others change too.
    change: [f64; 10],
}

impl Inject for Injected {
    fn on_build(&mut self, plant: &mut Plant) {
        if let Some(link) = plant.robot.link_mut(self.link) {
            let mut pi = link.inertia.parameters();
            pi.iter_mut().zip(self.change).for_each(|(p, c)| *p += c);
            link.inertia = Inertia::from_parameters(&pi);
        }
    }
}
