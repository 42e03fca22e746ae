use catalogue::EffectKind;
use dynamics::PARAMETERS_PER_LINK;
use robot::{Actuator, Inertia, Robot};

use crate::abilities::HasCadError;
use crate::bounds::{down_to_zero, infinite_bounds};
use crate::column::EffectColumn;
use crate::effect::{Effect, INVERSE_DYNAMICS};
use crate::motion::frame::Frame;
use crate::motion::run_motion::RunMotion;
use crate::motion::scale::Scale;
use crate::place::InLink;
use crate::priors::Priors;
use crate::quantity::EffectQuantity;
use crate::traits::{Imitable, Law, Linearity, Location, Relation, Traits, Weights};

/// `Y_link (pi - pi_nominal)`: ten weights a link, the changes of its inertial parameters
/// `[m, m c (3), Ixx, Ixy, Iyy, Ixz, Iyz, Izz]` about the link origin.
pub(crate) struct InertialParameters;

impl Effect for InertialParameters {
    type At = InLink;

    fn kind(&self) -> EffectKind {
        EffectKind::InertialParameters
    }

    fn traits(&self) -> Traits {
        const RELATIONS: &[Relation] = &[
            Relation::OtherNameOf(EffectKind::Payload),
            Relation::PlainerAtTheJoint(EffectKind::RotorInertia),
        ];
        Traits::new(
            Linearity::Exact,
            Imitable::No,
            Law::Exact,
            Location::Elsewhere,
            Weights::Direct,
            RELATIONS,
        )
    }

    fn remedy(&self) -> Result<&'static str, &'static str> {
        Ok(INVERSE_DYNAMICS)
    }

    fn omission(&self, _: &Actuator) -> Option<&'static str> {
        None
    }

    fn places(&self, robot: &Robot) -> Vec<InLink> {
        (0..robot.joint_count()).map(InLink).collect()
    }

    fn columns(&self, InLink(link): InLink, motion: &RunMotion) -> Vec<EffectColumn> {
        let regressor = motion.link_regressor(link);
        let column = |parameter: usize| {
            let carriers = regressor.iter().enumerate().filter(|(_, signals)| !signals.is_empty());
            let part = |(joint, signals): (usize, &Vec<Vec<f64>>)| {
                motion.load_part(joint, signals[parameter].iter().copied())
            };
            carriers.map(part).collect()
        };
        (0..PARAMETERS_PER_LINK).map(column).collect()
    }

    /// Round numbers: the mass is known to itself plus a third of a mean link, the centre of mass to the length of a link.
    fn prior(
        &self,
        InLink(link): InLink,
        robot: &Robot,
        scale: &Scale,
        priors: &Priors,
    ) -> Vec<f64> {
        let mass = robot.links()[link].inertia.mass.max(0.0);
        let (m, l) = (mass + priors.link_mass_sd_share * scale.link_mass, scale.link_length);
        let mut sd = vec![m];
        sd.extend([m * l; 3]);
        sd.extend([m * l * l; 6]);
        sd
    }

    /// The mass stays positive. Whether the whole inertia is physical is checked by the fit that writes it into a
    /// robot.
    fn bounds(&self, InLink(link): InLink, robot: &Robot, _: &Priors) -> Vec<(f64, f64)> {
        let mut bounds = down_to_zero(robot.links()[link].inertia.mass);
        bounds.extend(infinite_bounds(PARAMETERS_PER_LINK - 1));
        bounds
    }

    fn extend(
        &self,
        InLink(index): InLink,
        robot: &mut Robot,
        weights: &[f64],
        _: &Frame,
        _: &Priors,
    ) {
        if let Some(link) = robot.link_mut(index) {
            let mut pi = link.inertia.parameters();
            pi.iter_mut().zip(weights).for_each(|(p, w)| *p += w);
            link.inertia = Inertia::from_parameters(&pi);
        }
    }

    fn quantities(
        &self,
        InLink(link): InLink,
        nominal: &Robot,
        extended: &Robot,
    ) -> Vec<EffectQuantity> {
        let read = |r: &Robot| mass_and_com(&r.links()[link].inertia);
        quantities(self.kind(), read(nominal), read(extended))
    }

    fn cad_error(&self) -> Option<&dyn HasCadError<InLink>> {
        Some(self)
    }
}

impl HasCadError<InLink> for InertialParameters {
    /// Errors of CAD: a tenth of the mass and of the inertia, a centimetre of the centre of mass.
    ///
    /// ```text
    /// sd(m)   = cad_share m
    /// sd(m c) = cad_share m |c| + cad_centre_m m
    /// sd(I)   = cad_share (Ixx + Iyy + Izz) + 2 cad_centre_m m (|c| + cad_centre_m)
    /// ```
    fn cad_error_sd(&self, InLink(link): InLink, robot: &Robot, priors: &Priors) -> Vec<f64> {
        let inertia = &robot.links()[link].inertia;
        let mass = inertia.mass.max(priors.cad_least_mass_kg);
        let reach = inertia.com_in_link.norm();
        let [.., xx, _, yy, _, _, zz] = inertia.parameters();
        let mut sd = vec![priors.cad_share * mass];
        sd.extend([mass * (priors.cad_share * reach + priors.cad_centre_m); 3]);
        let second = priors.cad_share * (xx + yy + zz).max(0.0)
            + 2.0 * priors.cad_centre_m * mass * (reach + priors.cad_centre_m);
        sd.extend([second; 6]);
        sd
    }
}

/// Mass (kg) and centre of mass in the link frame (m).
pub(crate) fn mass_and_com(inertia: &Inertia) -> [f64; 4] {
    let c = inertia.com_in_link;
    [inertia.mass, c.x, c.y, c.z]
}

/// The parameters of `kind` with values before and after.
pub(crate) fn quantities(
    kind: EffectKind,
    nominal: [f64; 4],
    extended: [f64; 4],
) -> Vec<EffectQuantity> {
    let quantity = |(i, p): (usize, &catalogue::Parameter)| EffectQuantity {
        name: p.name,
        value: extended[i],
        nominal: nominal[i],
        unit: p.unit,
    };
    kind.entry().parameters.iter().enumerate().map(quantity).collect()
}
