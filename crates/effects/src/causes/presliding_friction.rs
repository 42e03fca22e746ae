use catalogue::EffectKind;
use robot::{Actuator, Robot};

use crate::abilities::CanBeUnsound;
use crate::bounds::down_to_zero;
use crate::column::{EffectColumn, at_joint};
use crate::effect::Effect;
use crate::motion::drive::{Bristles, bristles};
use crate::motion::frame::Frame;
use crate::motion::run_motion::RunMotion;
use crate::motion::scale::Scale;
use crate::place::{AtJoint, every_joint};
use crate::priors::Priors;
use crate::quantity::{EffectQuantity, actuator_quantity};
use crate::traits::{Imitable, Law, Linearity, Location, Relation, RevealedBy, Traits, Weights};

/// Dry friction that builds up over a displacement, the way. A robot without it has one weight a joint: the friction
/// (N·m or N) that builds up over a small way instead of at once. A robot with it has two: the changes of the way and
/// of the damping.
///
/// ```text
/// s(way) - sign(qd)
/// (f(1.1 way) - f(0.9 way)) / (0.2 way),   way ds/dt,   f(way) = level s(way) + damping way ds/dt
/// ```
pub(crate) struct PreslidingFriction;

/// Way of the column of a robot without presliding (rad or m).
const SMALL: f64 = 0.002;

/// Relative step of the way in the central difference.
const STEP: f64 = 0.1;

/// Least and largest change of a way in one step, over the way.
const WAY_STEP: (f64, f64) = (-0.5, 1.0);

fn level(drive: &Actuator) -> f64 {
    0.5 * (drive.coulomb_forward + drive.coulomb_backward)
}

impl Effect for PreslidingFriction {
    type At = AtJoint;

    fn kind(&self) -> EffectKind {
        EffectKind::PreslidingFriction
    }

    fn traits(&self) -> Traits {
        const RELATIONS: &[Relation] =
            &[Relation::FormOf(EffectKind::CoulombFriction, RevealedBy::NearRest)];
        Traits::new(
            Linearity::Tangent,
            Imitable::Yes,
            Law::Approximate,
            Location::Elsewhere,
            Weights::SeenBy(1),
            RELATIONS,
        )
    }

    fn remedy(&self) -> Result<&'static str, &'static str> {
        Ok("its level as that of Coulomb friction, not the way over which it builds up")
    }

    fn omission(&self, drive: &Actuator) -> Option<&'static str> {
        drive.presliding.map(|_| "presliding_rad")
    }

    fn places(&self, robot: &Robot) -> Vec<AtJoint> {
        every_joint(robot)
    }

    fn columns(&self, AtJoint(j): AtJoint, motion: &RunMotion) -> Vec<EffectColumn> {
        let (gain, drive) = (motion.gain[j], &motion.drives[j]);
        let bristles = |way: f64| bristles(&motion.q[j], way);
        let Some(way) = drive.presliding else {
            let slower = bristles(SMALL).held.into_iter().zip(&motion.direction[j]);
            return vec![at_joint(j, slower.map(|(held, s)| gain * (held - s)))];
        };
        let (level, damping) = (level(drive), drive.presliding_damping.unwrap_or(0.0));
        let per_sample = damping / motion.period_s;
        let friction = |way: f64| {
            let Bristles { held, bending } = bristles(way);
            held.into_iter().zip(bending).map(move |(s, bent)| level * s + per_sample * bent)
        };
        let (long, short) = (friction((1.0 + STEP) * way), friction((1.0 - STEP) * way));
        let per_way = gain / (2.0 * STEP * way);
        let longer = long.zip(short).map(|(long, short)| per_way * (long - short));
        let per_damping = gain / motion.period_s;
        let damped = bristles(way).bending.into_iter().map(|bent| per_damping * bent);
        vec![at_joint(j, longer), at_joint(j, damped)]
    }

    fn prior(
        &self,
        AtJoint(j): AtJoint,
        robot: &Robot,
        scale: &Scale,
        priors: &Priors,
    ) -> Vec<f64> {
        match robot.links()[j].actuator.presliding {
            Some(_) => vec![priors.presliding_way_sd, scale.effort_per(j, &scale.speed)],
            None => vec![scale.effort[j]],
        }
    }

    fn bounds(&self, AtJoint(j): AtJoint, robot: &Robot, _: &Priors) -> Vec<(f64, f64)> {
        let drive = &robot.links()[j].actuator;
        let Some(way) = drive.presliding else { return vec![(0.0, f64::INFINITY)] };
        let (least, most) = WAY_STEP;
        let damping = down_to_zero(drive.presliding_damping.unwrap_or(0.0));
        [vec![(least * way, most * way)], damping].concat()
    }

    /// To first order in the way, half the friction over a way is all of it over half the way.
    fn extend(
        &self,
        AtJoint(j): AtJoint,
        robot: &mut Robot,
        weights: &[f64],
        frame: &Frame,
        priors: &Priors,
    ) {
        let [change, damping @ ..] = weights else { return };
        let Some(link) = robot.link_mut(j) else { return };
        let drive = &mut link.actuator;
        let level = level(drive);
        let way = match drive.presliding {
            Some(way) => way + change,
            None if level > 0.0 => SMALL * change / level,
            None => 0.0,
        };
        let resolved = frame.resolution.get(j).map_or(0.0, |r| priors.presliding_resolved * r);
        if drive.presliding.is_some() || way > 0.0 {
            // A way that is not resolved is made shorter than the shortest, which is not sound.
            drive.presliding =
                Some(if way >= resolved { way } else { 0.5 * priors.presliding_shortest_way });
        }
        if let [damping] = damping {
            drive.presliding_damping = Some(drive.presliding_damping.unwrap_or(0.0) + damping);
        }
    }

    fn quantities(
        &self,
        AtJoint(j): AtJoint,
        nominal: &Robot,
        extended: &Robot,
    ) -> Vec<EffectQuantity> {
        let robots = [nominal, extended];
        let stiffness = |a: &Actuator| a.presliding.map_or(f64::INFINITY, |way| level(a) / way);
        vec![
            actuator_quantity(self.kind(), 0, j, robots, stiffness),
            actuator_quantity(self.kind(), 1, j, robots, level),
            actuator_quantity(self.kind(), 2, j, robots, |a| a.presliding_damping.unwrap_or(0.0)),
        ]
    }

    fn can_be_unsound(&self) -> Option<&dyn CanBeUnsound<AtJoint>> {
        Some(self)
    }
}

impl CanBeUnsound<AtJoint> for PreslidingFriction {
    /// Whether the joint has dry friction, and a way that is long enough to be distinguished from none.
    fn is_sound(&self, AtJoint(j): AtJoint, extended: &Robot, priors: &Priors) -> bool {
        let drive = &extended.links()[j].actuator;
        drive.presliding.is_some_and(|way| way >= priors.presliding_shortest_way)
            && level(drive) > 0.0
    }
}
