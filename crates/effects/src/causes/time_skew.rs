use catalogue::EffectKind;
use robot::{Actuator, Robot};

use crate::bounds::infinite_bounds;
use crate::column::EffectColumn;
use crate::effect::Effect;
use crate::motion::frame::Frame;
use crate::motion::run_motion::RunMotion;
use crate::motion::scale::Scale;
use crate::place::AtBase;
use crate::priors::Priors;
use crate::quantity::{EffectQuantity, actuator_quantity};
use crate::traits::{Imitable, Law, Linearity, Location, Traits, Weights};

/// `tau(t - skew) - tau(t)` at every joint: one weight, the change of the skew (s).
pub(crate) struct TimeSkew;

impl Effect for TimeSkew {
    type At = AtBase;

    fn kind(&self) -> EffectKind {
        EffectKind::TimeSkew
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
        Err("it is in the log, not in the arm")
    }

    fn omission(&self, drive: &Actuator) -> Option<&'static str> {
        (drive.effort_skew_s.abs() > 0.0).then_some("effort_skew_ms")
    }

    fn places(&self, _: &Robot) -> Vec<AtBase> {
        vec![AtBase]
    }

    fn columns(&self, _: AtBase, motion: &RunMotion) -> Vec<EffectColumn> {
        let joints = 0..motion.torque.len();
        let mut column: EffectColumn = joints.flat_map(|j| motion.torque_rate(j)).collect();
        column.iter_mut().flat_map(|part| &mut part.values).for_each(|v| *v = -*v);
        vec![column]
    }

    fn prior(&self, _: AtBase, _: &Robot, _: &Scale, priors: &Priors) -> Vec<f64> {
        vec![priors.time_sd_s]
    }

    fn bounds(&self, _: AtBase, _: &Robot, _: &Priors) -> Vec<(f64, f64)> {
        infinite_bounds(1)
    }

    fn extend(&self, _: AtBase, robot: &mut Robot, weights: &[f64], _: &Frame, _: &Priors) {
        let [change] = weights else { return };
        for j in 0..robot.joint_count() {
            if let Some(link) = robot.link_mut(j) {
                link.actuator.effort_skew_s += change;
            }
        }
    }

    fn quantities(&self, _: AtBase, nominal: &Robot, extended: &Robot) -> Vec<EffectQuantity> {
        vec![actuator_quantity(self.kind(), 0, 0, [nominal, extended], |a| a.effort_skew_s)]
    }
}
