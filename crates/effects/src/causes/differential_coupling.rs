use catalogue::EffectKind;
use robot::{Actuator, Coupling, Robot};

use crate::abilities::{HasShape, IsRare, ShapedDrive};
use crate::bounds::down_to_zero;
use crate::column::{ColumnPart, EffectColumn};
use crate::effect::Effect;
use crate::motion::frame::Frame;
use crate::motion::run_motion::RunMotion;
use crate::motion::scale::Scale;
use crate::place::{AtJoint, joints_where};
use crate::priors::Priors;
use crate::quantity::{EffectQuantity, actuator_quantity};
use crate::traits::{Imitable, Law, Linearity, Location, Relation, Traits, Weights};

/// Friction of two motors that a joint and the next one share. Four weights: a dry level and a viscous factor of the
/// motor that turns with the sum, and the same of the motor that turns with the difference. Where the friction is
/// above zero, a fifth weight is the change of the ratio.
pub(crate) struct DifferentialCoupling;

/// Trial ratios: half to twice, a tenth to a fifth apart.
const RATIOS: [f64; 11] = [0.5, 0.57, 0.66, 0.76, 0.87, 1.0, 1.15, 1.32, 1.52, 1.74, 2.0];

/// Direction in which the other joint turns the motors of the sum and of the difference.
const WAYS: [f64; 2] = [1.0, -1.0];

/// Relative step of the ratio in the central difference.
const STEP: f64 = 0.02;

impl DifferentialCoupling {
    /// Friction at both joints per unit of `level` and `viscous` of one motor.
    fn unit(
        motion: &RunMotion,
        j: usize,
        c: &Coupling,
        [level, viscous, way]: [f64; 3],
    ) -> EffectColumn {
        let other = c.other;
        let signal = motion.motor(j, other, way * c.ratio);
        let friction = |scale: f64| -> Vec<f64> {
            let one = |(w, s): &(f64, f64)| scale * (level * s + viscous * w);
            signal.iter().map(one).collect()
        };
        vec![
            ColumnPart { joint: j, values: friction(motion.gain[j]) },
            ColumnPart { joint: other, values: friction(motion.gain[other] * way * c.ratio) },
        ]
    }

    fn all(motion: &RunMotion, j: usize, c: &Coupling) -> EffectColumn {
        let [sum, difference] =
            [0, 1].map(|k| Self::unit(motion, j, c, [c.level[k], c.viscous[k], WAYS[k]]));
        let both = |(mut a, b): (ColumnPart, ColumnPart)| {
            a.values.iter_mut().zip(b.values).for_each(|(a, b)| *a += b);
            a
        };
        sum.into_iter().zip(difference).map(both).collect()
    }
}

/// Whether any friction of the motors is known.
fn is_known(c: &Coupling) -> bool {
    c.level.iter().chain(&c.viscous).any(|v| *v > 0.0)
}

impl Effect for DifferentialCoupling {
    type At = AtJoint;

    fn kind(&self) -> EffectKind {
        EffectKind::DifferentialCoupling
    }

    fn traits(&self) -> Traits {
        const RELATIONS: &[Relation] = &[Relation::PlainerAtEveryJoint(&[
            EffectKind::CoulombFriction,
            EffectKind::ViscousFriction,
        ])];
        Traits::new(
            Linearity::Tangent,
            Imitable::Yes,
            Law::Approximate,
            Location::Elsewhere,
            Weights::Direct,
            RELATIONS,
        )
    }

    fn remedy(&self) -> Result<&'static str, &'static str> {
        Ok("the friction of the shared motors at their speeds, eased through rest")
    }

    fn omission(&self, drive: &Actuator) -> Option<&'static str> {
        drive.coupling.map(|_| "coupling")
    }

    /// Joints with a coupling, or with the trial shape of one.
    fn places(&self, robot: &Robot) -> Vec<AtJoint> {
        joints_where(robot, |drive| drive.coupling.is_some())
    }

    fn columns(&self, AtJoint(j): AtJoint, motion: &RunMotion) -> Vec<EffectColumn> {
        let Some(known) = motion.drives[j].coupling else { return Vec::new() };
        let unit = |of: [f64; 3]| Self::unit(motion, j, &known, of);
        let mut columns: Vec<EffectColumn> =
            WAYS.iter().flat_map(|&way| [unit([1.0, 0.0, way]), unit([0.0, 1.0, way])]).collect();
        if is_known(&known) {
            let at = |ratio: f64| Self::all(motion, j, &Coupling { ratio, ..known });
            let mut wide = at((1.0 + STEP) * known.ratio);
            let narrow = at((1.0 - STEP) * known.ratio);
            for (a, b) in wide.iter_mut().zip(narrow) {
                let slope = |(a, b): (&mut f64, f64)| *a = (*a - b) / (2.0 * STEP * known.ratio);
                a.values.iter_mut().zip(b.values).for_each(slope);
            }
            columns.push(wide);
        }
        columns
    }

    /// Levels and viscous torques as large as the effort itself.
    fn prior(
        &self,
        AtJoint(j): AtJoint,
        robot: &Robot,
        scale: &Scale,
        priors: &Priors,
    ) -> Vec<f64> {
        let Some(known) = robot.links()[j].actuator.coupling else { return Vec::new() };
        let one = [scale.effort[j], scale.effort_per(j, &scale.speed)];
        let ratio = is_known(&known).then_some(priors.shared_ratio_sd);
        one.into_iter().chain(one).chain(ratio).collect()
    }

    fn bounds(&self, AtJoint(j): AtJoint, robot: &Robot, _: &Priors) -> Vec<(f64, f64)> {
        let Some(c) = robot.links()[j].actuator.coupling else { return Vec::new() };
        let frictions = [c.level[0], c.viscous[0], c.level[1], c.viscous[1]];
        let ratio = is_known(&c).then_some((-0.5 * c.ratio, c.ratio));
        frictions.into_iter().flat_map(down_to_zero).chain(ratio).collect()
    }

    fn extend(
        &self,
        AtJoint(j): AtJoint,
        robot: &mut Robot,
        weights: &[f64],
        _: &Frame,
        _: &Priors,
    ) {
        let [sum, slope, difference, slant, ratio @ ..] = weights else {
            return;
        };
        let Some(link) = robot.link_mut(j) else { return };
        if let Some(c) = &mut link.actuator.coupling {
            c.level = [c.level[0] + sum, c.level[1] + difference];
            c.viscous = [c.viscous[0] + slope, c.viscous[1] + slant];
            c.ratio += ratio.first().unwrap_or(&0.0);
        }
    }

    fn quantities(
        &self,
        AtJoint(j): AtJoint,
        nominal: &Robot,
        extended: &Robot,
    ) -> Vec<EffectQuantity> {
        let robots = [nominal, extended];
        let read = |index: usize, none: f64, pick: fn(Coupling) -> f64| {
            actuator_quantity(self.kind(), index, j, robots, |a| a.coupling.map_or(none, pick))
        };
        vec![
            read(0, f64::INFINITY, |c| c.ratio),
            read(1, 0.0, |c| c.level[0]),
            read(2, 0.0, |c| c.level[1]),
            read(3, 0.0, |c| c.viscous[0]),
            read(4, 0.0, |c| c.viscous[1]),
        ]
    }

    fn shape(&self) -> Option<&dyn HasShape> {
        Some(self)
    }

    fn rare(&self) -> Option<&dyn IsRare<AtJoint>> {
        Some(self)
    }
}

impl HasShape for DifferentialCoupling {
    fn shapes(&self, AtJoint(joint): AtJoint, robot: &Robot, _: &Scale, _: &Priors) -> Vec<f64> {
        let next = robot.links().get(joint + 1).filter(|link| link.parent == Some(joint));
        let known = robot.links()[joint].actuator.coupling.is_some();
        let alike = next.is_some_and(|link| {
            link.joint.kind.is_rotation() == robot.links()[joint].joint.kind.is_rotation()
        });
        if alike && !known { RATIOS.to_vec() } else { Vec::new() }
    }

    fn set_shape(&self, joint: usize, shaped: ShapedDrive<'_>, shape: f64) {
        let nothing = [0.0; 2];
        shaped.drive.coupling =
            Some(Coupling { other: joint + 1, ratio: shape, level: nothing, viscous: nothing });
    }

    fn drop_unused_shape(&self, drive: &mut Actuator, before: &Actuator) {
        if drive.coupling.is_some_and(|c| c.level.iter().chain(&c.viscous).all(|v| *v <= 0.0)) {
            drive.coupling = before.coupling;
        }
    }
}

impl IsRare<AtJoint> for DifferentialCoupling {
    /// Few arms share motors, and most of these are described so. Friction of the sum and difference of two speeds
    /// imitates other effects at both joints.
    fn prior_log_odds_against(&self, AtJoint(j): AtJoint, robot: &Robot, priors: &Priors) -> f64 {
        let drive = robot.links().get(j).map(|link| &link.actuator);
        let coupling = drive.and_then(|drive| drive.coupling);
        if coupling.is_some_and(|c| is_known(&c)) {
            0.0
        } else {
            priors.shared_motors_log_odds_against
        }
    }
}
