use catalogue::EffectKind;
use robot::{Actuator, Robot};

use crate::abilities::CanBeUnsound;
use crate::bounds::{down_to_zero, infinite_bounds};
use crate::column::EffectColumn;
use crate::effect::Effect;
use crate::motion::cable_loop::Loop;
use crate::motion::frame::Frame;
use crate::motion::run_motion::RunMotion;
use crate::motion::scale::Scale;
use crate::place::{AtJoint, every_joint};
use crate::priors::Priors;
use crate::quantity::{EffectQuantity, actuator_quantity};
use crate::traits::{Imitable, Law, Linearity, Location, Traits, Weights};

/// `stiffness x + cubic x³ + h`, `x = q - rest`, with the loop `h`.
///
/// A robot without a spring has one weight a joint: the stiffness, about the middle of the recorded range. A robot
/// with a spring has four: the changes of stiffness, cubic term, loop and rest position:
///
/// ```text
/// x + dh / d stiffness,   x³,   dh / d hysteresis,   -(stiffness + 3 cubic x²)
/// ```
///
/// For a spring without a cubic term, the rest position is equivalent to a torque offset. Where the rest position may
/// lie within the range of motion, the logs cannot decide between the two, and the spring is named.
pub(crate) struct CableSpring;

/// Displacement over which a loop builds up in a robot without one, as a share of the range of motion.
const WAY: f64 = 1.0 / 16.0;

/// Least and largest change of a loop in one step, over the loop.
const LOOP_STEP: (f64, f64) = (-0.5, 1.0);

impl Effect for CableSpring {
    type At = AtJoint;

    fn kind(&self) -> EffectKind {
        EffectKind::CableSpring
    }

    fn traits(&self) -> Traits {
        Traits::new(
            Linearity::Tangent,
            Imitable::No,
            Law::Approximate,
            Location::Elsewhere,
            Weights::Direct,
            &[],
        )
    }

    fn remedy(&self) -> Result<&'static str, &'static str> {
        Ok("the torque of its spring at the position of the link, and the level of its loop")
    }

    fn omission(&self, _: &Actuator) -> Option<&'static str> {
        None
    }

    fn places(&self, robot: &Robot) -> Vec<AtJoint> {
        every_joint(robot)
    }

    fn columns(&self, AtJoint(j): AtJoint, motion: &RunMotion) -> Vec<EffectColumn> {
        let (q, drive) = (&motion.link[0][j], &motion.drives[j]);
        if !has_spring(drive) {
            return vec![vec![motion.load_part(j, q.iter().map(|q| q - motion.centre[j]))]];
        }
        let hysteresis = if drive.spring_hysteresis > 0.0 {
            drive.spring_hysteresis
        } else {
            let (low, high) = q
                .iter()
                .fold((f64::INFINITY, f64::NEG_INFINITY), |(l, h), q| (l.min(*q), h.max(*q)));
            drive.spring_stiffness * WAY * (high - low)
        };
        let dragged = Loop::new(drive.spring_stiffness, hysteresis, q);
        let x = || q.iter().map(|q| q - drive.spring_rest);
        // A robot without a loop gets a column of an assumed shape, a robot with one the change of its size.
        let (stiffness, hysteresis): (Vec<f64>, Vec<f64>) = if drive.spring_hysteresis > 0.0 {
            let stiffness = x().zip(dragged.per_stiffness).map(|(x, h)| x + h);
            (stiffness.collect(), dragged.per_hysteresis)
        } else {
            (x().collect(), dragged.torque.iter().map(|h| h / hysteresis).collect())
        };
        let slope = |x: f64| drive.spring_stiffness + 3.0 * drive.spring_cubic * x * x;
        [
            motion.load_part(j, stiffness.into_iter()),
            motion.load_part(j, x().map(|x| x.powi(3))),
            motion.load_part(j, hysteresis.into_iter()),
            motion.load_part(j, x().map(|x| -slope(x))),
        ]
        .into_iter()
        .map(|part| vec![part])
        .collect()
    }

    /// A torque as large as the effort itself over the range of the joint.
    fn prior(
        &self,
        AtJoint(j): AtJoint,
        robot: &Robot,
        scale: &Scale,
        priors: &Priors,
    ) -> Vec<f64> {
        let (stiffness, range) = (scale.effort_per(j, &scale.range), scale.range[j]);
        let drive = &robot.links()[j].actuator;
        if !has_spring(drive) {
            return vec![stiffness];
        }
        vec![stiffness, stiffness / (range * range), scale.effort[j], priors.spring_rest_sd * range]
    }

    fn bounds(&self, AtJoint(j): AtJoint, robot: &Robot, _: &Priors) -> Vec<(f64, f64)> {
        let drive = &robot.links()[j].actuator;
        if !has_spring(drive) {
            return down_to_zero(drive.spring_stiffness);
        }
        let dragged = drive.spring_hysteresis;
        let (least, most) = LOOP_STEP;
        let dragged =
            if dragged > 0.0 { (least * dragged, most * dragged) } else { (0.0, f64::INFINITY) };
        [
            down_to_zero(drive.spring_stiffness),
            down_to_zero(drive.spring_cubic.max(0.0)),
            vec![dragged],
            infinite_bounds(1),
        ]
        .concat()
    }

    fn extend(
        &self,
        AtJoint(j): AtJoint,
        robot: &mut Robot,
        weights: &[f64],
        frame: &Frame,
        _: &Priors,
    ) {
        let Some(link) = robot.link_mut(j) else { return };
        let a = &mut link.actuator;
        match weights {
            [change] => {
                // k0 (q - r0) + dk (q - c) = k (q - r) with k = k0 + dk, k r = k0 r0 + dk c.
                let stiffness = a.spring_stiffness + change;
                if stiffness > 0.0 {
                    a.spring_rest =
                        (a.spring_stiffness * a.spring_rest + change * frame.centre[j]) / stiffness;
                }
                a.spring_stiffness = stiffness;
            }
            [stiffness, cubic, hysteresis, rest] => {
                a.spring_stiffness += stiffness;
                a.spring_cubic += cubic;
                a.spring_hysteresis += hysteresis;
                a.spring_rest += rest;
            }
            _ => {}
        }
    }

    fn quantities(
        &self,
        AtJoint(j): AtJoint,
        nominal: &Robot,
        extended: &Robot,
    ) -> Vec<EffectQuantity> {
        let robots = [nominal, extended];
        let read: [fn(&Actuator) -> f64; 4] = [
            |a| a.spring_stiffness,
            |a| a.spring_rest,
            |a| a.spring_cubic,
            |a| a.spring_hysteresis,
        ];
        let quantity = |(i, read)| actuator_quantity(self.kind(), i, j, robots, read);
        read.into_iter().enumerate().map(quantity).collect()
    }

    fn can_be_unsound(&self) -> Option<&dyn CanBeUnsound<AtJoint>> {
        Some(self)
    }
}

impl CanBeUnsound<AtJoint> for CableSpring {
    /// Whether a loop has a spring.
    fn is_sound(&self, AtJoint(j): AtJoint, extended: &Robot, _: &Priors) -> bool {
        let drive = &extended.links()[j].actuator;
        drive.spring_hysteresis == 0.0 || has_spring(drive)
    }
}

/// Whether the robot has a spring.
fn has_spring(drive: &Actuator) -> bool {
    drive.spring_stiffness > 0.0
}
