use catalogue::EffectKind;
use robot::{Actuator, Robot, Stribeck};

use crate::abilities::{CanBeUnsound, CanHide, HasPlainer, HasShape, ShapedDrive};
use crate::bounds::down_to_zero;
use crate::column::{EffectColumn, at_joint};
use crate::effect::{EASED_LEVEL, Effect};
use crate::motion::frame::Frame;
use crate::motion::run_motion::RunMotion;
use crate::motion::scale::Scale;
use crate::place::{AtJoint, joints_where};
use crate::priors::Priors;
use crate::quantity::{EffectQuantity, actuator_quantity};
use crate::traits::{Imitable, Law, Linearity, Location, Relation, RevealedBy, Traits, Weights};

/// Dry friction near rest beyond the Coulomb level. One weight a joint: the change of the excess. Where the excess is
/// above zero, a second weight is the change of the velocity.
///
/// ```text
/// exp(-(qd / velocity)^2) sign(qd)
/// excess 2 qd^2 / velocity^3 exp(-(qd / velocity)^2) sign(qd)
/// ```
pub(crate) struct StribeckFriction;

/// Trial velocities as shares of the largest speed: a factor of 2 apart, from about the speed at
/// which a joint counts as at rest.
const SHARES: [f64; 6] = [0.005, 0.01, 0.02, 0.04, 0.08, 0.16];

/// Least and largest change of a velocity in one step, over the velocity.
const VELOCITY_STEP: (f64, f64) = (-0.5, 1.0);

fn of(drive: &Actuator) -> Option<Stribeck> {
    drive.stribeck
}

impl Effect for StribeckFriction {
    type At = AtJoint;

    fn kind(&self) -> EffectKind {
        EffectKind::StribeckFriction
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
        Ok(EASED_LEVEL)
    }

    fn omission(&self, _: &Actuator) -> Option<&'static str> {
        None
    }

    /// Joints with an excess, or with the trial shape of one.
    fn places(&self, robot: &Robot) -> Vec<AtJoint> {
        joints_where(robot, |drive| of(drive).is_some())
    }

    fn columns(&self, AtJoint(j): AtJoint, motion: &RunMotion) -> Vec<EffectColumn> {
        let Some(Stribeck { excess, velocity }) = of(&motion.drives[j]) else { return Vec::new() };
        let near_rest = |t: usize| {
            let speed = motion.qd[j][t] / velocity;
            (speed, motion.gain[j] * motion.direction[j][t] * (-speed * speed).exp())
        };
        let all = 0..motion.samples();
        let mut columns = vec![at_joint(j, all.clone().map(|t| near_rest(t).1))];
        if excess > 0.0 {
            let by_velocity = |t: usize| {
                let (speed, share) = near_rest(t);
                2.0 * excess / velocity * speed * speed * share
            };
            columns.push(at_joint(j, all.map(by_velocity)));
        }
        columns
    }

    /// An excess as large as the effort itself, a velocity known to its half.
    fn prior(
        &self,
        AtJoint(j): AtJoint,
        robot: &Robot,
        scale: &Scale,
        priors: &Priors,
    ) -> Vec<f64> {
        let Some(known) = of(&robot.links()[j].actuator) else { return Vec::new() };
        let velocity = (known.excess > 0.0).then_some(priors.shape_sd_share * known.velocity);
        [scale.effort[j]].into_iter().chain(velocity).collect()
    }

    fn bounds(&self, AtJoint(j): AtJoint, robot: &Robot, _: &Priors) -> Vec<(f64, f64)> {
        let Some(known) = of(&robot.links()[j].actuator) else { return Vec::new() };
        let (least, most) = VELOCITY_STEP;
        let velocity =
            (known.excess > 0.0).then_some((least * known.velocity, most * known.velocity));
        down_to_zero(known.excess).into_iter().chain(velocity).collect()
    }

    fn extend(
        &self,
        AtJoint(j): AtJoint,
        robot: &mut Robot,
        weights: &[f64],
        frame: &Frame,
        priors: &Priors,
    ) {
        let [excess, velocity @ ..] = weights else { return };
        let Some(link) = robot.link_mut(j) else { return };
        if let Some(known) = &mut link.actuator.stribeck {
            known.excess += excess;
            let velocity = known.velocity + velocity.first().unwrap_or(&0.0);
            known.velocity = velocity.max(priors.stribeck_least_velocity * frame.rest_speed[j]);
        }
    }

    fn quantities(
        &self,
        AtJoint(j): AtJoint,
        nominal: &Robot,
        extended: &Robot,
    ) -> Vec<EffectQuantity> {
        let robots = [nominal, extended];
        let level = |a: &Actuator| 0.5 * (a.coulomb_forward + a.coulomb_backward);
        let excess = |a: &Actuator| of(a).map_or(0.0, |s| s.excess);
        let velocity = |a: &Actuator| of(a).map_or(f64::INFINITY, |s| s.velocity);
        vec![
            actuator_quantity(self.kind(), 0, j, robots, level),
            actuator_quantity(self.kind(), 1, j, robots, |a| level(a) + excess(a)),
            actuator_quantity(self.kind(), 2, j, robots, velocity),
        ]
    }

    fn shape(&self) -> Option<&dyn HasShape> {
        Some(self)
    }

    fn can_be_unsound(&self) -> Option<&dyn CanBeUnsound<AtJoint>> {
        Some(self)
    }

    fn plainer(&self) -> Option<&dyn HasPlainer<AtJoint>> {
        Some(self)
    }

    fn can_hide(&self) -> Option<&dyn CanHide<AtJoint>> {
        Some(self)
    }
}

impl HasShape for StribeckFriction {
    fn shapes(
        &self,
        AtJoint(joint): AtJoint,
        robot: &Robot,
        scale: &Scale,
        _: &Priors,
    ) -> Vec<f64> {
        let known = of(&robot.links()[joint].actuator).is_some();
        let speed = scale.speed[joint];
        if known || speed <= 0.0 { Vec::new() } else { SHARES.map(|s| s * speed).to_vec() }
    }

    fn set_shape(&self, _: usize, shaped: ShapedDrive<'_>, shape: f64) {
        shaped.drive.stribeck = Some(Stribeck { excess: 0.0, velocity: shape });
    }

    fn drop_unused_shape(&self, drive: &mut Actuator, before: &Actuator) {
        if drive.stribeck.is_some_and(|s| s.excess <= 0.0) {
            drive.stribeck = before.stribeck;
        }
    }
}

impl CanBeUnsound<AtJoint> for StribeckFriction {
    /// Whether the friction near rest is notably larger than the Coulomb level.
    fn is_sound(&self, AtJoint(j): AtJoint, extended: &Robot, priors: &Priors) -> bool {
        let drive = &extended.links()[j].actuator;
        let level = 0.5 * (drive.coulomb_forward + drive.coulomb_backward);
        of(drive).is_some_and(|s| s.excess > priors.stribeck_least_excess * level)
    }
}

impl HasPlainer<AtJoint> for StribeckFriction {
    /// The change of the excess, and the velocity beyond the least one.
    fn more_than_plain(
        &self,
        AtJoint(j): AtJoint,
        [nominal, extended]: [&Robot; 2],
        frame: &Frame,
        priors: &Priors,
    ) -> Vec<(usize, f64)> {
        let excess = |robot: &Robot| of(&robot.links()[j].actuator).map_or(0.0, |s| s.excess);
        let velocity = of(&extended.links()[j].actuator).map_or(0.0, |s| s.velocity);
        let unseen = self.largest_unseen(AtJoint(j), extended, frame, priors);
        vec![(0, excess(extended) - excess(nominal)), (1, velocity * (1.0 - unseen.powi(-2)))]
    }
}

impl CanHide<AtJoint> for StribeckFriction {
    /// At the least velocity: the number of samples near rest grows with the velocity, and the smallest excess that
    /// the logs show falls with its root.
    fn largest_unseen(
        &self,
        AtJoint(j): AtJoint,
        robot: &Robot,
        frame: &Frame,
        priors: &Priors,
    ) -> f64 {
        let least = priors.stribeck_least_velocity * frame.rest_speed[j];
        let velocity = of(&robot.links()[j].actuator).map_or(least, |s| s.velocity);
        (velocity / least).sqrt().max(1.0)
    }
}
