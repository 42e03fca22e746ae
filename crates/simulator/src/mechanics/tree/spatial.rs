use nalgebra::{Matrix3, Vector3};
use robot::Inertia;

/// A motion or a force with its angular part first, about the origin of the base and in its axes: the velocity of the
/// point of the body that is at the origin, or the moment about it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Spatial {
    pub angular: Vector3<f64>,
    pub linear: Vector3<f64>,
}

impl Spatial {
    pub fn zero() -> Self {
        Self { angular: Vector3::zeros(), linear: Vector3::zeros() }
    }

    pub fn dot(&self, other: &Self) -> f64 {
        self.angular.dot(&other.angular) + self.linear.dot(&other.linear)
    }

    pub fn add_scaled(&mut self, factor: f64, other: &Self) {
        self.angular += other.angular * factor;
        self.linear += other.linear * factor;
    }

    /// Rate of a motion that is carried along (Featherstone 2008, eq. 2.31):
    ///
    /// ```text
    /// v x m = (w x m_w, w x m_o + v_o x m_w)
    /// ```
    pub fn cross_motion(&self, motion: &Self) -> Self {
        Self {
            angular: self.angular.cross(&motion.angular),
            linear: self.angular.cross(&motion.linear) + self.linear.cross(&motion.angular),
        }
    }

    /// Rate of a momentum that is carried along (Featherstone 2008, eq. 2.32):
    ///
    /// ```text
    /// v x* p = (w x L + v_o x P, w x P)
    /// ```
    pub fn cross_force(&self, momentum: &Self) -> Self {
        Self {
            angular: self.angular.cross(&momentum.angular) + self.linear.cross(&momentum.linear),
            linear: self.angular.cross(&momentum.linear),
        }
    }
}

/// Inertia about the origin of the base, in its axes.
#[derive(Debug, Clone, Copy)]
pub(super) struct SpatialInertia {
    mass: f64,
    /// `m c` (kg m).
    moment: Vector3<f64>,
    /// `I_c + m (c.c 1 - c c^T)` (kg m²).
    about_base: Matrix3<f64>,
}

impl SpatialInertia {
    pub fn zero() -> Self {
        Self { mass: 0.0, moment: Vector3::zeros(), about_base: Matrix3::zeros() }
    }

    /// Inertia of a body whose frame has this place in the base.
    pub fn of(body: &Inertia, rotation: &Matrix3<f64>, origin: &Vector3<f64>) -> Self {
        let com = origin + rotation * body.com_in_link;
        let moment = com * body.mass;
        let mut about_base = rotation * body.about_com * rotation.transpose();
        about_base -= moment * com.transpose();
        let square = moment.dot(&com);
        for axis in 0..3 {
            about_base[(axis, axis)] += square;
        }
        Self { mass: body.mass, moment, about_base }
    }

    pub fn add(&mut self, other: &Self) {
        self.mass += other.mass;
        self.moment += other.moment;
        self.about_base += other.about_base;
    }

    /// Momentum under a motion:
    ///
    /// ```text
    /// L = I_o w + m c x v_o,    P = m v_o - m c x w
    /// ```
    pub fn times(&self, motion: &Spatial) -> Spatial {
        Spatial {
            angular: self.about_base * motion.angular + self.moment.cross(&motion.linear),
            linear: motion.linear * self.mass - self.moment.cross(&motion.angular),
        }
    }
}
