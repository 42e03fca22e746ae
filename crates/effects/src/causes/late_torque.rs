use catalogue::EffectKind;
use robot::{Actuator, Robot};

use crate::bounds::down_to_zero;
use crate::column::EffectColumn;
use crate::effect::Effect;
use crate::motion::effort_timing::is_measured;
use crate::motion::frame::Frame;
use crate::motion::run_motion::RunMotion;
use crate::motion::scale::Scale;
use crate::place::{AtJoint, joints_where};
use crate::priors::Priors;
use crate::quantity::{EffectQuantity, actuator_quantity};
use crate::traits::{Imitable, Law, Linearity, Location, Relation, Traits, Weights};

/// Torque that follows its command late: one weight a joint, the change of a time (s).
///
/// ```text
/// tau(t + delay) - tau(t)                 delay
/// time_constant d(tau)/dt                 lag
/// ```
///
/// To first order both have the column `d(tau)/dt`.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum LateTorque {
    Delay,
    Lag,
}

impl LateTorque {
    fn time(self, drive: &Actuator) -> f64 {
        match self {
            Self::Delay => drive.delay_s,
            Self::Lag => drive.lag_s,
        }
    }
}

impl Effect for LateTorque {
    type At = AtJoint;

    fn kind(&self) -> EffectKind {
        match self {
            Self::Delay => EffectKind::ActuatorDelay,
            Self::Lag => EffectKind::ActuatorLag,
        }
    }

    fn traits(&self) -> Traits {
        let twin: &[Relation] = match self {
            Self::Delay => &[Relation::TwinOf(EffectKind::ActuatorLag)],
            Self::Lag => &[Relation::TwinOf(EffectKind::ActuatorDelay)],
        };
        Traits::new(
            Linearity::Tangent,
            Imitable::Yes,
            Law::Exact,
            Location::Elsewhere,
            Weights::Direct,
            twin,
        )
    }

    fn remedy(&self) -> Result<&'static str, &'static str> {
        Ok(match self {
            Self::Delay => "asking for the torque of the motion that much ahead",
            Self::Lag => "asking for the rate of the torque as well, times the time constant",
        })
    }

    fn omission(&self, drive: &Actuator) -> Option<&'static str> {
        let key = match self {
            Self::Delay => "actuator_delay_ms",
            Self::Lag => "actuator_lag_ms",
        };
        (self.time(drive) > 0.0 && !is_measured(drive)).then_some(key)
    }

    /// Joints whose log has, or may have, the command. A measured torque contains delay and lag already.
    fn places(&self, robot: &Robot) -> Vec<AtJoint> {
        joints_where(robot, |drive| !is_measured(drive))
    }

    fn columns(&self, AtJoint(j): AtJoint, motion: &RunMotion) -> Vec<EffectColumn> {
        vec![motion.torque_rate(j)]
    }

    fn prior(&self, _: AtJoint, _: &Robot, _: &Scale, priors: &Priors) -> Vec<f64> {
        vec![priors.time_sd_s]
    }

    fn bounds(&self, AtJoint(j): AtJoint, robot: &Robot, _: &Priors) -> Vec<(f64, f64)> {
        down_to_zero(self.time(&robot.links()[j].actuator))
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
        match self {
            Self::Delay => link.actuator.delay_s += change,
            Self::Lag => link.actuator.lag_s += change,
        }
    }

    fn quantities(
        &self,
        AtJoint(j): AtJoint,
        nominal: &Robot,
        extended: &Robot,
    ) -> Vec<EffectQuantity> {
        vec![actuator_quantity(self.kind(), 0, j, [nominal, extended], |a| self.time(a))]
    }
}
