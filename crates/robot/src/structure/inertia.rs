use std::fmt;

use nalgebra::{Isometry3, Matrix3, Matrix4, SymmetricEigen, Vector3};

/// Share of the trace that is a rounding error of the file (1).
const ROUNDING: f64 = 1e-6;

/// Radius of gyration up to which a body is a point mass with rounding errors (m).
const POINT_M: f64 = 1e-6;

/// Inertia of one moving body: the link and everything fixed to it.
#[derive(Debug, Clone, PartialEq)]
pub struct Inertia {
    /// Mass (kg).
    pub mass: f64,
    /// Centre of mass in the link frame (m).
    pub com_in_link: Vector3<f64>,
    /// Rotational inertia about the centre of mass, link axes (kg m²).
    pub about_com: Matrix3<f64>,
}

/// A way in which an inertia contradicts physics.
#[derive(Debug, Clone, PartialEq)]
pub enum InertiaDefect {
    /// Mass is zero or negative (kg).
    MassNotPositive(f64),
    /// The smallest principal moment of inertia is negative (kg m²).
    NegativeMoment(f64),
    /// Largest principal moment minus the sum of the other two is positive (kg m²):
    /// no distribution of mass has such an inertia.
    TriangleInequality(f64),
}

impl fmt::Display for InertiaDefect {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        match self {
            Self::MassNotPositive(mass) => {
                write!(f, "mass is {mass} kg, a positive number was expected")
            }
            Self::NegativeMoment(smallest) => write!(
                f,
                "smallest principal moment of inertia is {smallest:.3e} kg m², \
                 a number not below 0 was expected"
            ),
            Self::TriangleInequality(excess) => write!(
                f,
                "largest principal moment of inertia exceeds the sum of the other two by \
                 {excess:.3e} kg m², no body has such an inertia"
            ),
        }
    }
}

impl Inertia {
    /// Zero mass and zero inertia.
    pub fn zero() -> Self {
        Self { mass: 0.0, com_in_link: Vector3::zeros(), about_com: Matrix3::zeros() }
    }

    /// The ten inertial parameters about the link origin, in Pinocchio's order:
    ///
    /// ```text
    /// pi = [m, m cx, m cy, m cz, Ixx, Ixy, Iyy, Ixz, Iyz, Izz]
    /// I_origin = I_com + m (c'c 1 - c c')
    /// ```
    pub fn parameters(&self) -> [f64; 10] {
        let c = self.com_in_link;
        let h = self.mass * c;
        let i = self.about_com + self.mass * (Matrix3::identity() * c.dot(&c) - c * c.transpose());
        [self.mass, h.x, h.y, h.z, i.m11, i.m12, i.m22, i.m13, i.m23, i.m33]
    }

    /// The inertia with the given ten parameters (see [`Inertia::parameters`]).
    ///
    /// With a mass of zero the centre of mass is put at the link origin.
    pub fn from_parameters(pi: &[f64; 10]) -> Self {
        let [mass, hx, hy, hz, ixx, ixy, iyy, ixz, iyz, izz] = *pi;
        let c = if mass.abs() > 0.0 { Vector3::new(hx, hy, hz) / mass } else { Vector3::zeros() };
        let at_origin = Matrix3::new(ixx, ixy, ixz, ixy, iyy, iyz, ixz, iyz, izz);
        let about_com = at_origin - mass * (Matrix3::identity() * c.dot(&c) - c * c.transpose());
        Self { mass, com_in_link: c, about_com }
    }

    /// The same body, expressed in another frame.
    ///
    /// ```text
    /// c' = R c + p,  I' = R I R'     with (R, p) = new_from_old
    /// ```
    pub fn in_frame(&self, new_from_old: &Isometry3<f64>) -> Self {
        let r = new_from_old.rotation.to_rotation_matrix().into_inner();
        let turned = r * self.about_com * r.transpose();
        Self {
            mass: self.mass,
            com_in_link: r * self.com_in_link + new_from_old.translation.vector,
            about_com: 0.5 * (turned + turned.transpose()),
        }
    }

    /// Both bodies as one rigid body, in their common frame (parallel-axis theorem).
    ///
    /// ```text
    /// m = m1 + m2,  c = (m1 c1 + m2 c2) / m,  d = c2 - c1
    /// I = I1 + I2 + (m1 m2 / m) (d'd 1 - d d')
    /// ```
    pub fn with_body(&self, other: &Self) -> Self {
        let mass = self.mass + other.mass;
        if mass.abs() <= 0.0 {
            return Self { about_com: self.about_com + other.about_com, ..self.clone() };
        }
        let d = other.com_in_link - self.com_in_link;
        let reduced = self.mass * other.mass / mass;
        let parallel = reduced * (Matrix3::identity() * d.dot(&d) - d * d.transpose());
        Self {
            mass,
            com_in_link: self.com_in_link + d * (other.mass / mass),
            about_com: self.about_com + other.about_com + parallel,
        }
    }

    /// Adds a body that is fixed to this one. Adding to [`zero`](Self::zero) copies it without rounding.
    pub(crate) fn add(&mut self, part: &Self) {
        *self = if *self == Self::zero() { part.clone() } else { self.with_body(part) };
    }

    /// The pseudo-inertia about the link origin, positive definite exactly when the
    /// inertia is physical (Wensing, Kim & Slotine 2018):
    ///
    /// ```text
    /// J = [ S  h ]     S = tr(I_origin)/2 1 - I_origin,  h = m c
    ///     [ h' m ]
    /// ```
    pub fn pseudo_inertia(&self) -> Matrix4<f64> {
        let [m, hx, hy, hz, ixx, ixy, iyy, ixz, iyz, izz] = self.parameters();
        let half = 0.5 * (ixx + iyy + izz);
        #[rustfmt::skip]
        let j = Matrix4::new(
            half - ixx, -ixy,       -ixz,       hx,
            -ixy,       half - iyy, -iyz,       hy,
            -ixz,       -iyz,       half - izz, hz,
            hx,         hy,         hz,         m,
        );
        j
    }

    /// Every way in which this inertia contradicts physics; empty when it is sound.
    ///
    /// ```text
    /// m > 0,   I1 >= -e,   I3 - I1 - I2 <= e          principal moments I1 <= I2 <= I3
    /// e = 1e-6 |I1 + I2 + I3| + m (1e-6 m)²           rounding of the file is no defect
    /// ```
    ///
    /// A thin rod (`I1 = 0`) and a point mass (all three are 0) are sound.
    pub fn defects(&self) -> Vec<InertiaDefect> {
        let mut defects = Vec::new();
        if self.mass <= 0.0 {
            defects.push(InertiaDefect::MassNotPositive(self.mass));
        }
        let moments = SymmetricEigen::new(self.about_com).eigenvalues;
        let (smallest, largest) = (moments.min(), moments.max());
        let rounding = ROUNDING * moments.sum().abs() + self.mass.abs() * POINT_M * POINT_M;
        if smallest < -rounding {
            defects.push(InertiaDefect::NegativeMoment(smallest));
        }
        let excess = 2.0 * largest - moments.sum();
        if excess > rounding {
            defects.push(InertiaDefect::TriangleInequality(excess));
        }
        defects
    }

    /// Whether the inertia is sound and each of its principal moments is above zero, as engines ask for.
    pub fn is_positive_definite(&self) -> bool {
        let moments = SymmetricEigen::new(self.about_com).eigenvalues;
        moments.min() > 0.0 && self.defects().is_empty()
    }
}
