use catalogue::EffectKind;
use robot::{Actuator, Robot};

use crate::bounds::down_to_zero;
use crate::column::Column;
use crate::effect::Explain;
use crate::motion::frame::Frame;
use crate::motion::run_motion::Motion;
use crate::motion::scale::Scale;
use crate::motion::timing::is_measured;
use crate::place::{Place, joints_where};
use crate::quantity::{Quantity, actuator_quantity};
use crate::traits::{Law, Linearity, Nature, Relation, Seat, Weights};

/// Torque that comes later than its command: one weight a joint, the change of a time (s).
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

impl Explain for LateTorque {
    fn kind(&self) -> EffectKind {
        match self {
            Self::Delay => EffectKind::ActuatorDelay,
            Self::Lag => EffectKind::ActuatorLag,
        }
    }

    fn nature(&self) -> Nature {
        let twin: &[Relation] = match self {
            Self::Delay => &[Relation::TwinOf(EffectKind::ActuatorLag)],
            Self::Lag => &[Relation::TwinOf(EffectKind::ActuatorDelay)],
        };
        Nature::new(Linearity::Doubtful, Law::Firm, Seat::Elsewhere, Weights::Direct, twin)
    }

    /// Joints whose log has a command, or may have: a measured torque has it behind it.
    fn places(&self, robot: &Robot) -> Vec<Place> {
        joints_where(robot, |drive| !is_measured(drive))
    }

    fn columns(&self, place: Place, motion: &Motion) -> Vec<Column> {
        let Place::Joint(j) = place else { return Vec::new() };
        vec![motion.torque_rate(j)]
    }

    fn prior(&self, _: Place, _: &Robot, _: &Scale) -> Vec<f64> {
        vec![0.005]
    }

    fn bounds(&self, place: Place, robot: &Robot) -> Vec<(f64, f64)> {
        let Place::Joint(j) = place else { return Vec::new() };
        down_to_zero(self.time(&robot.links()[j].actuator))
    }

    fn extend(&self, place: Place, robot: &mut Robot, weights: &[f64], _: &Frame) {
        let (Place::Joint(j), [change]) = (place, weights) else { return };
        let Some(link) = robot.link_mut(j) else { return };
        match self {
            Self::Delay => link.actuator.delay_s += change,
            Self::Lag => link.actuator.lag_s += change,
        }
    }

    fn quantities(&self, place: Place, nominal: &Robot, extended: &Robot) -> Vec<Quantity> {
        let Place::Joint(j) = place else { return Vec::new() };
        vec![actuator_quantity(self.kind(), 0, j, [nominal, extended], |a| self.time(a))]
    }
}
