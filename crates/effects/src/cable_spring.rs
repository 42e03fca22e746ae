use catalogue::{EffectKind, Parameter};
use robot::{Actuator, Robot};

use crate::explain::{actuator_quantity, down_to_zero, every_joint};
use crate::{Column, Explain, Frame, Motion, Place, Quantity, Scale};

/// `stiffness (q - rest)`: one weight a joint, the change of the stiffness.
///
/// The column is taken about the middle of the recorded range. The rest position is not
/// a weight: moving it adds a constant, which is a torque offset, and a log cannot tell
/// the two apart.
pub(crate) struct CableSpring;

impl Explain for CableSpring {
    fn kind(&self) -> EffectKind {
        EffectKind::CableSpring
    }

    /// Stiffness and rest: the cubic term and the loop are left out.
    fn parameters(&self) -> &'static [Parameter] {
        let all = self.kind().entry().parameters;
        all.get(..2).unwrap_or(all)
    }

    fn places(&self, robot: &Robot) -> Vec<Place> {
        every_joint(robot)
    }

    fn columns(&self, place: Place, motion: &Motion) -> Vec<Column> {
        let Place::Joint(j) = place else { return Vec::new() };
        vec![vec![motion.carried(j, motion.link[0][j].iter().map(|q| q - motion.centre[j]))]]
    }

    /// A torque as large as the effort itself over the range of the joint.
    fn prior(&self, place: Place, _: &Robot, scale: &Scale) -> Vec<f64> {
        let Place::Joint(j) = place else { return Vec::new() };
        vec![scale.effort_per(j, &scale.range)]
    }

    fn bounds(&self, place: Place, robot: &Robot) -> Vec<(f64, f64)> {
        let Place::Joint(j) = place else { return Vec::new() };
        down_to_zero(robot.links()[j].actuator.spring_stiffness)
    }

    fn extend(&self, place: Place, robot: &mut Robot, weights: &[f64], frame: &Frame) {
        let (Place::Joint(j), [change]) = (place, weights) else { return };
        let Some(link) = robot.link_mut(j) else { return };
        let a = &mut link.actuator;
        // k0 (q - r0) + dk (q - c) = k (q - r) with k = k0 + dk, k r = k0 r0 + dk c.
        let stiffness = a.spring_stiffness + change;
        if stiffness > 0.0 {
            a.spring_rest =
                (a.spring_stiffness * a.spring_rest + change * frame.centre[j]) / stiffness;
        }
        a.spring_stiffness = stiffness;
    }

    fn quantities(&self, place: Place, nominal: &Robot, extended: &Robot) -> Vec<Quantity> {
        let Place::Joint(j) = place else { return Vec::new() };
        let robots = [nominal, extended];
        let stiffness = |a: &Actuator| a.spring_stiffness;
        vec![
            actuator_quantity(self.kind(), 0, j, robots, stiffness),
            actuator_quantity(self.kind(), 1, j, robots, |a| a.spring_rest),
        ]
    }
}
