use catalogue::EffectKind;
use robot::{Actuator, Robot, Warming};

use crate::abilities::{CanBeUnsound, HasShape, ShapedDrive};
use crate::bounds::down_to_zero;
use crate::column::{EffectColumn, at_joint};
use crate::effect::Effect;
use crate::motion::drive::warmth;
use crate::motion::frame::Frame;
use crate::motion::run_motion::RunMotion;
use crate::motion::scale::Scale;
use crate::place::{AtJoint, joints_where};
use crate::priors::Priors;
use crate::quantity::{EffectQuantity, actuator_quantity};
use crate::traits::{Imitable, Law, Linearity, Location, Traits, Weights};

/// Friction that falls while the drive warms up. Two weights a joint: the changes of the viscous and of the Coulomb
/// friction that a warm drive has lost. Where these are above zero, a third weight is the change of the time constant.
///
/// ```text
/// -warmth qd,   -warmth sign(qd),   warmth = 1 - exp(-t / time_constant)
/// (viscous_lost qd + coulomb_lost sign(qd)) t / time_constant^2 exp(-t / time_constant)
/// ```
///
/// `t` is the time since the drive was cold.
pub(crate) struct FrictionTemperatureDrift;

/// Trial time constants (s), a factor of 2 apart: motors and gears of arms warm up within minutes to an
/// hour (Bittencourt & Gunnarsson 2012).
const TRIALS_S: [f64; 4] = [300.0, 600.0, 1200.0, 2400.0];

/// Least and largest change of a time constant in one step, over the time constant.
const TIME_STEP: (f64, f64) = (-0.5, 1.0);

/// Speed for which the lost share of friction is reported (rad/s or m/s).
const SHARE_SPEED: f64 = 1.0;

fn of(drive: &Actuator) -> Option<Warming> {
    drive.warming
}

fn has_size(warming: Warming) -> bool {
    warming.viscous_lost > 0.0 || warming.coulomb_lost > 0.0
}

/// Share of the cold drive's friction at speed one that a warm drive has lost.
fn share(drive: &Actuator) -> f64 {
    let level = 0.5 * (drive.coulomb_forward + drive.coulomb_backward);
    let cold = level + SHARE_SPEED * drive.viscous;
    let lost = of(drive).map_or(0.0, |w| w.coulomb_lost + SHARE_SPEED * w.viscous_lost);
    if cold > 0.0 { lost / cold } else { 0.0 }
}

impl Effect for FrictionTemperatureDrift {
    type At = AtJoint;

    fn kind(&self) -> EffectKind {
        EffectKind::FrictionTemperatureDrift
    }

    fn traits(&self) -> Traits {
        Traits::new(
            Linearity::Tangent,
            Imitable::Yes,
            Law::Approximate,
            Location::Elsewhere,
            Weights::Direct,
            &[],
        )
    }

    fn remedy(&self) -> Result<&'static str, &'static str> {
        Err("the temperature of a drive is not known")
    }

    fn omission(&self, _: &Actuator) -> Option<&'static str> {
        None
    }

    /// Joints whose friction falls, or that have the trial shape of it.
    fn places(&self, robot: &Robot) -> Vec<AtJoint> {
        joints_where(robot, |drive| of(drive).is_some())
    }

    fn columns(&self, AtJoint(j): AtJoint, motion: &RunMotion) -> Vec<EffectColumn> {
        let Some(known) = of(&motion.drives[j]) else { return Vec::new() };
        let Warming { viscous_lost, coulomb_lost, time_constant_s } = known;
        let (gain, qd, direction) = (motion.gain[j], &motion.qd[j], &motion.direction[j]);
        let time = || motion.since_cold_s().map(|t| t / time_constant_s);
        let falls =
            |of: &[f64]| at_joint(j, time().zip(of).map(|(time, of)| -gain * warmth(time) * of));
        let mut columns = vec![falls(qd), falls(direction)];
        if has_size(known) {
            let friction =
                qd.iter().zip(direction).map(|(v, s)| viscous_lost * v + coulomb_lost * s);
            let by_time = |(time, friction): (f64, f64)| {
                gain * friction * time * (-time).exp() / time_constant_s
            };
            columns.push(at_joint(j, time().zip(friction).map(by_time)));
        }
        columns
    }

    /// Losses as large as the effort itself, a time constant known to its half.
    fn prior(
        &self,
        AtJoint(j): AtJoint,
        robot: &Robot,
        scale: &Scale,
        priors: &Priors,
    ) -> Vec<f64> {
        let Some(known) = of(&robot.links()[j].actuator) else { return Vec::new() };
        let time = has_size(known).then_some(priors.shape_sd_share * known.time_constant_s);
        [scale.effort_per(j, &scale.speed), scale.effort[j]].into_iter().chain(time).collect()
    }

    fn bounds(&self, AtJoint(j): AtJoint, robot: &Robot, _: &Priors) -> Vec<(f64, f64)> {
        let Some(known) = of(&robot.links()[j].actuator) else { return Vec::new() };
        let (least, most) = TIME_STEP;
        let time = has_size(known)
            .then_some((least * known.time_constant_s, most * known.time_constant_s));
        let lost = [known.viscous_lost, known.coulomb_lost].map(down_to_zero);
        lost.concat().into_iter().chain(time).collect()
    }

    /// The loss is at most the friction of the cold drive.
    fn extend(
        &self,
        AtJoint(j): AtJoint,
        robot: &mut Robot,
        weights: &[f64],
        _: &Frame,
        _: &Priors,
    ) {
        let [viscous, coulomb, time @ ..] = weights else { return };
        let Some(link) = robot.link_mut(j) else { return };
        let drive = &mut link.actuator;
        let Some(known) = of(drive) else { return };
        let lost = |known: f64, change: &f64| (known + change).max(0.0);
        drive.warming = Some(drive.limit_warming(Warming {
            viscous_lost: lost(known.viscous_lost, viscous),
            coulomb_lost: lost(known.coulomb_lost, coulomb),
            time_constant_s: known.time_constant_s + time.first().unwrap_or(&0.0),
        }));
    }

    fn quantities(
        &self,
        AtJoint(j): AtJoint,
        nominal: &Robot,
        extended: &Robot,
    ) -> Vec<EffectQuantity> {
        let robots = [nominal, extended];
        let quantity = |index, pick: fn(Warming) -> f64, none: f64| {
            actuator_quantity(self.kind(), index, j, robots, |a| of(a).map_or(none, pick))
        };
        vec![
            quantity(0, |w| w.viscous_lost, 0.0),
            quantity(1, |w| w.coulomb_lost, 0.0),
            quantity(2, |w| w.time_constant_s, f64::INFINITY),
            actuator_quantity(self.kind(), 3, j, robots, share),
        ]
    }

    fn shape(&self) -> Option<&dyn HasShape> {
        Some(self)
    }

    fn can_be_unsound(&self) -> Option<&dyn CanBeUnsound<AtJoint>> {
        Some(self)
    }
}

impl HasShape for FrictionTemperatureDrift {
    fn shapes(
        &self,
        AtJoint(joint): AtJoint,
        robot: &Robot,
        scale: &Scale,
        priors: &Priors,
    ) -> Vec<f64> {
        if of(&robot.links()[joint].actuator).is_some() {
            return Vec::new();
        }
        TRIALS_S
            .into_iter()
            .filter(|trial| *trial <= priors.warming_longest_sessions * scale.session_s)
            .collect()
    }

    fn set_shape(&self, _: usize, shaped: ShapedDrive<'_>, shape: f64) {
        let (viscous_lost, coulomb_lost) = (0.0, 0.0);
        shaped.drive.warming = Some(Warming { viscous_lost, coulomb_lost, time_constant_s: shape });
    }

    fn drop_unused_shape(&self, drive: &mut Actuator, before: &Actuator) {
        if drive.warming.is_some_and(|w| w.viscous_lost <= 0.0 && w.coulomb_lost <= 0.0) {
            drive.warming = before.warming;
        }
        drive.warming = drive.warming.map(|warming| drive.limit_warming(warming));
    }
}

impl CanBeUnsound<AtJoint> for FrictionTemperatureDrift {
    /// Whether a warm drive has lost friction, and not all of it.
    fn is_sound(&self, AtJoint(j): AtJoint, extended: &Robot, _: &Priors) -> bool {
        let share = share(&extended.links()[j].actuator);
        share > 0.0 && share < 1.0
    }
}
