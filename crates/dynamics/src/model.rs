use nalgebra::{DVector, Matrix3, Vector3};
use robot::Robot;

use crate::link_in_base::LinkInBase;
use crate::spatial::{Force, Pose, RigidInertia, SpatialMotion};

/// A robot prepared for dynamics: constant transforms, axes and inertias of its tree.
///
/// Only the rigid bodies enter `M`, `C` and `g`; rotor inertias are kept beside
/// them ([`Dynamics::rotor_inertia`]), friction and springs are not represented.
#[derive(Debug, Clone)]
pub struct Dynamics {
    pub(crate) joints: Vec<JointModel>,
    pub(crate) gravity_in_base: Vector3<f64>,
    pub(crate) rotor_inertia: DVector<f64>,
}

/// One joint and the link it carries.
#[derive(Debug, Clone)]
pub(crate) struct JointModel {
    /// Slot of the parent in the workspace: 0 is the base, `i + 1` is link `i`.
    pub parent: usize,
    /// The motion of a unit of velocity, in the link's frame.
    pub axis: SpatialMotion,
    pub is_rotation: bool,
    /// Rotation of the link in its parent: `constant + cos(q) cosine + sin(q) sine`.
    constant: Matrix3<f64>,
    cosine: Matrix3<f64>,
    sine: Matrix3<f64>,
    /// Origin of the link in its parent: `origin + q slide`.
    origin: Vector3<f64>,
    slide: Vector3<f64>,
    pub inertia: RigidInertia,
}

/// Scratch memory of the loop versions, made once by [`Dynamics::workspace`].
#[derive(Debug, Clone)]
pub struct Workspace {
    /// Base first, then the links.
    pub(crate) links: Vec<LinkState>,
    /// Axis of joint `i` in the frame of link `j` at `j n + i`, for `i` at or above `j`.
    pub(crate) axes: Vec<SpatialMotion>,
    /// Inertia of each link with everything it carries, base first.
    pub(crate) composite: Vec<RigidInertia>,
    /// The links in the base frame, base first.
    pub(crate) in_base: Vec<LinkInBase>,
    /// Row-major n x n.
    pub(crate) matrix: Vec<f64>,
}

/// What the outward pass finds for one link, in the link's frame.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LinkState {
    /// Pose in the parent's frame.
    pub pose: Pose,
    /// Angular velocity.
    pub w: Vector3<f64>,
    /// Acceleration: angular, and of the link's origin relative to free fall.
    pub a: SpatialMotion,
    /// Wrench that the parent exerts on the link.
    pub f: Force,
}

impl Dynamics {
    /// Prepares a robot.
    pub fn new(robot: &Robot) -> Self {
        let joints = robot.links().iter().map(JointModel::new).collect();
        let rotors = robot.links().iter().map(|link| link.actuator.rotor_inertia);
        Self {
            joints,
            gravity_in_base: robot.gravity_in_base(),
            rotor_inertia: DVector::from_iterator(robot.joint_count(), rotors),
        }
    }

    /// Number of joints, and of moving links.
    pub fn joint_count(&self) -> usize {
        self.joints.len()
    }

    /// Scratch memory of the right size for this robot.
    pub fn workspace(&self) -> Workspace {
        let n = self.joint_count();
        let at_rest = LinkState {
            pose: Pose::identity(),
            w: Vector3::zeros(),
            a: SpatialMotion::zero(),
            f: Force::zero(),
        };
        let nothing =
            RigidInertia { mass: 0.0, h: Vector3::zeros(), about_origin: Matrix3::zeros() };
        Workspace {
            links: vec![at_rest; n + 1],
            axes: vec![SpatialMotion::zero(); n * n],
            composite: vec![nothing; n + 1],
            in_base: vec![LinkInBase::at_rest(); n + 1],
            matrix: vec![0.0; n * n],
        }
    }

    /// Acceleration of free fall in the base frame (m/s²).
    pub fn gravity_in_base(&self) -> Vector3<f64> {
        self.gravity_in_base
    }
}

impl JointModel {
    /// Rodrigues' formula with the constant parts multiplied out:
    ///
    /// ```text
    /// R(q) = R0 (a a' + cos(q) (1 - a a') + sin(q) [a]x)
    /// ```
    fn new(link: &robot::Link) -> Self {
        let joint = &link.joint;
        let axis = joint.axis_in_joint.into_inner();
        let r0 = joint.parent_from_joint.rotation.to_rotation_matrix().into_inner();
        let along = axis * axis.transpose();
        let zero = Matrix3::zeros();
        let is_rotation = joint.kind.is_rotation();
        let (constant, cosine, sine, slide, axis) = if is_rotation {
            let turned = r0 * (Matrix3::identity() - along);
            let axis = SpatialMotion { angular: axis, linear: Vector3::zeros() };
            (r0 * along, turned, r0 * axis.angular.cross_matrix(), Vector3::zeros(), axis)
        } else {
            let slide = r0 * axis;
            (r0, zero, zero, slide, SpatialMotion { angular: Vector3::zeros(), linear: axis })
        };
        Self {
            parent: link.parent.map_or(0, |p| p + 1),
            axis,
            is_rotation,
            constant,
            cosine,
            sine,
            origin: joint.parent_from_joint.translation.vector,
            slide,
            inertia: RigidInertia::new(&link.inertia),
        }
    }

    /// Pose of the link in its parent's frame at position `q`.
    #[inline(always)]
    pub fn pose(&self, q: f64) -> Pose {
        if self.is_rotation {
            let (sin, cos) = q.sin_cos();
            let rotation = self.constant + self.cosine * cos + self.sine * sin;
            Pose { rotation, origin: self.origin }
        } else {
            Pose { rotation: self.constant, origin: self.origin + q * self.slide }
        }
    }
}
