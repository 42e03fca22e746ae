//! Bodies that could be: their hull, mass and inertia, and what a data sheet makes of them.

use nalgebra::{Isometry3, Matrix3, Rotation3, Translation3, Vector3};
use rand_chacha::ChaCha8Rng;
use robot::Inertia;

use crate::arms::make::Make;
use crate::dice::{between, direction, happens, small_rotation};

/// Outline of a body, its long side along z of its own frame.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Hull {
    /// Sides (m).
    Box([f64; 3]),
    /// Diameter and length (m).
    Cylinder([f64; 2]),
}

impl Hull {
    /// Inertia of an even body of mass 1 about its centre (m^2).
    fn inertia(self) -> Matrix3<f64> {
        let diagonal = match self {
            Self::Box([x, y, z]) => Vector3::new(y * y + z * z, x * x + z * z, x * x + y * y),
            Self::Cylinder([d, l]) => {
                let across = 0.75 * d * d + l * l;
                Vector3::new(across, across, 1.5 * d * d)
            }
        };
        Matrix3::from_diagonal(&(diagonal / 12.0))
    }
}

/// A body with its outline.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct SampledBody {
    /// Name of its link.
    pub name: String,
    /// Its inertia in the link's frame.
    pub inertia: Inertia,
    /// Its outline.
    pub hull: Hull,
    /// Pose of the outline in the link's frame.
    pub link_from_hull: Isometry3<f64>,
}

impl SampledBody {
    /// A body of `mass` (kg) that reaches `length` (m) along `along` from its frame's origin: an even hull,
    /// its mass somewhat nearer to the middle, turned a little and off centre.
    pub(crate) fn draw(
        name: String,
        make: &Make,
        mass: f64,
        length: f64,
        along: Vector3<f64>,
        random: &mut ChaCha8Rng,
    ) -> Self {
        let [light, dense] = make.density;
        let widest = (mass / (light * length)).sqrt();
        let width = (length * between(random, [0.25, 0.5])).min(widest);
        let width = width.max((mass / (dense * length)).sqrt());
        let other = width * between(random, [0.85, 1.15]);
        let hull = match happens(random, 0.5) {
            true => Hull::Box([width, other, length]),
            false => Hull::Cylinder([width, length]),
        };
        let upright = Rotation3::rotation_between(&Vector3::z(), &along);
        let upright = upright.unwrap_or_else(Rotation3::identity);
        let com = along * length * between(random, [0.35, 0.6])
            + direction(random).into_inner() * width * between(random, [0.0, 0.15]);
        let turn = (upright * small_rotation(random, 0.3)).into_inner();
        let compact = between(random, [0.7, 1.0]);
        let about_com = mass * compact * (turn * hull.inertia() * turn.transpose());
        let middle = Translation3::from(along * (0.5 * length));
        Self {
            name,
            inertia: Inertia { mass, com_in_link: com, about_com },
            hull,
            link_from_hull: Isometry3::from_parts(middle, upright.into()),
        }
    }

    /// The same body in a link frame that is turned: `new_from_old` takes old coordinates to new ones.
    pub(crate) fn in_turned_frame(self, new_from_old: &Rotation3<f64>) -> Self {
        let pose = Isometry3::from_parts(Translation3::identity(), (*new_from_old).into());
        Self {
            inertia: self.inertia.in_frame(&pose),
            link_from_hull: pose * self.link_from_hull,
            ..self
        }
    }
}

/// How a nominal model is off at one moving body.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct BodyError {
    /// Nominal over true mass.
    pub mass: f64,
    /// Nominal over true inertia about the centre of mass, beyond the mass's share.
    pub spread: f64,
    /// Nominal less true centre of mass, link axes (m).
    pub com: Vector3<f64>,
}

impl BodyError {
    /// Off by at most `level` of what models are off by: 5 % of mass and inertia, some mm.
    pub(crate) fn draw(make: &Make, level: f64, random: &mut ChaCha8Rng) -> Self {
        let five = [-0.0499 * level, 0.0499 * level];
        let shift = level * make.com_error_m * between(random, [0.0, 0.99]);
        Self {
            mass: 1.0 + between(random, five),
            spread: 1.0 + between(random, five),
            com: direction(random).into_inner() * shift,
        }
    }

    /// What the nominal model has for an inertia.
    pub(crate) fn of(&self, inertia: &Inertia) -> Inertia {
        Inertia {
            mass: inertia.mass * self.mass,
            com_in_link: inertia.com_in_link + self.com,
            about_com: inertia.about_com * (self.mass * self.spread),
        }
    }

    /// The same error in a frame that `new_from_old` turns to.
    pub(crate) fn in_turned_frame(&self, new_from_old: &Rotation3<f64>) -> Self {
        Self { com: new_from_old * self.com, ..*self }
    }
}
