use catalogue::EffectKind;
use nalgebra::Vector3;
use robot::{Inertia, Robot};

use crate::causes::inertial_parameters::{InertialParameters, mass_and_com, quantities};
use crate::column::Column;
use crate::effect::Explain;
use crate::motion::frame::Frame;
use crate::motion::run_motion::Motion;
use crate::motion::scale::Scale;
use crate::place::Place;
use crate::quantity::Quantity;
use crate::traits::{Law, Linearity, Nature, Seat, Weights};

/// `Y_last pi_payload`: ten weights, the inertial parameters of a body held by a last
/// link, about that link's origin.
///
/// The columns are those of the link's own inertial parameters; a payload differs from a
/// wrong link only in that it must be a body: it weighs something, and within reach.
pub(crate) struct Payload;

/// Farthest centre of mass of a payload from the origin of the link that holds it (m).
const REACH: f64 = 0.5;

impl Explain for Payload {
    fn kind(&self) -> EffectKind {
        EffectKind::Payload
    }

    fn nature(&self) -> Nature {
        Nature::new(Linearity::Exact, Law::Firm, Seat::Elsewhere, Weights::Direct, &[])
    }

    /// Every link that carries no other.
    fn places(&self, robot: &Robot) -> Vec<Place> {
        let carries = |i: usize| robot.links().iter().any(|l| l.parent == Some(i));
        (0..robot.joint_count()).filter(|&i| !carries(i)).map(Place::Link).collect()
    }

    fn columns(&self, place: Place, motion: &Motion) -> Vec<Column> {
        InertialParameters.columns(place, motion)
    }

    fn prior(&self, place: Place, robot: &Robot, scale: &Scale) -> Vec<f64> {
        InertialParameters.prior(place, robot, scale)
    }

    /// As for the link's own parameters: what makes it a body is tested together.
    fn bounds(&self, place: Place, robot: &Robot) -> Vec<(f64, f64)> {
        InertialParameters.bounds(place, robot)
    }

    fn admissible(&self, _: Place, _: &Robot, weights: &[f64]) -> bool {
        let [mass, x, y, z, ..] = weights else { return false };
        *mass > 0.0 && Vector3::new(*x, *y, *z).norm() <= REACH * mass
    }

    fn extend(&self, place: Place, robot: &mut Robot, weights: &[f64], frame: &Frame) {
        InertialParameters.extend(place, robot, weights, frame);
    }

    fn quantities(&self, place: Place, nominal: &Robot, extended: &Robot) -> Vec<Quantity> {
        let Place::Link(link) = place else { return Vec::new() };
        let before = nominal.links()[link].inertia.parameters();
        let mut body = extended.links()[link].inertia.parameters();
        body.iter_mut().zip(before).for_each(|(b, a)| *b -= a);
        quantities(self.kind(), [0.0; 4], mass_and_com(&Inertia::from_parameters(&body)))
    }
}
