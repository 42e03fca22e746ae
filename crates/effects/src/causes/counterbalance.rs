use catalogue::EffectKind;
use nalgebra::Complex;
use robot::{Actuator, CounterbalanceTerm, Robot};

use crate::bounds::infinite_bounds;
use crate::column::EffectColumn;
use crate::effect::Effect;
use crate::motion::frame::Frame;
use crate::motion::run_motion::RunMotion;
use crate::motion::scale::Scale;
use crate::place::{AtJoint, joints_where};
use crate::priors::Priors;
use crate::quantity::{EffectQuantity, actuator_quantity};
use crate::traits::{Imitable, Law, Linearity, Location, Traits, Weights};

/// `amplitude sin(q + phase)`: two weights a joint that turns, the changes of the sine and of the cosine
/// of the link's position (N·m).
///
/// ```text
/// z = amplitude exp(i phase),   amplitude sin(q + phase) = Re(z) sin(q) + Im(z) cos(q)
/// ```
pub(crate) struct Counterbalance;

/// Amplitude and phase of a drive in one number (N·m).
fn balance(drive: &Actuator) -> Complex<f64> {
    drive.counterbalance.map_or(Complex::ZERO, |c| Complex::from_polar(c.amplitude, c.phase))
}

impl Effect for Counterbalance {
    type At = AtJoint;

    fn kind(&self) -> EffectKind {
        EffectKind::Counterbalance
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
        Ok("its torque at the position of the link")
    }

    fn omission(&self, _: &Actuator) -> Option<&'static str> {
        None
    }

    /// Joints whose description has one. An undescribed one is found as a spring, an offset or the inertia of a link;
    /// two more columns at every joint would make these ambiguous.
    fn places(&self, robot: &Robot) -> Vec<AtJoint> {
        joints_where(robot, |drive| drive.counterbalance.is_some())
    }

    fn columns(&self, AtJoint(j): AtJoint, motion: &RunMotion) -> Vec<EffectColumn> {
        let wave = |of: fn(f64) -> f64| {
            let q = motion.link[0][j].iter();
            vec![motion.load_part(j, q.map(|q| of(*q)))]
        };
        vec![wave(f64::sin), wave(f64::cos)]
    }

    /// A torque as large as the effort itself.
    fn prior(&self, AtJoint(j): AtJoint, _: &Robot, scale: &Scale, _: &Priors) -> Vec<f64> {
        vec![scale.effort[j]; 2]
    }

    fn bounds(&self, _: AtJoint, _: &Robot, _: &Priors) -> Vec<(f64, f64)> {
        infinite_bounds(2)
    }

    fn extend(
        &self,
        AtJoint(j): AtJoint,
        robot: &mut Robot,
        weights: &[f64],
        _: &Frame,
        _: &Priors,
    ) {
        let [sine, cosine] = weights else { return };
        let Some(link) = robot.link_mut(j) else { return };
        let changed = balance(&link.actuator) + Complex::new(*sine, *cosine);
        let (amplitude, phase) = changed.to_polar();
        link.actuator.counterbalance = Some(CounterbalanceTerm { amplitude, phase });
    }

    fn quantities(
        &self,
        AtJoint(j): AtJoint,
        nominal: &Robot,
        extended: &Robot,
    ) -> Vec<EffectQuantity> {
        let robots = [nominal, extended];
        vec![
            actuator_quantity(self.kind(), 0, j, robots, |a| balance(a).norm()),
            actuator_quantity(self.kind(), 1, j, robots, |a| balance(a).arg()),
        ]
    }
}
