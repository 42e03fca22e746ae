use nalgebra::{Matrix3, Vector3};

use crate::spatial::{Force, Pose, RigidInertia, SpatialMotion, multiply, multiply_transposed};

/// One link in the base frame, all about the origin of that frame.
#[derive(Debug, Clone, Copy)]
pub(crate) struct LinkInBase {
    pub pose: Pose,
    /// Motion of a unit of velocity of the joint that carries the link.
    pub s: SpatialMotion,
    pub v: SpatialMotion,
    /// Acceleration relative to free fall.
    pub a: SpatialMotion,
    /// Change of `s` as the link moves, `v x s`.
    pub s_rate: SpatialMotion,
    /// Change of the acceleration by the joint's position, `a_parent x s + v_parent x (v_parent x s)`.
    pub a_by_q: SpatialMotion,
    /// Inertia, momentum's change by velocity and wrench, of the link with all it carries.
    pub inertia: RigidInertia,
    pub change: VelocityChange,
    pub f: Force,
}

/// The derivative of a wrench by velocity, without the turning of the inertia itself,
///
/// ```text
/// B = (v x*) I - I (v x) + (. x* I v) = [ T, 0; -2 [l]x, 0 ]
/// T = [w]x I - I [w]x - h v' - v h' + 2 (v.h) 1 - [I w + h x v]x,   l = m v + w x h
/// ```
///
/// angular part first, with `w`, `v` the velocity, `h` the first and `I` the second moment.
#[derive(Debug, Clone, Copy)]
pub(crate) struct VelocityChange {
    pub t: Matrix3<f64>,
    pub l: Vector3<f64>,
}

impl VelocityChange {
    #[inline(always)]
    pub fn of(inertia: &RigidInertia, velocity: &SpatialMotion) -> Self {
        let RigidInertia { mass, h, about_origin } = inertia;
        let SpatialMotion { angular: w, linear: v } = velocity;
        let turned = w.cross_matrix() * about_origin;
        let moment = multiply(about_origin, w) + h.cross(v);
        // I [w]x is the negative transpose of [w]x I.
        let t = turned + turned.transpose() - h * v.transpose() - v * h.transpose()
            + Matrix3::from_diagonal_element(2.0 * v.dot(h))
            - moment.cross_matrix();
        Self { t, l: v * *mass + w.cross(h) }
    }

    /// `B m`.
    #[inline(always)]
    pub fn apply(&self, m: &SpatialMotion) -> Force {
        Force { angular: multiply(&self.t, &m.angular), linear: self.l.cross(&m.angular) * -2.0 }
    }

    /// `B' m`, of which the linear part is zero.
    #[inline(always)]
    pub fn apply_transposed(&self, m: &SpatialMotion) -> Vector3<f64> {
        multiply_transposed(&self.t, &m.angular) + self.l.cross(&m.linear) * 2.0
    }
}

impl LinkInBase {
    pub fn at_rest() -> Self {
        let zero = Vector3::zeros();
        Self {
            pose: Pose::identity(),
            s: SpatialMotion::zero(),
            v: SpatialMotion::zero(),
            a: SpatialMotion::zero(),
            s_rate: SpatialMotion::zero(),
            a_by_q: SpatialMotion::zero(),
            inertia: RigidInertia { mass: 0.0, h: zero, about_origin: Matrix3::zeros() },
            change: VelocityChange { t: Matrix3::zeros(), l: zero },
            f: Force::zero(),
        }
    }
}
