use std::collections::BTreeSet;
use std::sync::Arc;

use nalgebra::Vector3;

use crate::error::RobotError;
use crate::range::{LARGEST, Most};
use crate::structure::link::Link;
use crate::structure::locked_joint::LockedJoint;

/// A robot: a tree of moving links on a fixed base.
///
/// Every link has one joint; `links()[i]` and `joint i` share the index, and a
/// parent always comes before its children.
#[derive(Debug, Clone, PartialEq)]
pub struct Robot {
    name: String,
    gravity_in_base: Vector3<f64>,
    links: Vec<Link>,
    /// Where joints are locked: the robot that they were locked in, and where they stand.
    unlocked: Option<Arc<Unlocked>>,
}

/// A robot of which some joints were locked.
#[derive(Debug, PartialEq)]
struct Unlocked {
    whole: Robot,
    locks: Vec<LockedJoint>,
}

impl Robot {
    /// A robot from its links, checked.
    ///
    /// `gravity_in_base` is the acceleration of free fall in the base frame (m/s²),
    /// `(0, 0, -9.81)` for an upright arm.
    ///
    /// # Errors
    ///
    /// [`RobotError::NoJoints`], [`RobotError::ParentNotBefore`],
    /// [`RobotError::DuplicateName`] and [`RobotError::NotFinite`].
    pub fn new(
        name: impl Into<String>,
        gravity_in_base: Vector3<f64>,
        links: Vec<Link>,
    ) -> Result<Self, RobotError> {
        let name = name.into();
        if links.is_empty() {
            return Err(RobotError::NoJoints { robot: name });
        }
        finite(&format!("robot {name}"), "gravity", gravity_in_base.iter())?;
        let (mut link_names, mut joint_names) = (BTreeSet::new(), BTreeSet::new());
        for (index, link) in links.iter().enumerate() {
            if let Some(parent) = link.parent.filter(|&p| p >= index) {
                return Err(RobotError::ParentNotBefore { link: link.name.clone(), parent, index });
            }
            if !link_names.insert(&link.name) {
                return Err(RobotError::DuplicateName { what: "link", name: link.name.clone() });
            }
            if !joint_names.insert(&link.joint.name) {
                let name = link.joint.name.clone();
                return Err(RobotError::DuplicateName { what: "joint", name });
            }
            finite_link(link)?;
        }
        Ok(Self { name, gravity_in_base, links, unlocked: None })
    }

    /// Name of the robot.
    pub fn name(&self) -> &str {
        &self.name
    }

    /// Number of joints, and of moving links.
    pub fn joint_count(&self) -> usize {
        self.links.len()
    }

    /// The moving links, parents first.
    pub fn links(&self) -> &[Link] {
        &self.links
    }

    /// A moving link whose inertia and actuator may be changed. The tree must stay as it is.
    pub fn link_mut(&mut self, index: usize) -> Option<&mut Link> {
        self.links.get_mut(index)
    }

    /// Index of the joint with this name.
    pub fn joint_index(&self, name: &str) -> Option<usize> {
        self.links.iter().position(|l| l.joint.name == name)
    }

    /// Names of the joints, in order.
    pub fn joint_names(&self) -> impl Iterator<Item = &str> {
        self.links.iter().map(|l| l.joint.name.as_str())
    }

    /// Acceleration of free fall in the base frame (m/s²).
    pub fn gravity_in_base(&self) -> Vector3<f64> {
        self.gravity_in_base
    }

    /// The joints that are locked, in the order of the URDF.
    pub fn locks(&self) -> &[LockedJoint] {
        self.unlocked.as_ref().map_or(&[], |unlocked| &unlocked.locks)
    }

    /// The robot that the joints were locked in.
    pub(crate) fn whole(&self) -> Option<&Self> {
        self.unlocked.as_ref().map(|unlocked| &unlocked.whole)
    }

    /// The same robot, which remembers the one that its joints were locked in.
    pub(crate) fn locked_in(mut self, whole: &Self, locks: &[LockedJoint]) -> Self {
        if !locks.is_empty() {
            self.unlocked =
                Some(Arc::new(Unlocked { whole: whole.clone(), locks: locks.to_vec() }));
        }
        self
    }

    /// The same robot under another gravity (m/s², base frame).
    pub fn with_gravity(mut self, gravity_in_base: Vector3<f64>) -> Self {
        self.gravity_in_base = gravity_in_base;
        self
    }
}

fn finite<'a>(
    thing: &str,
    quantity: &'static str,
    mut values: impl Iterator<Item = &'a f64>,
) -> Result<(), RobotError> {
    match values.find(|v| v.is_nan() || v.abs() > LARGEST) {
        Some(&value) if value.is_finite() => {
            let (thing, expected) = (thing.to_owned(), Most::NUMBER.1);
            Err(RobotError::OutOfRange { thing, quantity, value, expected })
        }
        Some(&value) => Err(RobotError::NotFinite { thing: thing.to_owned(), quantity, value }),
        None => Ok(()),
    }
}

fn finite_link(link: &Link) -> Result<(), RobotError> {
    let body = format!("link {}", link.name);
    finite(&body, "mass", [link.inertia.mass].iter())?;
    finite(&body, "centre of mass", link.inertia.com_in_link.iter())?;
    finite(&body, "inertia", link.inertia.about_com.iter())?;
    let joint = format!("joint {}", link.joint.name);
    finite(&joint, "origin", link.joint.parent_from_joint.to_homogeneous().iter())?;
    finite(&joint, "axis", link.joint.axis_in_joint.iter())?;
    let a = &link.actuator;
    let drive = [
        a.rotor_inertia,
        a.viscous,
        a.coulomb_forward,
        a.coulomb_backward,
        a.spring_stiffness,
        a.spring_rest,
        a.spring_cubic,
        a.spring_hysteresis,
        a.torque_gain,
        a.torque_offset,
        a.backlash,
        a.delay_s,
        a.load_friction,
        a.lag_s,
        a.effort_skew_s,
        a.goal_delay_s,
        a.encoder_offset,
        a.transmission_ratio,
    ];
    let stribeck = a.stribeck.map(|s| [s.excess, s.velocity]);
    let wave = a.friction_wave.map(|w| [w.share, w.periods, w.phase]);
    let ripple = a.ripple.map(|r| [r.amplitude, r.periods, r.phase]);
    let given = drive.iter().chain(&a.elasticity).chain(&a.presliding);
    let given = given.chain(&a.presliding_damping).chain(&a.elasticity_damping);
    let given = given.chain(stribeck.as_slice().as_flattened());
    let coupling =
        a.coupling.map(|c| [c.ratio, c.level[0], c.level[1], c.viscous[0], c.viscous[1]]);
    let given = given.chain(coupling.as_slice().as_flattened());
    let given = given.chain(wave.as_slice().as_flattened());
    let warming = a.warming.map(|w| [w.viscous_lost, w.coulomb_lost, w.time_constant_s]);
    let given = given.chain(warming.as_slice().as_flattened());
    let balance = a.counterbalance.map(|c| [c.amplitude, c.phase]);
    let given = given.chain(balance.as_slice().as_flattened());
    finite(&joint, "actuator parameter", given.chain(ripple.as_slice().as_flattened()))
}
