use catalogue::EffectKind;
use nalgebra::{Complex, Isometry3};
use robot::{Actuator, Counterbalance as Described, Robot};

use crate::explain::{actuator_quantity, unbounded};
use crate::{
    Column, Explain, Frame, Law, Linearity, Motion, Nature, Place, Quantity, Relation, Scale, Seat,
    Weights,
};

/// `amplitude sin(q + phase)`: two weights a joint that turns, the changes of the sine and of the cosine
/// of the link's position (N·m).
///
/// ```text
/// z = amplitude exp(i phase),   amplitude sin(q + phase) = Re(z) sin(q) + Im(z) cos(q)
/// ```
pub(crate) struct Counterbalance;

/// Log odds (nats) against a counterbalance that no description names, those of motors that are shared and
/// described nowhere: of what it has to add to a spring, an offset and the weight of the link.
const RARE: f64 = 100.0;

/// Least sine between gravity and the axis of a joint that lifts.
const TILTED: f64 = 1e-3;

/// Amplitude and phase of a drive in one number (N·m).
fn balance(drive: &Actuator) -> Complex<f64> {
    drive.counterbalance.map_or(Complex::ZERO, |c| Complex::from_polar(c.amplitude, c.phase))
}

/// Whether each joint carries weight somewhere: its axis is upright in no pose, or in some only.
fn lifts(robot: &Robot) -> Vec<bool> {
    let gravity = robot.gravity_in_base();
    let (mut lifts, mut turns_over): (Vec<bool>, Vec<bool>) = (Vec::new(), Vec::new());
    let mut poses: Vec<Isometry3<f64>> = Vec::new();
    for link in robot.links() {
        let parent = link.parent.map_or_else(Isometry3::identity, |p| poses[p]);
        let pose = parent * link.joint.parent_from_child(0.0);
        let axis = pose * link.joint.axis_in_joint.into_inner();
        let turned = link.parent.is_some_and(|p| turns_over[p]);
        let tilted = axis.cross(&gravity).norm() > TILTED * gravity.norm();
        lifts.push(gravity.norm() > 0.0 && (turned || tilted));
        turns_over.push(turned || tilted && link.joint.kind.is_rotation());
        poses.push(pose);
    }
    lifts
}

impl Explain for Counterbalance {
    fn kind(&self) -> EffectKind {
        EffectKind::Counterbalance
    }

    /// Over a short way the sine is a spring and an offset, and at the first joint that lifts the weight of its
    /// link.
    fn nature(&self) -> Nature {
        const RELATIONS: &[Relation] = &[Relation::PlainerOfJointAndLink {
            joint: &[EffectKind::CableSpring, EffectKind::TorqueOffset],
            link: &[EffectKind::InertialParameters],
        }];
        Nature::new(Linearity::Exact, Law::Firm, Seat::Elsewhere, Weights::Direct, RELATIONS)
    }

    /// Every joint that turns and lifts.
    fn places(&self, robot: &Robot) -> Vec<Place> {
        let lifts = lifts(robot);
        let links = robot.links().iter().zip(lifts).enumerate();
        let here = links.filter(|(_, (l, lifts))| *lifts && l.joint.kind.is_rotation());
        here.map(|(j, _)| Place::Joint(j)).collect()
    }

    fn columns(&self, place: Place, motion: &Motion) -> Vec<Column> {
        let Place::Joint(j) = place else { return Vec::new() };
        let wave = |of: fn(f64) -> f64| {
            let q = motion.link[0][j].iter();
            vec![motion.carried(j, q.map(|q| of(*q)))]
        };
        vec![wave(f64::sin), wave(f64::cos)]
    }

    /// A torque as large as the effort itself.
    fn prior(&self, place: Place, _: &Robot, scale: &Scale) -> Vec<f64> {
        let Place::Joint(j) = place else { return Vec::new() };
        vec![scale.effort[j]; 2]
    }

    /// None against one that the robot is described with, whose strength may be another.
    fn rarity(&self, place: Place, robot: &Robot) -> f64 {
        let Place::Joint(j) = place else { return 0.0 };
        let described = robot.links()[j].actuator.counterbalance.is_some();
        if described { 0.0 } else { RARE }
    }

    fn bounds(&self, _: Place, _: &Robot) -> Vec<(f64, f64)> {
        unbounded(2)
    }

    fn extend(&self, place: Place, robot: &mut Robot, weights: &[f64], _: &Frame) {
        let (Place::Joint(j), [sine, cosine]) = (place, weights) else { return };
        let Some(link) = robot.link_mut(j) else { return };
        let changed = balance(&link.actuator) + Complex::new(*sine, *cosine);
        let (amplitude, phase) = changed.to_polar();
        link.actuator.counterbalance = Some(Described { amplitude, phase });
    }

    fn quantities(&self, place: Place, nominal: &Robot, extended: &Robot) -> Vec<Quantity> {
        let Place::Joint(j) = place else { return Vec::new() };
        let robots = [nominal, extended];
        vec![
            actuator_quantity(self.kind(), 0, j, robots, |a| balance(a).norm()),
            actuator_quantity(self.kind(), 1, j, robots, |a| balance(a).arg()),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A yaw, a pitch and a roll under gravity along z, and the same arm on a wall.
    #[test]
    fn an_upright_axis_lifts_nothing_until_an_axis_before_it_is_tilted() {
        let link = |name: &str| {
            format!(
                r#"<link name="{name}"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0"
                iyy="1" iyz="0" izz="1"/></inertial></link>"#
            )
        };
        let joint = |name: &str, parent: &str, axis: &str| {
            format!(
                r#"<joint name="j_{name}" type="continuous"><parent link="{parent}"/>
                <child link="{name}"/><axis xyz="{axis}"/></joint>"#
            )
        };
        let urdf = format!(
            r#"<robot name="arm"><link name="base"/>{}{}{}{}{}{}</robot>"#,
            link("yaw"),
            link("pitch"),
            link("roll"),
            joint("yaw", "base", "0 0 1"),
            joint("pitch", "yaw", "0 1 0"),
            joint("roll", "pitch", "0 0 1"),
        );
        let robot = Robot::from_urdf(&urdf).unwrap();
        assert_eq!(lifts(&robot), [false, true, true]);
        let on_a_wall = robot.with_gravity(nalgebra::Vector3::new(9.81, 0.0, 0.0));
        assert_eq!(lifts(&on_a_wall), [true; 3]);
    }
}
