//! Spatial vectors, angular part first, as two plain vectors each.
//!
//! Featherstone, *Rigid Body Dynamics Algorithms*, Springer 2008, chapter 2.

use nalgebra::{Matrix3, Vector3};

/// A motion: angular part and the linear part at the origin of the frame it is written in.
#[derive(Debug, Clone, Copy)]
pub(crate) struct SpatialMotion {
    pub angular: Vector3<f64>,
    pub linear: Vector3<f64>,
}

/// A wrench: moment about the origin of the frame it is written in, and force.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Force {
    pub angular: Vector3<f64>,
    pub linear: Vector3<f64>,
}

/// Pose of a link in its parent's frame: `x_in_parent = rotation x_in_link + origin`.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Pose {
    pub rotation: Matrix3<f64>,
    pub origin: Vector3<f64>,
}

/// Inertia about the origin of a frame: mass, first moment `h = m c`, second moment.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RigidInertia {
    pub mass: f64,
    pub h: Vector3<f64>,
    pub about_origin: Matrix3<f64>,
}

/// `r v`, written out: the hot loops live on it.
#[inline(always)]
pub(crate) fn multiply(r: &Matrix3<f64>, v: &Vector3<f64>) -> Vector3<f64> {
    Vector3::new(
        r.m11 * v.x + r.m12 * v.y + r.m13 * v.z,
        r.m21 * v.x + r.m22 * v.y + r.m23 * v.z,
        r.m31 * v.x + r.m32 * v.y + r.m33 * v.z,
    )
}

/// `r' v`.
#[inline(always)]
pub(crate) fn multiply_transposed(r: &Matrix3<f64>, v: &Vector3<f64>) -> Vector3<f64> {
    Vector3::new(
        r.m11 * v.x + r.m21 * v.y + r.m31 * v.z,
        r.m12 * v.x + r.m22 * v.y + r.m32 * v.z,
        r.m13 * v.x + r.m23 * v.y + r.m33 * v.z,
    )
}

impl SpatialMotion {
    pub fn zero() -> Self {
        Self { angular: Vector3::zeros(), linear: Vector3::zeros() }
    }

    #[inline(always)]
    pub fn add(&mut self, other: &SpatialMotion) {
        self.angular += other.angular;
        self.linear += other.linear;
    }

    #[inline(always)]
    pub fn times(&self, by: f64) -> Self {
        Self { angular: self.angular * by, linear: self.linear * by }
    }

    /// Rate of a motion `m` that is fixed in a frame that moves as this one says, `v x m`.
    #[inline(always)]
    pub fn cross(&self, m: &SpatialMotion) -> SpatialMotion {
        SpatialMotion {
            angular: self.angular.cross(&m.angular),
            linear: self.angular.cross(&m.linear) + self.linear.cross(&m.angular),
        }
    }

    /// The same of a wrench, `v x* f`.
    #[inline(always)]
    pub fn cross_force(&self, f: &Force) -> Force {
        Force {
            angular: self.angular.cross(&f.angular) + self.linear.cross(&f.linear),
            linear: self.angular.cross(&f.linear),
        }
    }

    /// Power of a unit of this motion against the wrench `f`, both in one frame.
    #[inline(always)]
    pub fn dot(&self, f: &Force) -> f64 {
        self.angular.dot(&f.angular) + self.linear.dot(&f.linear)
    }
}

impl Force {
    pub fn zero() -> Self {
        Self { angular: Vector3::zeros(), linear: Vector3::zeros() }
    }

    #[inline(always)]
    pub fn add(&mut self, other: &Force) {
        self.angular += other.angular;
        self.linear += other.linear;
    }
}

impl Pose {
    pub fn identity() -> Self {
        Self { rotation: Matrix3::identity(), origin: Vector3::zeros() }
    }

    /// A motion written in the parent's frame, written in the link's.
    #[inline(always)]
    pub fn motion_to_link(&self, m: &SpatialMotion) -> SpatialMotion {
        SpatialMotion {
            angular: multiply_transposed(&self.rotation, &m.angular),
            linear: multiply_transposed(
                &self.rotation,
                &(m.linear + m.angular.cross(&self.origin)),
            ),
        }
    }

    /// A motion written in the link's frame, written in the parent's.
    #[inline(always)]
    pub fn motion_to_parent(&self, m: &SpatialMotion) -> SpatialMotion {
        let angular = multiply(&self.rotation, &m.angular);
        let linear = multiply(&self.rotation, &m.linear) + self.origin.cross(&angular);
        SpatialMotion { angular, linear }
    }

    /// Pose of a link in this frame's parent, whose pose in this frame is `link`.
    #[inline(always)]
    pub fn then(&self, link: &Pose) -> Pose {
        Pose {
            rotation: self.rotation * link.rotation,
            origin: self.origin + multiply(&self.rotation, &link.origin),
        }
    }

    /// A wrench written in the link's frame, written in the parent's.
    #[inline(always)]
    pub fn force_to_parent(&self, f: &Force) -> Force {
        let linear = multiply(&self.rotation, &f.linear);
        let angular = multiply(&self.rotation, &f.angular) + self.origin.cross(&linear);
        Force { angular, linear }
    }

    /// An inertia about the link's origin, written about the parent's.
    ///
    /// ```text
    /// I' = R I R' + 2 (p.Rh) 1 - (p (Rh)' + Rh p') + m (p.p 1 - p p'),   h' = R h + m p
    /// ```
    pub fn inertia_to_parent(&self, inertia: &RigidInertia) -> RigidInertia {
        let (r, p, m) = (&self.rotation, &self.origin, inertia.mass);
        let h = multiply(r, &inertia.h);
        let moved = h + m * p;
        let trace = p.dot(&h) + p.dot(&moved);
        let about_origin = r * inertia.about_origin * r.transpose()
            + Matrix3::from_diagonal_element(trace)
            - p * moved.transpose()
            - h * p.transpose();
        RigidInertia { mass: m, h: moved, about_origin }
    }
}

impl RigidInertia {
    pub fn new(inertia: &robot::Inertia) -> Self {
        let [mass, hx, hy, hz, ixx, ixy, iyy, ixz, iyz, izz] = inertia.parameters();
        let about_origin = Matrix3::new(ixx, ixy, ixz, ixy, iyy, iyz, ixz, iyz, izz);
        Self { mass, h: Vector3::new(hx, hy, hz), about_origin }
    }

    /// Wrench that gives the resting body the acceleration `a`.
    #[inline(always)]
    pub fn apply(&self, a: &SpatialMotion) -> Force {
        Force {
            angular: multiply(&self.about_origin, &a.angular) + self.h.cross(&a.linear),
            linear: self.mass * a.linear + a.angular.cross(&self.h),
        }
    }

    pub fn add(&mut self, other: &RigidInertia) {
        self.mass += other.mass;
        self.h += other.h;
        self.about_origin += other.about_origin;
    }
}
