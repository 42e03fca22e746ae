use std::f64::consts::FRAC_PI_2;

use catalogue::EffectKind;
use nalgebra::Complex;
use robot::{Actuator, FrictionWave, Robot};

use crate::abilities::{CanBeUnsound, CanHide, HasShape, ShapedDrive};
use crate::bounds::infinite_bounds;
use crate::column::{EffectColumn, at_joint};
use crate::effect::{EASED_LEVEL, Effect};
use crate::motion::dry_friction::{along_a_log, mean_and_skew};
use crate::motion::frame::Frame;
use crate::motion::run_motion::RunMotion;
use crate::motion::scale::Scale;
use crate::place::{AtJoint, joints_where};
use crate::priors::Priors;
use crate::quantity::{EffectQuantity, actuator_quantity};
use crate::traits::{Imitable, Law, Linearity, Location, Relation, RevealedBy, Traits, Weights};

/// Coulomb friction that varies with the position of the motor. Two weights a joint: the change of the wave in phase
/// and in quadrature (N·m or N). Where the wave is above zero, a third weight is the change of its periods.
///
/// ```text
/// z = level share exp(i phase),  friction = Re(z exp(i periods q)) sign(qd)
/// ```
pub(crate) struct PositionDependentFriction;

/// Change of phase over the range of motion between two trial values.
const APART: f64 = FRAC_PI_2;

/// Mean Coulomb level of both directions (N·m or N).
fn level(drive: &Actuator) -> f64 {
    0.5 * (drive.coulomb_forward + drive.coulomb_backward)
}

/// The wave of a drive, as amplitude (N·m or N) and phase in one number.
fn amplitude(drive: &Actuator) -> Option<(Complex<f64>, FrictionWave)> {
    drive.friction_wave.map(|w| (Complex::from_polar(level(drive) * w.share, w.phase), w))
}

impl Effect for PositionDependentFriction {
    type At = AtJoint;

    fn kind(&self) -> EffectKind {
        EffectKind::PositionDependentFriction
    }

    fn traits(&self) -> Traits {
        const RELATIONS: &[Relation] =
            &[Relation::FormOf(EffectKind::CoulombFriction, RevealedBy::AtOtherPositions)];
        Traits::new(
            Linearity::Tangent,
            Imitable::Yes,
            Law::Approximate,
            Location::Elsewhere,
            Weights::Phases,
            RELATIONS,
        )
    }

    fn remedy(&self) -> Result<&'static str, &'static str> {
        Ok(EASED_LEVEL)
    }

    fn omission(&self, _: &Actuator) -> Option<&'static str> {
        None
    }

    /// Joints with a wave, or with the trial shape of one.
    fn places(&self, robot: &Robot) -> Vec<AtJoint> {
        joints_where(robot, |drive| drive.friction_wave.is_some())
    }

    fn columns(&self, AtJoint(j): AtJoint, motion: &RunMotion) -> Vec<EffectColumn> {
        let Some((wave, FrictionWave { periods, phase, .. })) = amplitude(&motion.drives[j]) else {
            return Vec::new();
        };
        let drive = &motion.drives[j];
        let [mean, skew] = mean_and_skew(drive);
        let signal = |part: fn(f64) -> f64| {
            let samples = motion.q[j].iter().zip(&motion.direction[j]);
            samples.map(move |(q, s)| {
                let [s, skewed] = along_a_log(drive, *s);
                let beside = if mean > 0.0 { skew / mean * skewed } else { 0.0 };
                motion.gain[j] * (s + beside) * part(periods * q + phase)
            })
        };
        let mut columns = vec![at_joint(j, signal(f64::cos)), at_joint(j, signal(f64::sin))];
        if wave.norm() > 0.0 {
            let lever = motion.q[j].iter().map(|q| -wave.norm() * (q - motion.centre[j]));
            columns.push(at_joint(j, signal(f64::sin).zip(lever).map(|(s, q)| s * q)));
        }
        columns
    }

    /// A wave as large as the effort itself, periods known to a phase of one over the range.
    fn prior(
        &self,
        AtJoint(j): AtJoint,
        robot: &Robot,
        scale: &Scale,
        priors: &Priors,
    ) -> Vec<f64> {
        let Some((wave, _)) = amplitude(&robot.links()[j].actuator) else { return Vec::new() };
        let periods = (wave.norm() > 0.0).then_some(priors.wave_periods_sd / scale.range[j]);
        [scale.effort[j]; 2].into_iter().chain(periods).collect()
    }

    fn bounds(&self, AtJoint(j): AtJoint, robot: &Robot, _: &Priors) -> Vec<(f64, f64)> {
        let Some((wave, known)) = amplitude(&robot.links()[j].actuator) else { return Vec::new() };
        let periods = (wave.norm() > 0.0).then_some((-0.5 * known.periods, f64::INFINITY));
        infinite_bounds(2).into_iter().chain(periods).collect()
    }

    /// The wave of a joint without a Coulomb level stays zero.
    fn extend(
        &self,
        AtJoint(j): AtJoint,
        robot: &mut Robot,
        weights: &[f64],
        frame: &Frame,
        _: &Priors,
    ) {
        let [cosine, sine, periods @ ..] = weights else { return };
        let Some(link) = robot.link_mut(j) else { return };
        let drive = &mut link.actuator;
        let level = level(drive);
        let Some((wave, FrictionWave { phase, .. })) = amplitude(drive) else { return };
        let changed = wave + Complex::new(*cosine, -sine) * Complex::from_polar(1.0, phase);
        if let Some(known) = &mut drive.friction_wave {
            let periods = periods.first().unwrap_or(&0.0);
            known.share = if level > 0.0 { (changed.norm() / level).min(1.0) } else { 0.0 };
            known.periods += periods;
            known.phase = changed.arg() - periods * frame.centre[j];
        }
    }

    fn quantities(
        &self,
        AtJoint(j): AtJoint,
        nominal: &Robot,
        extended: &Robot,
    ) -> Vec<EffectQuantity> {
        let robots = [nominal, extended];
        let wave = |pick: fn(FrictionWave) -> f64, none: f64| {
            move |a: &Actuator| a.friction_wave.map_or(none, pick)
        };
        vec![
            actuator_quantity(self.kind(), 0, j, robots, level),
            actuator_quantity(self.kind(), 1, j, robots, wave(|w| w.share, 0.0)),
            actuator_quantity(self.kind(), 2, j, robots, wave(|w| w.periods, f64::INFINITY)),
            actuator_quantity(self.kind(), 3, j, robots, wave(|w| w.phase, f64::INFINITY)),
        ]
    }

    fn shape(&self) -> Option<&dyn HasShape> {
        Some(self)
    }

    fn can_be_unsound(&self) -> Option<&dyn CanBeUnsound<AtJoint>> {
        Some(self)
    }

    fn can_hide(&self) -> Option<&dyn CanHide<AtJoint>> {
        Some(self)
    }
}

impl HasShape for PositionDependentFriction {
    fn shapes(
        &self,
        AtJoint(joint): AtJoint,
        robot: &Robot,
        scale: &Scale,
        priors: &Priors,
    ) -> Vec<f64> {
        let range = scale.range[joint];
        if robot.links()[joint].actuator.friction_wave.is_some() || range <= 0.0 {
            return Vec::new();
        }
        let step = APART / range;
        let count = ((priors.wave_most_periods - priors.wave_fewest_periods) / step) as usize + 1;
        (0..count).map(|k| priors.wave_fewest_periods + k as f64 * step).collect()
    }

    fn set_shape(&self, _: usize, shaped: ShapedDrive<'_>, shape: f64) {
        shaped.drive.friction_wave = Some(FrictionWave { share: 0.0, periods: shape, phase: 0.0 });
    }

    fn drop_unused_shape(&self, drive: &mut Actuator, before: &Actuator) {
        if drive.friction_wave.is_some_and(|w| w.share <= 0.0) {
            drive.friction_wave = before.friction_wave;
        }
    }
}

impl CanBeUnsound<AtJoint> for PositionDependentFriction {
    /// Whether friction opposes the motion everywhere.
    fn is_sound(&self, AtJoint(j): AtJoint, extended: &Robot, priors: &Priors) -> bool {
        let wave = extended.links()[j].actuator.friction_wave;
        wave.is_some_and(|w| w.share > 0.0 && w.share < priors.wave_share_limit)
    }
}

impl CanHide<AtJoint> for PositionDependentFriction {
    /// For the longest wave with its crest in the middle of the range of motion, the logs show `1 - cos(reach)` of it.
    fn largest_unseen(
        &self,
        AtJoint(j): AtJoint,
        _: &Robot,
        frame: &Frame,
        priors: &Priors,
    ) -> f64 {
        let phase = priors.wave_fewest_periods * frame.reach[j];
        if phase < FRAC_PI_2 { (1.0 - phase.cos()).recip() } else { 1.0 }
    }
}
