use nalgebra::{Matrix3, Vector3};
use robot::Inertia;

use crate::mechanics::engine::{EngineBody, Push};
use crate::mechanics::tree::spatial::{Spatial, SpatialInertia};

/// The bodies of a tree, their mass matrix and their bias forces at one state:
///
/// ```text
/// M(q) qdd + bias(q, qd) = effort,    bias = C(q, qd) qd + g(q) - pushes
/// ```
///
/// Motions and forces of all bodies are written about the origin of the base, where those of neighbours add up without
/// a transform: the bias by the recursion of Newton and Euler, the matrix from composite bodies (Featherstone 2008,
/// tables 5.1 and 6.2).
pub(super) struct Bodies {
    constants: Vec<Constants>,
    moving: Vec<Moving>,
    gravity_in_base: Vector3<f64>,
    /// Lower triangle of `M`, row by row; no element between branches is ever set.
    mass: Vec<f64>,
    bias: Vec<f64>,
}

/// What stays of a body.
struct Constants {
    parent: Option<usize>,
    turns: bool,
    /// Rotation of the body in its parent at `q`: `still + sin(q) sine + cos(q) cosine`.
    still: Matrix3<f64>,
    sine: Matrix3<f64>,
    cosine: Matrix3<f64>,
    origin_in_parent: Vector3<f64>,
    axis_in_parent: Vector3<f64>,
    inertia: Option<Inertia>,
    armature: f64,
}

/// What moves of a body, in the frame of the base.
#[derive(Clone, Copy)]
struct Moving {
    rotation: Matrix3<f64>,
    origin: Vector3<f64>,
    axis: Spatial,
    velocity: Spatial,
    acceleration: Spatial,
    force: Spatial,
    /// Of the body alone, then with all that it carries.
    inertia: SpatialInertia,
}

impl Bodies {
    /// Parents come before their children; `None` for a parent that does not.
    pub fn new(bodies: &[EngineBody], gravity_in_base: Vector3<f64>) -> Option<Self> {
        let ordered = bodies.iter().enumerate().all(|(i, b)| b.parent.is_none_or(|p| p < i));
        let count = bodies.len();
        let at_rest = Moving {
            rotation: Matrix3::identity(),
            origin: Vector3::zeros(),
            axis: Spatial::zero(),
            velocity: Spatial::zero(),
            acceleration: Spatial::zero(),
            force: Spatial::zero(),
            inertia: SpatialInertia::zero(),
        };
        (ordered && count > 0).then(|| Self {
            constants: bodies.iter().map(Constants::of).collect(),
            moving: vec![at_rest; count],
            gravity_in_base,
            mass: vec![0.0; count * count],
            bias: vec![0.0; count],
        })
    }

    pub fn count(&self) -> usize {
        self.constants.len()
    }

    /// Lower triangle of the mass matrix (kg m² and the like), row by row.
    pub fn mass(&self) -> &[f64] {
        &self.mass
    }

    /// Bias forces (N m or N).
    pub fn bias(&self) -> &[f64] {
        &self.bias
    }

    /// Works out matrix and bias at a state.
    pub fn place(&mut self, q: &[f64], qd: &[f64], pushes: &[Push]) {
        for i in 0..self.count() {
            self.move_body(i, q[i], qd[i]);
        }
        for push in pushes {
            let Some(body) = self.moving.get_mut(push.body) else { continue };
            let point = body.origin + body.rotation * push.point_in_body;
            body.force.angular -= point.cross(&push.force_in_base);
            body.force.linear -= push.force_in_base;
        }
        for i in (0..self.count()).rev() {
            self.gather(i);
        }
    }

    /// Pose, velocity and acceleration without `qdd` of body `i`, and the force that they need:
    ///
    /// ```text
    /// v = v_p + s qd,    a = a_p + v x s qd,    f = I a + v x* I v
    /// ```
    ///
    /// The base accelerates against gravity.
    fn move_body(&mut self, i: usize, q: f64, qd: f64) {
        let fixed = &self.constants[i];
        let (rotation, origin, velocity, acceleration) = match fixed.parent {
            Some(p) => {
                let p = &self.moving[p];
                (p.rotation, p.origin, p.velocity, p.acceleration)
            }
            None => {
                let lift = Spatial { angular: Vector3::zeros(), linear: -self.gravity_in_base };
                (Matrix3::identity(), Vector3::zeros(), Spatial::zero(), lift)
            }
        };
        let axis_in_base = rotation * fixed.axis_in_parent;
        let body = &mut self.moving[i];
        body.origin = origin + rotation * fixed.origin_in_parent;
        if fixed.turns {
            let (sin, cos) = q.sin_cos();
            body.rotation = rotation * (fixed.still + fixed.sine * sin + fixed.cosine * cos);
            body.axis = Spatial { angular: axis_in_base, linear: body.origin.cross(&axis_in_base) };
        } else {
            body.rotation = rotation * (fixed.still + fixed.cosine);
            body.origin += axis_in_base * q;
            body.axis = Spatial { angular: Vector3::zeros(), linear: axis_in_base };
        }
        body.velocity = velocity;
        body.velocity.add_scaled(qd, &body.axis);
        body.acceleration = acceleration;
        body.acceleration.add_scaled(qd, &body.velocity.cross_motion(&body.axis));
        match &fixed.inertia {
            Some(inertia) => {
                body.inertia = SpatialInertia::of(inertia, &body.rotation, &body.origin);
                body.force = body.inertia.times(&body.acceleration);
                let momentum = body.inertia.times(&body.velocity);
                body.force.add_scaled(1.0, &body.velocity.cross_force(&momentum));
            }
            None => {
                body.inertia = SpatialInertia::zero();
                body.force = Spatial::zero();
            }
        }
    }

    /// Row `i` of matrix and bias from the body and all that it carries, which is then handed to its parent:
    ///
    /// ```text
    /// bias_i = s_i . f,    M_ij = s_j . I s_i    for j = i and the bodies that carry i
    /// ```
    fn gather(&mut self, i: usize) {
        let Moving { axis, force, inertia, .. } = self.moving[i];
        self.bias[i] = axis.dot(&force);
        let momentum = inertia.times(&axis);
        let row = i * self.count();
        self.mass[row + i] = axis.dot(&momentum) + self.constants[i].armature;
        let mut carrier = self.constants[i].parent;
        while let Some(j) = carrier {
            self.mass[row + j] = self.moving[j].axis.dot(&momentum);
            carrier = self.constants[j].parent;
        }
        if let Some(parent) = self.constants[i].parent {
            self.moving[parent].force.add_scaled(1.0, &force);
            self.moving[parent].inertia.add(&inertia);
        }
    }
}

impl Constants {
    /// ```text
    /// R(q) = R_p (1 + sin(q) K + (1 - cos(q)) K²),    K = axis x
    /// ```
    fn of(body: &EngineBody) -> Self {
        let parent_from_body = body.parent_from_body.rotation.to_rotation_matrix().into_inner();
        let cross = body.axis.cross_matrix();
        let square = parent_from_body * cross * cross;
        Self {
            parent: body.parent,
            turns: body.turns,
            still: parent_from_body + square,
            sine: parent_from_body * cross,
            cosine: -square,
            origin_in_parent: body.parent_from_body.translation.vector,
            axis_in_parent: parent_from_body * body.axis.into_inner(),
            inertia: body.inertia.clone(),
            armature: body.armature,
        }
    }
}
