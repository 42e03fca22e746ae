use catalogue::EffectKind;
use nalgebra::{Rotation3, Vector3};
use robot::{Actuator, Robot};

use crate::abilities::IsRestricted;
use crate::column::EffectColumn;
use crate::effect::{Effect, INVERSE_DYNAMICS};
use crate::motion::frame::Frame;
use crate::motion::rigid_bodies::tilt_axes;
use crate::motion::run_motion::RunMotion;
use crate::motion::scale::Scale;
use crate::place::AtBase;
use crate::priors::Priors;
use crate::quantity::EffectQuantity;
use crate::traits::{Imitable, Law, Linearity, Location, Traits, Weights};

/// `G(q) (g - g_nominal)`: two weights, the tilt of gravity about two horizontal axes (rad).
///
/// The columns are those of a small tilt, `g - g_nominal = tilt x g_nominal`.
pub(crate) struct GravityDirection;

impl Effect for GravityDirection {
    type At = AtBase;

    fn kind(&self) -> EffectKind {
        EffectKind::GravityDirection
    }

    fn traits(&self) -> Traits {
        Traits::new(
            Linearity::Tangent,
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

    fn places(&self, _: &Robot) -> Vec<AtBase> {
        vec![AtBase]
    }

    fn columns(&self, _: AtBase, motion: &RunMotion) -> Vec<EffectColumn> {
        let column = |axis: usize| {
            let part = |(joint, tilt): (usize, &[Vec<f64>; 2])| {
                motion.load_part(joint, tilt[axis].iter().copied())
            };
            motion.tilt().iter().enumerate().map(part).collect()
        };
        vec![column(0), column(1)]
    }

    fn prior(&self, _: AtBase, _: &Robot, _: &Scale, priors: &Priors) -> Vec<f64> {
        vec![priors.tilt_sd_rad; 2]
    }

    fn bounds(&self, _: AtBase, _: &Robot, priors: &Priors) -> Vec<(f64, f64)> {
        vec![(-priors.tilt_limit_rad, priors.tilt_limit_rad); 2]
    }

    fn extend(&self, _: AtBase, robot: &mut Robot, weights: &[f64], _: &Frame, _: &Priors) {
        let [first, second] = weights else { return };
        let gravity = robot.gravity_in_base();
        let axes = tilt_axes(gravity);
        let tilt = axes[0] * *first + axes[1] * *second;
        *robot = robot.clone().with_gravity(Rotation3::new(tilt) * gravity);
    }

    fn quantities(&self, _: AtBase, nominal: &Robot, extended: &Robot) -> Vec<EffectQuantity> {
        let axes = tilt_axes(nominal.gravity_in_base());
        let tilt = tilt_between(nominal.gravity_in_base(), extended.gravity_in_base());
        let parameters = self.kind().entry().parameters;
        let quantity = |(axis, p): (&Vector3<f64>, &catalogue::Parameter)| EffectQuantity {
            name: p.name,
            value: axis.dot(&tilt),
            nominal: 0.0,
            unit: p.unit,
        };
        axes.iter().zip(parameters).map(quantity).collect()
    }

    fn restriction(&self) -> Option<&dyn IsRestricted<AtBase>> {
        Some(self)
    }
}

impl IsRestricted<AtBase> for GravityDirection {
    /// A tilt at the limit of the linear columns is rejected.
    fn admissible(&self, _: AtBase, _: &Robot, weights: &[f64], priors: &Priors) -> bool {
        weights.iter().all(|tilt| tilt.abs() < (1.0 - 1e-9) * priors.tilt_limit_rad)
    }
}

/// The smallest rotation vector that turns `from` into the direction of `to` (rad).
fn tilt_between(from: Vector3<f64>, to: Vector3<f64>) -> Vector3<f64> {
    Rotation3::rotation_between(&from, &to).map_or_else(Vector3::zeros, |r| r.scaled_axis())
}
