use nalgebra::{Isometry3, Translation3, Unit, UnitQuaternion, Vector3};

/// How a joint moves.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum JointKind {
    /// Rotation between two limits (rad).
    Revolute,
    /// Rotation without limits (rad).
    Continuous,
    /// Translation between two limits (m).
    Prismatic,
}

impl JointKind {
    /// Whether positions are angles (rad) and torques are N·m, rather than m and N.
    pub fn is_rotation(self) -> bool {
        !matches!(self, Self::Prismatic)
    }
}

/// Limits of a joint, where they are known.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub struct Limits {
    /// Lowest and highest position (rad or m).
    pub position: Option<(f64, f64)>,
    /// Largest speed (rad/s or m/s).
    pub velocity: Option<f64>,
    /// Largest torque or force (N·m or N).
    pub effort: Option<f64>,
}

/// A joint with one degree of freedom, between a link and its parent.
#[derive(Debug, Clone, PartialEq)]
pub struct Joint {
    /// Name, by which logs and files refer to it.
    pub name: String,
    /// How it moves.
    pub kind: JointKind,
    /// Pose of the joint frame in the parent link's frame at position zero.
    pub parent_from_joint: Isometry3<f64>,
    /// Axis of motion in the joint frame.
    pub axis_in_joint: Unit<Vector3<f64>>,
    /// Its limits.
    pub limits: Limits,
}

impl Joint {
    /// Pose of the child link in the parent link's frame at position `q` (rad or m).
    pub fn parent_from_child(&self, q: f64) -> Isometry3<f64> {
        let motion = if self.kind.is_rotation() {
            let rotation = UnitQuaternion::from_axis_angle(&self.axis_in_joint, q);
            Isometry3::from_parts(Translation3::identity(), rotation)
        } else {
            Isometry3::from_parts(
                Translation3::from(self.axis_in_joint.into_inner() * q),
                UnitQuaternion::identity(),
            )
        };
        self.parent_from_joint * motion
    }
}
