use catalogue::EffectKind;
use robot::Robot;

use crate::explain::{actuator_quantity, down_to_zero};
use crate::timing::{TIME_SD, commanded, torque_rate};
use crate::{Column, Explain, Frame, Motion, Place, Quantity, Scale};

/// `time_constant d(tau)/dt`: one weight a joint, the change of the time constant (s).
pub(crate) struct ActuatorLag;

impl Explain for ActuatorLag {
    fn kind(&self) -> EffectKind {
        EffectKind::ActuatorLag
    }

    /// Joints whose log has a command, or may have: a measured torque has it behind it.
    fn places(&self, robot: &Robot) -> Vec<Place> {
        commanded(robot)
    }

    fn columns(&self, place: Place, motion: &Motion) -> Vec<Column> {
        let Place::Joint(j) = place else { return Vec::new() };
        vec![torque_rate(motion, j)]
    }

    fn prior(&self, _: Place, _: &Robot, _: &Scale) -> Vec<f64> {
        vec![TIME_SD]
    }

    fn bounds(&self, place: Place, robot: &Robot) -> Vec<(f64, f64)> {
        let Place::Joint(j) = place else { return Vec::new() };
        down_to_zero(robot.links()[j].actuator.lag_s)
    }

    fn extend(&self, place: Place, robot: &mut Robot, weights: &[f64], _: &Frame) {
        let (Place::Joint(j), [change]) = (place, weights) else { return };
        if let Some(link) = robot.link_mut(j) {
            link.actuator.lag_s += change;
        }
    }

    fn quantities(&self, place: Place, nominal: &Robot, extended: &Robot) -> Vec<Quantity> {
        let Place::Joint(j) = place else { return Vec::new() };
        vec![actuator_quantity(self.kind(), 0, j, [nominal, extended], |a| a.lag_s)]
    }
}
