//! One cause at a time, at least one trial for every effect that has a model.

use catalogue::EffectKind;
use nalgebra::{Matrix3, Rotation3, Vector3};
use robot::{Inertia, Robot};

use crate::world::{World, sign};

const J1: usize = 0;
const J2: usize = 1;
const J3: usize = 2;
const J4: usize = 3;

/// One cause and what must be said of it.
pub struct Trial {
    /// The effect.
    pub kind: EffectKind,
    /// Name of its joint or link; empty for the base.
    pub place: &'static str,
    /// The world with it.
    pub world: fn(World) -> World,
    /// True values of its parameters.
    pub sizes: &'static [(&'static str, f64)],
    /// Joints whose verdict must speak of it.
    pub joints: &'static [usize],
    /// How precisely it must be named.
    pub name: Name,
    /// Another effect that is part of the same truth: no stray.
    pub beside: Option<&'static str>,
}

/// How precisely physics lets it be named.
#[derive(Clone, Copy, PartialEq)]
pub enum Name {
    /// It is a finding on every seed.
    Exact,
    /// Another effect has (nearly) the same columns: it is a finding or a rival of one.
    OrRival,
}

impl Trial {
    /// The cause in words, as a finding names it.
    pub fn words(&self) -> String {
        match self.place {
            "" => self.kind.label(),
            place => format!("{} at {place}", self.kind.label()),
        }
    }
}

/// The trials of an effect; none for what the diagnosis has no name for.
pub fn trials(kind: EffectKind) -> Vec<Trial> {
    match kind {
        EffectKind::ViscousFriction
        | EffectKind::CoulombFriction
        | EffectKind::AsymmetricFriction => friction(kind),
        EffectKind::TorqueOffset | EffectKind::TorqueConstant => reading(kind),
        EffectKind::RotorInertia | EffectKind::InertialParameters | EffectKind::Payload => {
            body(kind)
        }
        EffectKind::CableSpring => vec![Trial {
            kind,
            place: "j4_elbow_pitch",
            world: |w| w.torque(J4, |[q, ..]| 0.4 * (q - 1.0)),
            sizes: &[("stiffness", 0.4), ("rest", 1.0)],
            joints: &[J4],
            name: Name::Exact,
            // Where the spring is slack is a constant torque, and so is an offset.
            beside: Some("DR03 torque offset at j4_elbow_pitch"),
        }],
        EffectKind::GravityDirection => vec![Trial {
            kind,
            place: "",
            world: |w| w.body(tilted),
            sizes: &[("tilt_1", TILT), ("tilt_2", 0.0)],
            joints: &[J1, J2, J4],
            name: Name::Exact,
            beside: None,
        }],
        _ => Vec::new(),
    }
}

fn friction(kind: EffectKind) -> Vec<Trial> {
    let name = Name::Exact;
    match kind {
        EffectKind::ViscousFriction => vec![Trial {
            kind,
            place: "j4_elbow_pitch",
            world: |w| w.torque(J4, |[_, qd, _]| 0.6 * qd),
            sizes: &[("viscous", 0.6)],
            joints: &[J4],
            name,
            beside: None,
        }],
        EffectKind::CoulombFriction => vec![
            Trial {
                kind,
                place: "j2_shoulder_pitch",
                world: |w| w.torque(J2, |[_, qd, _]| 0.5 * sign(qd)),
                sizes: &[("level", 0.5)],
                joints: &[J2],
                name,
                beside: None,
            },
            Trial {
                kind,
                place: "j4_elbow_pitch",
                world: |w| w.torque(J4, |[_, qd, _]| 0.5 * sign(qd)),
                sizes: &[("level", 0.5)],
                joints: &[J4],
                name,
                beside: None,
            },
        ],
        _ => vec![Trial {
            kind,
            place: "j4_elbow_pitch",
            world: |w| w.torque(J4, |[_, qd, _]| if qd > 0.0 { 0.8 } else { 0.3 } * sign(qd)),
            sizes: &[("forward", 0.8), ("backward", 0.3)],
            joints: &[J4],
            name,
            beside: None,
        }],
    }
}

fn reading(kind: EffectKind) -> Vec<Trial> {
    let name = Name::Exact;
    match kind {
        EffectKind::TorqueOffset => vec![Trial {
            kind,
            place: "j3_shoulder_yaw",
            world: |w| w.reading(J3, |effort| effort + 0.3),
            sizes: &[("offset", 0.3)],
            joints: &[J3],
            name,
            beside: None,
        }],
        _ => vec![Trial {
            kind,
            place: "j4_elbow_pitch",
            world: |w| w.reading(J4, |effort| 1.1 * effort),
            sizes: &[("gain", 1.1)],
            joints: &[J4],
            name,
            beside: None,
        }],
    }
}

fn body(kind: EffectKind) -> Vec<Trial> {
    match kind {
        EffectKind::RotorInertia => vec![Trial {
            kind,
            place: "j3_shoulder_yaw",
            world: |w| w.torque(J3, |[_, _, qdd]| 0.1 * qdd),
            // 0.067 kg m^2 are in the description.
            sizes: &[("inertia", 0.167)],
            joints: &[J3],
            name: Name::Exact,
            beside: None,
        }],
        EffectKind::InertialParameters => vec![
            Trial {
                kind,
                place: "forearm",
                world: |w| w.body(heavy_forearm),
                sizes: &[("mass", 1.2 * 2.40016804)],
                joints: &[J2, J4],
                name: Name::OrRival,
                beside: None,
            },
            Trial {
                kind,
                place: "forearm",
                world: |w| w.body(shifted_forearm),
                sizes: &[("com_x", -0.04001488), ("com_y", -0.13271662 - 0.03)],
                joints: &[J2, J4],
                name: Name::OrRival,
                beside: None,
            },
        ],
        _ => vec![Trial {
            kind,
            place: "palm",
            world: |w| w.body(loaded),
            sizes: &[("mass", 1.0), ("com_x", 0.0), ("com_y", 0.0), ("com_z", 0.1)],
            joints: &[J2, J4],
            // A palm that is 1 kg heavier is the same body.
            name: Name::OrRival,
            beside: None,
        }],
    }
}

/// Two degrees about the x axis of the base.
const TILT: f64 = 2.0 * std::f64::consts::PI / 180.0;

fn tilted(robot: Robot) -> Robot {
    let gravity = Rotation3::new(Vector3::x() * TILT) * robot.gravity_in_base();
    robot.with_gravity(gravity)
}

pub fn changed(mut robot: Robot, link: &str, change: impl Fn(&Inertia) -> Inertia) -> Robot {
    let index = robot.links().iter().position(|l| l.name == link).unwrap();
    let link = robot.link_mut(index).unwrap();
    link.inertia = change(&link.inertia);
    robot
}

/// The same shape of a material 20 % heavier.
fn heavy_forearm(robot: Robot) -> Robot {
    changed(robot, "forearm", |i| Inertia {
        mass: 1.2 * i.mass,
        com_in_link: i.com_in_link,
        about_com: 1.2 * i.about_com,
    })
}

/// The centre of mass 3 cm farther along the forearm.
fn shifted_forearm(robot: Robot) -> Robot {
    changed(robot, "forearm", |i| Inertia {
        com_in_link: i.com_in_link - 0.03 * Vector3::y(),
        ..i.clone()
    })
}

/// A ball of 1 kg and 3 cm radius, 10 cm before the palm's origin.
pub fn loaded(robot: Robot) -> Robot {
    changed(robot, "palm", |i| {
        i.with_body(&Inertia {
            mass: 1.0,
            com_in_link: 0.1 * Vector3::z(),
            about_com: Matrix3::identity() * (0.4 * 0.03 * 0.03),
        })
    })
}
