use catalogue::{EffectKind, Parameter};
use robot::{Actuator, Robot};

use crate::abilities::BetweenEncoders;
use crate::bounds::down_to_zero;
use crate::column::{EffectColumn, at_joint};
use crate::effect::Effect;
use crate::motion::frame::Frame;
use crate::motion::run_motion::RunMotion;
use crate::motion::scale::Scale;
use crate::motion::transmission::{Gap, LoadAlong, play};
use crate::place::{AtJoint, every_joint};
use crate::priors::Priors;
use crate::quantity::{EffectQuantity, actuator_quantity};
use crate::traits::{Imitable, Law, Linearity, Location, Traits, Weights};

/// `theta - q = load / stiffness`: one weight a joint, the change of the compliance
/// `1 / stiffness`.
pub(crate) struct JointElasticity;

fn compliance(drive: &Actuator) -> f64 {
    drive.elasticity.map_or(0.0, f64::recip)
}

/// Step of the compliance in the difference of two plays (rad/(N m) or m/N). The play is linear in the compliance
/// until the link has crossed.
const STEP: f64 = 1e-7;

/// Change of `theta - q` at joint `j` per unit of compliance (N·m or N): the load, and the change of the play, since a
/// softer spring releases the link faster. `carried` makes the load of the play from `play_load`.
fn per_compliance(
    motion: &RunMotion,
    j: usize,
    play_load: &[f64],
    carried: for<'a> fn(&'a [f64], &'a [Vec<f64>; 3]) -> LoadAlong<'a>,
) -> Vec<f64> {
    let drive = &motion.drives[j];
    let mut twist = motion.load[j].clone();
    if drive.backlash > 0.0 {
        let gap = Gap::of(drive, drive.backlash);
        let carried = carried(play_load, &motion.slopes(j)[j]);
        let softer = Gap { compliance: gap.compliance + STEP, ..gap };
        let [now, then] = [gap, softer].map(|gap| play(carried, gap, motion.period_s));
        let changes = now.iter().zip(then).map(|(now, then)| (then - now) / STEP);
        twist.iter_mut().zip(changes).for_each(|(twist, change)| *twist += change);
    }
    twist
}

impl Effect for JointElasticity {
    type At = AtJoint;

    fn kind(&self) -> EffectKind {
        EffectKind::JointElasticity
    }

    fn traits(&self) -> Traits {
        Traits::new(
            Linearity::Tangent,
            Imitable::Yes,
            Law::Exact,
            Location::BeforeTheLink,
            Weights::Reciprocal,
            &[],
        )
    }

    fn remedy(&self) -> Result<&'static str, &'static str> {
        Ok("the twist under the load, and what it asks of the rotor")
    }

    fn omission(&self, drive: &Actuator) -> Option<&'static str> {
        drive.elasticity.map(|_| "elasticity_nm_per_rad")
    }

    /// The stiffness: damping acts only at frequencies that the motion does not reach.
    fn parameters(&self) -> &'static [Parameter] {
        let all = self.kind().entry().parameters;
        all.get(..1).unwrap_or(all)
    }

    fn places(&self, robot: &Robot) -> Vec<AtJoint> {
        every_joint(robot)
    }

    fn columns(&self, AtJoint(j): AtJoint, motion: &RunMotion) -> Vec<EffectColumn> {
        let twist = per_compliance(motion, j, motion.rigid_load(j), LoadAlong::at_motor);
        vec![motion.twist_column(j, &twist)]
    }

    fn prior(&self, AtJoint(j): AtJoint, _: &Robot, scale: &Scale, priors: &Priors) -> Vec<f64> {
        let effort = scale.effort.get(j).copied().unwrap_or(0.0);
        vec![if effort > 0.0 { priors.twist_sd / effort } else { 0.0 }]
    }

    fn bounds(&self, AtJoint(j): AtJoint, robot: &Robot, _: &Priors) -> Vec<(f64, f64)> {
        down_to_zero(compliance(&robot.links()[j].actuator))
    }

    fn extend(
        &self,
        AtJoint(j): AtJoint,
        robot: &mut Robot,
        weights: &[f64],
        _: &Frame,
        _: &Priors,
    ) {
        let [change] = weights else { return };
        let Some(link) = robot.link_mut(j) else { return };
        let compliance = compliance(&link.actuator) + change;
        link.actuator.elasticity = (compliance > 0.0).then(|| compliance.recip());
    }

    /// A rigid transmission has an infinite stiffness.
    fn quantities(
        &self,
        AtJoint(j): AtJoint,
        nominal: &Robot,
        extended: &Robot,
    ) -> Vec<EffectQuantity> {
        let stiffness = |a: &Actuator| a.elasticity.unwrap_or(f64::INFINITY);
        vec![actuator_quantity(self.kind(), 0, j, [nominal, extended], stiffness)]
    }

    fn between_encoders(&self) -> Option<&dyn BetweenEncoders> {
        Some(self)
    }
}

impl BetweenEncoders for JointElasticity {
    fn twist(&self, AtJoint(j): AtJoint, motion: &RunMotion) -> Vec<EffectColumn> {
        let ratio = motion.drives[j].transmission_ratio;
        let twist = per_compliance(motion, j, &motion.load[j], LoadAlong::at_link);
        vec![at_joint(j, twist.into_iter().map(|x| x / ratio))]
    }
}
