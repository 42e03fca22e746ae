use catalogue::EffectKind;
use nalgebra::Vector3;
use robot::{Actuator, Inertia, Robot};

use crate::abilities::IsRestricted;
use crate::causes::inertial_parameters::{InertialParameters, mass_and_com, quantities};
use crate::column::EffectColumn;
use crate::effect::{Effect, INVERSE_DYNAMICS};
use crate::motion::frame::Frame;
use crate::motion::run_motion::RunMotion;
use crate::motion::scale::Scale;
use crate::place::InLink;
use crate::priors::Priors;
use crate::quantity::EffectQuantity;
use crate::traits::{Imitable, Law, Linearity, Location, Traits, Weights};

/// `Y_last pi_payload`: ten weights, the inertial parameters of a body held by a last
/// link, about that link's origin.
///
/// The columns are those of the link's own inertial parameters. A payload differs from an error of the link only in
/// that it is a body: its mass is positive and its centre of mass within reach.
pub(crate) struct Payload;

impl Effect for Payload {
    type At = InLink;

    fn kind(&self) -> EffectKind {
        EffectKind::Payload
    }

    fn traits(&self) -> Traits {
        Traits::new(
            Linearity::Exact,
            Imitable::No,
            Law::Exact,
            Location::Elsewhere,
            Weights::Direct,
            &[],
        )
    }

    fn remedy(&self) -> Result<&'static str, &'static str> {
        Ok(INVERSE_DYNAMICS)
    }

    fn omission(&self, _: &Actuator) -> Option<&'static str> {
        None
    }

    /// Every link that carries no other.
    fn places(&self, robot: &Robot) -> Vec<InLink> {
        let carries = |i: usize| robot.links().iter().any(|l| l.parent == Some(i));
        (0..robot.joint_count()).filter(|&i| !carries(i)).map(InLink).collect()
    }

    fn columns(&self, place: InLink, motion: &RunMotion) -> Vec<EffectColumn> {
        InertialParameters.columns(place, motion)
    }

    fn prior(&self, place: InLink, robot: &Robot, scale: &Scale, priors: &Priors) -> Vec<f64> {
        InertialParameters.prior(place, robot, scale, priors)
    }

    /// A payload may be grams or kilograms.
    fn has_any_scale(&self) -> bool {
        true
    }

    /// Those of the link's own parameters. Whether it is a body is asked of all weights together.
    fn bounds(&self, place: InLink, robot: &Robot, priors: &Priors) -> Vec<(f64, f64)> {
        InertialParameters.bounds(place, robot, priors)
    }

    fn extend(
        &self,
        place: InLink,
        robot: &mut Robot,
        weights: &[f64],
        frame: &Frame,
        priors: &Priors,
    ) {
        InertialParameters.extend(place, robot, weights, frame, priors);
    }

    fn quantities(
        &self,
        InLink(link): InLink,
        nominal: &Robot,
        extended: &Robot,
    ) -> Vec<EffectQuantity> {
        let before = nominal.links()[link].inertia.parameters();
        let mut body = extended.links()[link].inertia.parameters();
        body.iter_mut().zip(before).for_each(|(b, a)| *b -= a);
        quantities(self.kind(), [0.0; 4], mass_and_com(&Inertia::from_parameters(&body)))
    }

    fn restriction(&self) -> Option<&dyn IsRestricted<InLink>> {
        Some(self)
    }
}

impl IsRestricted<InLink> for Payload {
    fn admissible(&self, _: InLink, _: &Robot, weights: &[f64], priors: &Priors) -> bool {
        let [mass, x, y, z, ..] = weights else { return false };
        *mass > 0.0 && Vector3::new(*x, *y, *z).norm() <= priors.payload_reach_m * mass
    }
}
