use catalogue::{EffectKind, Parameter};
use robot::{Actuator, Robot};

use crate::explain::{actuator_quantity, at_joint, every_joint};
use crate::motion::bristles;
use crate::{Column, Explain, Frame, Motion, Place, Quantity, Scale};

/// Dry friction that builds up over a way: one weight a joint. In a robot without, it is the
/// friction (N·m or N) that builds up over a small way instead of at once; in a robot with a way,
/// the change of the way.
///
/// ```text
/// s(way) - sign(qd),   level (s(1.1 way) - s(0.9 way)) / (0.2 way)
/// ```
pub(crate) struct PreslidingFriction;

/// Way for which the column of a robot without one is made (rad or m).
const SMALL: f64 = 0.002;

/// Relative difference of the ways whose motions are compared.
const STEP: f64 = 0.1;

/// Standard deviation of a way before any data (rad or m).
const WAY_SD: f64 = 0.005;

/// Least and largest change of a way in one step, over the way.
const WAY_STEP: (f64, f64) = (-0.5, 1.0);

fn level(drive: &Actuator) -> f64 {
    0.5 * (drive.coulomb_forward + drive.coulomb_backward)
}

impl Explain for PreslidingFriction {
    fn kind(&self) -> EffectKind {
        EffectKind::PreslidingFriction
    }

    /// All but the damping of the bristles.
    fn parameters(&self) -> &'static [Parameter] {
        &self.kind().entry().parameters[..2]
    }

    fn places(&self, robot: &Robot) -> Vec<Place> {
        every_joint(robot)
    }

    fn columns(&self, place: Place, motion: &Motion) -> Vec<Column> {
        let Place::Joint(j) = place else { return Vec::new() };
        let (gain, drive) = (motion.gain[j], &motion.drives[j]);
        let held = |way: f64| bristles(&motion.q[j], way);
        let column = match drive.presliding {
            None => {
                let slower = held(SMALL).into_iter().zip(&motion.direction[j]);
                at_joint(j, slower.map(|(held, s)| gain * (held - s)))
            }
            Some(way) => {
                let (long, short) = (held((1.0 + STEP) * way), held((1.0 - STEP) * way));
                let unit = gain * level(drive) / (2.0 * STEP * way);
                at_joint(j, long.into_iter().zip(short).map(|(l, s)| unit * (l - s)))
            }
        };
        vec![column]
    }

    fn prior(&self, place: Place, robot: &Robot, scale: &Scale) -> Vec<f64> {
        let Place::Joint(j) = place else { return Vec::new() };
        let way = robot.links()[j].actuator.presliding;
        vec![if way.is_some() { WAY_SD } else { scale.effort[j] }]
    }

    fn bounds(&self, place: Place, robot: &Robot) -> Vec<(f64, f64)> {
        let Place::Joint(j) = place else { return Vec::new() };
        let (least, most) = WAY_STEP;
        let way = robot.links()[j].actuator.presliding;
        vec![way.map_or((0.0, f64::INFINITY), |way| (least * way, most * way))]
    }

    /// Whether there is dry friction that builds up.
    fn is_sound(&self, place: Place, extended: &Robot) -> bool {
        let Place::Joint(j) = place else { return false };
        let drive = &extended.links()[j].actuator;
        drive.presliding.is_some() && level(drive) > 0.0
    }

    /// To first order in the way, half the friction over a way is all of it over half the way.
    fn extend(&self, place: Place, robot: &mut Robot, weights: &[f64], _: &Frame) {
        let (Place::Joint(j), [change]) = (place, weights) else { return };
        let Some(link) = robot.link_mut(j) else { return };
        let drive = &mut link.actuator;
        let level = level(drive);
        match &mut drive.presliding {
            Some(way) => *way += change,
            None if level > 0.0 && *change > 0.0 => {
                drive.presliding = Some(SMALL * change / level);
            }
            None => {}
        }
    }

    fn quantities(&self, place: Place, nominal: &Robot, extended: &Robot) -> Vec<Quantity> {
        let Place::Joint(j) = place else { return Vec::new() };
        let robots = [nominal, extended];
        let stiffness = |a: &Actuator| a.presliding.map_or(f64::INFINITY, |way| level(a) / way);
        vec![
            actuator_quantity(self.kind(), 0, j, robots, stiffness),
            actuator_quantity(self.kind(), 1, j, robots, level),
        ]
    }
}
