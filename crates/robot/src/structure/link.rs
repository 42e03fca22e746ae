use crate::structure::actuator::Actuator;
use crate::structure::inertia::Inertia;
use crate::structure::joint::Joint;

/// A moving link: the body, the joint that carries it and that joint's actuator.
///
/// Links fixed to it in the URDF are merged into its inertia.
#[derive(Debug, Clone, PartialEq)]
pub struct Link {
    /// Name of the link.
    pub name: String,
    /// Index of the parent link, `None` for the base.
    pub parent: Option<usize>,
    /// The joint between the parent and this link.
    pub joint: Joint,
    /// Inertia of the link and everything fixed to it.
    pub inertia: Inertia,
    /// What the actuator adds to the rigid-body torque.
    pub actuator: Actuator,
    /// Names of the links that were merged into this one.
    pub merged: Vec<String>,
}
