use catalogue::EffectKind;
use robot::{Actuator, Robot};

use crate::column::EffectColumn;
use crate::effect::Effect;
use crate::motion::frame::Frame;
use crate::motion::run_motion::RunMotion;
use crate::motion::scale::Scale;
use crate::place::AtBase;
use crate::priors::Priors;
use crate::quantity::{EffectQuantity, actuator_quantity};
use crate::traits::{Imitable, Law, Linearity, Location, Traits, Weights};

/// `kp (goal(t) - goal(t - delay))` at every joint whose effort is computed from goals: one weight, the change of the delay (s).
pub(crate) struct GoalDelay;

impl Effect for GoalDelay {
    type At = AtBase;

    fn kind(&self) -> EffectKind {
        EffectKind::GoalDelay
    }

    fn traits(&self) -> Traits {
        Traits::new(
            Linearity::Tangent,
            Imitable::Yes,
            Law::Exact,
            Location::Elsewhere,
            Weights::Direct,
            &[],
        )
    }

    fn remedy(&self) -> Result<&'static str, &'static str> {
        Err("it is before the position loop: send goals earlier by as much")
    }

    /// Efforts are computed from goals that are as late as described.
    fn omission(&self, _: &Actuator) -> Option<&'static str> {
        None
    }

    fn places(&self, robot: &Robot) -> Vec<AtBase> {
        let has_loop = |link: &robot::Link| link.actuator.position_loop.is_some();
        if robot.links().iter().any(has_loop) { vec![AtBase] } else { Vec::new() }
    }

    fn columns(&self, _: AtBase, motion: &RunMotion) -> Vec<EffectColumn> {
        vec![(0..motion.torque.len()).filter_map(|j| motion.late_goal_part(j)).collect()]
    }

    fn prior(&self, _: AtBase, _: &Robot, _: &Scale, priors: &Priors) -> Vec<f64> {
        vec![priors.goal_delay_sd_s]
    }

    fn bounds(&self, _: AtBase, robot: &Robot, _: &Priors) -> Vec<(f64, f64)> {
        let described = robot.links().iter().map(|link| link.actuator.goal_delay_s);
        vec![(-described.fold(f64::INFINITY, f64::min), f64::INFINITY)]
    }

    fn extend(&self, _: AtBase, robot: &mut Robot, weights: &[f64], _: &Frame, _: &Priors) {
        let [change] = weights else { return };
        for j in 0..robot.joint_count() {
            if let Some(link) = robot.link_mut(j) {
                link.actuator.goal_delay_s += change;
            }
        }
    }

    fn quantities(&self, _: AtBase, nominal: &Robot, extended: &Robot) -> Vec<EffectQuantity> {
        vec![actuator_quantity(self.kind(), 0, 0, [nominal, extended], |a| a.goal_delay_s)]
    }
}
