use catalogue::{EffectKind, Parameter};
use robot::{Actuator, Robot};

use crate::abilities::BetweenEncoders;
use crate::bounds::down_to_zero;
use crate::column::{EffectColumn, at_joint};
use crate::effect::Effect;
use crate::motion::compliance::{Spring, rate};
use crate::motion::frame::Frame;
use crate::motion::run_motion::RunMotion;
use crate::motion::scale::Scale;
use crate::motion::transmission::{Gap, LoadAlong, play};
use crate::place::{AtJoint, every_joint};
use crate::priors::Priors;
use crate::quantity::{EffectQuantity, actuator_quantity};
use crate::traits::{Imitable, Law, Linearity, Location, Traits, Weights};

/// `theta - q = load / stiffness`: one weight a joint, the change of the compliance
/// `1 / stiffness`. Where the damping of the spring is known, a second weight is the change of damping over stiffness (s),
///
/// ```text
/// s + damping_s sd = compliance load,   s = theta - q
/// ```
///
/// A rigid joint with a trial spring has the twist of that spring as its column: near the resonance of the link the twist
/// is far from the load times the compliance. The extended drive has the trial spring, whose stiffness the resonance
/// tells; the weight tells whether it is there.
pub(crate) struct JointElasticity;

/// Least and largest change of damping over stiffness in one step, over itself.
const DAMPING_STEP: (f64, f64) = (-0.5, 1.0);

fn compliance(drive: &Actuator) -> f64 {
    drive.elasticity.map_or(0.0, f64::recip)
}

fn damping_s(drive: &Actuator) -> Option<f64> {
    Spring::of(drive)?.damping_s
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

    /// The stiffness. Damping tells near the resonance alone; the extended drive has it there.
    fn parameters(&self) -> &'static [Parameter] {
        let all = self.kind().entry().parameters;
        all.get(..1).unwrap_or(all)
    }

    fn places(&self, robot: &Robot) -> Vec<AtJoint> {
        every_joint(robot)
    }

    fn columns(&self, AtJoint(j): AtJoint, motion: &RunMotion) -> Vec<EffectColumn> {
        if let Some(column) = motion.trial_spring_column(j) {
            return vec![column];
        }
        let mut twist = per_compliance(motion, j, motion.rigid_load(j), LoadAlong::at_motor);
        if let Some(first) = twist.first_mut().filter(|_| motion.is_forward(j)) {
            *first = motion.load_at_rest(j);
        }
        let damped = damping_s(&motion.drives[j]).map(|_| {
            let twist: Vec<f64> =
                motion.q[j].iter().zip(&motion.link[0][j]).map(|(theta, q)| theta - q).collect();
            let slowed: Vec<f64> = rate(&twist, motion.period_s).iter().map(|sd| -sd).collect();
            let begin = [0.0].into_iter().take(slowed.len());
            begin.chain(slowed.iter().copied().skip(1)).collect::<Vec<f64>>()
        });
        let twists = [twist].into_iter().chain(damped);
        twists.map(|twist| motion.twist_column(j, &twist)).collect()
    }

    /// A twist under the effort, a damping known to its half.
    fn prior(
        &self,
        AtJoint(j): AtJoint,
        robot: &Robot,
        scale: &Scale,
        priors: &Priors,
    ) -> Vec<f64> {
        let effort = scale.effort.get(j).copied().unwrap_or(0.0);
        let compliance = if effort > 0.0 { priors.twist_sd / effort } else { 0.0 };
        let damping = damping_s(&robot.links()[j].actuator).map(|d| priors.shape_sd_share * d);
        [compliance].into_iter().chain(damping).collect()
    }

    fn bounds(&self, AtJoint(j): AtJoint, robot: &Robot, _: &Priors) -> Vec<(f64, f64)> {
        let drive = &robot.links()[j].actuator;
        let (least, most) = DAMPING_STEP;
        let damping = damping_s(drive).map(|d| (least * d, most * d));
        down_to_zero(compliance(drive)).into_iter().chain(damping).collect()
    }

    fn extend(
        &self,
        AtJoint(j): AtJoint,
        robot: &mut Robot,
        weights: &[f64],
        frame: &Frame,
        _: &Priors,
    ) {
        let [change, slower @ ..] = weights else { return };
        let Some(link) = robot.link_mut(j) else { return };
        let drive = &mut link.actuator;
        let trial = frame.trial_springs[j].filter(|_| drive.elasticity.is_none() && *change > 0.0);
        if let Some(spring) = trial {
            spring.set(drive);
            return;
        }
        let (compliance, damping_s) = (compliance(drive) + change, damping_s(drive));
        drive.elasticity = (compliance > 0.0).then(|| compliance.recip());
        let damping_s = damping_s.map(|d| d + slower.first().unwrap_or(&0.0));
        drive.elasticity_damping = drive.elasticity.zip(damping_s).map(|(k, d)| k * d);
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
        let sizes = 1 + usize::from(damping_s(&motion.drives[j]).is_some());
        let none = vec![0.0; twist.len()];
        let twists = [twist, none].into_iter().take(sizes);
        twists.map(|twist| at_joint(j, twist.into_iter().map(|x| x / ratio))).collect()
    }
}
