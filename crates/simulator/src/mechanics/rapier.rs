use nalgebra::{DVector, Isometry3, Rotation3, SymmetricEigen, UnitQuaternion, Vector3};
use rapier3d_f64::parry::mass_properties::MassProperties;
use rapier3d_f64::prelude::{
    ColliderSet, GenericJoint, JointAxesMask, Multibody, MultibodyJointHandle, PhysicsWorld, Pose,
    RigidBodyBuilder, RigidBodyHandle, Rotation, Vector,
};
use robot::Inertia;

use crate::mechanics::engine::{Engine, EngineBody, Load};

/// Stiffness of the spring that carries a torque into the engine (N·m/rad): with its rest
/// position at `tau / CARRIER` the spring's torque is `tau`, a pure generalised force. A power
/// of two, so that the quotient is exact, and so small that the position adds 1e-12 of itself.
const CARRIER: f64 = 1.0 / (1_u64 << 40) as f64;

/// Sweeps of the engine's solver over the rows of friction and stops. Below about 20 coupled
/// joints creep where they should stick; 50 holds a loaded arm to 5e-9 rad in 8 s.
const SOLVER_SWEEPS: usize = 50;

/// A tree of bodies on rapier's reduced coordinates, stepped as a leapfrog.
///
/// Rapier steps `v += dt a(q, v)`, then `q += dt v`. Read as
///
/// ```text
/// v(k+1/2) = v(k-1/2) + dt a(k),    q(k+1) = q(k) + dt v(k+1/2)
/// ```
///
/// the same step is ten times closer to the true motion than with `v` taken at the ends: the
/// velocity in the engine belongs half a step before the position. `qd` gives the velocity at
/// the time of the position, `v(k-1/2) + dt/2 a(k-1)`.
pub(crate) struct RapierEngine {
    world: PhysicsWorld,
    multibody: MultibodyJointHandle,
    bodies: Vec<RigidBodyHandle>,
    /// Place of each degree of freedom in the engine's vectors.
    place: Vec<usize>,
    /// Number of each body's link in the multibody.
    link: Vec<usize>,
    /// Spatial axis of each degree of freedom: 0 slides along x, 3 turns about x.
    axis: Vec<usize>,
    stops: Vec<Option<(f64, f64)>>,
    step_s: f64,
    q: Vec<f64>,
    qd: Vec<f64>,
    qdd: Vec<f64>,
    /// The engine's velocity belongs to the time of the position, not half a step before.
    fresh: bool,
    pushed: bool,
}

impl RapierEngine {
    /// Builds the tree at rest at position zero; parents come before their children.
    pub fn new(bodies: &[EngineBody], gravity_in_base: Vector3<f64>, step_s: f64) -> Option<Self> {
        let mut world = PhysicsWorld::new();
        world.gravity = vector(&gravity_in_base);
        let parameters = &mut world.integration_parameters;
        parameters.dt = step_s;
        parameters.num_solver_iterations = 1;
        parameters.num_internal_pgs_iterations = SOLVER_SWEEPS;
        parameters.num_internal_stabilization_iterations = 1;
        parameters.max_ccd_substeps = 0;
        parameters.normalized_max_linear_velocity = f64::MAX;
        let base = world.bodies.insert(RigidBodyBuilder::fixed());
        let mut handles: Vec<RigidBodyHandle> = Vec::with_capacity(bodies.len());
        let mut last = None;
        for body in bodies {
            let handle = world.bodies.insert(rigid_body(body));
            let parent = body.parent.and_then(|p| handles.get(p).copied()).unwrap_or(base);
            last = world.multibody_joints.insert(parent, handle, joint(body), true);
            handles.push(handle);
        }
        let multibody = last?;
        let mut links = Vec::with_capacity(handles.len());
        for handle in &handles {
            links.push(world.multibody_joints.rigid_body_link(*handle)?.id);
        }
        let count = bodies.len();
        let mut engine = Self {
            world,
            multibody,
            bodies: handles,
            place: vec![0; count],
            link: links,
            axis: bodies.iter().map(|b| if b.turns { 3 } else { 0 }).collect(),
            stops: bodies.iter().map(|b| b.stops).collect(),
            step_s,
            q: vec![0.0; count],
            qd: vec![0.0; count],
            qdd: vec![0.0; count],
            fresh: true,
            pushed: false,
        };
        engine.prepare_bodies(bodies)?;
        Some(engine)
    }

    /// Gives the fixed root its place, takes rapier's default damping away and adds armatures.
    fn prepare_bodies(&mut self, bodies: &[EngineBody]) -> Option<()> {
        let PhysicsWorld { bodies: rigid, multibody_joints, .. } = &mut self.world;
        for handle in &self.bodies {
            rigid.get_mut(*handle)?.recompute_mass_properties_from_colliders(&ColliderSet::new());
        }
        let (multibody, _) = multibody_joints.get_mut(self.multibody)?;
        multibody.forward_kinematics(rigid, true);
        multibody.damping_mut().fill(0.0);
        for (i, body) in bodies.iter().enumerate() {
            self.place[i] = multibody.link(self.link[i])?.assembly_id();
            multibody.armature_mut()[self.place[i]] = body.armature;
        }
        Some(())
    }

    fn place_state(&mut self, q: &[f64], qd: &[f64]) {
        let PhysicsWorld { bodies, multibody_joints, .. } = &mut self.world;
        let Some((multibody, _)) = multibody_joints.get_mut(self.multibody) else { return };
        let mut displacement = vec![0.0; q.len()];
        for (i, position) in q.iter().enumerate() {
            displacement[self.place[i]] =
                position - coordinate(multibody, self.link[i], self.axis[i]);
        }
        multibody.apply_displacements(&displacement);
        for (&place, &velocity) in self.place.iter().zip(qd) {
            multibody.generalized_velocity_mut()[place] = velocity;
        }
        multibody.forward_kinematics(bodies, false);
        multibody.update_rigid_bodies(bodies, true);
    }

    /// Moves the velocity back by `dt/2 a`, with `a` from a trial step.
    fn rewind_half_a_step(&mut self, load: &Load) {
        let (q, qd) = (self.q.clone(), self.qd.clone());
        self.advance(load);
        let half = 0.5 * self.step_s;
        let earlier: Vec<f64> = qd.iter().zip(&self.qdd).map(|(v, a)| v - half * a).collect();
        self.place_state(&q, &earlier);
        self.fresh = false;
    }

    /// Steps the engine and stores the resulting acceleration.
    fn advance(&mut self, load: &Load) {
        self.push(load);
        let Some((multibody, _)) = self.world.multibody_joints.get_mut(self.multibody) else {
            return;
        };
        let mut rows = load.dry.iter().any(|dry| *dry > 0.0);
        for (i, &effort) in load.effort.iter().enumerate() {
            let Some(link) = multibody.link_mut(self.link[i]) else { continue };
            link.joint.set_spring(self.axis[i], CARRIER, effort / CARRIER);
            // The engine gives every stop a row of its solver, touched or not.
            let beyond = self.stops[i].is_some_and(|(min, max)| !(min..=max).contains(&self.q[i]));
            let axis = JointAxesMask::from_bits_truncate(1 << self.axis[i]);
            link.joint.data.limit_axes.set(axis, beyond);
            rows |= beyond;
        }
        let sweeps = if rows { SOLVER_SWEEPS } else { 1 };
        self.world.integration_parameters.num_internal_pgs_iterations = sweeps;
        for i in 0..self.place.len() {
            multibody.frictions_mut()[self.place[i]] = load.dry[i];
            multibody.damping_mut()[self.place[i]] = load.damping[i];
            self.qdd[i] = -multibody.generalized_velocity()[self.place[i]];
        }
        self.world.step();
        let Some((multibody, _)) = self.world.multibody_joints.get(self.multibody) else { return };
        let velocity = multibody.generalized_velocity();
        for i in 0..self.place.len() {
            self.qdd[i] = (self.qdd[i] + velocity[self.place[i]]) / self.step_s;
        }
    }

    fn push(&mut self, load: &Load) {
        if self.pushed {
            for handle in &self.bodies {
                if let Some(body) = self.world.bodies.get_mut(*handle) {
                    body.reset_forces(false);
                    body.reset_torques(false);
                }
            }
        }
        self.pushed = !load.pushes.is_empty();
        for push in &load.pushes {
            let Some(handle) = self.bodies.get(push.body) else { continue };
            if let Some(body) = self.world.bodies.get_mut(*handle) {
                let point = body.position() * vector(&push.point_in_body);
                body.add_force_at_point(vector(&push.force_in_base), point, true);
            }
        }
    }
}

impl Engine for RapierEngine {
    fn q(&self) -> &[f64] {
        &self.q
    }

    fn qd(&self) -> &[f64] {
        &self.qd
    }

    fn qdd(&self) -> &[f64] {
        &self.qdd
    }

    fn step_s(&self) -> f64 {
        self.step_s
    }

    fn set_state(&mut self, q: &[f64], qd: &[f64]) {
        self.place_state(q, qd);
        self.q.copy_from_slice(q);
        self.qd.copy_from_slice(qd);
        self.qdd.fill(0.0);
        self.fresh = true;
    }

    fn step(&mut self, load: &Load) {
        if self.fresh {
            self.rewind_half_a_step(load);
        }
        self.advance(load);
        let half = 0.5 * self.step_s;
        let Some((multibody, _)) = self.world.multibody_joints.get(self.multibody) else { return };
        let velocity = multibody.generalized_velocity();
        for i in 0..self.q.len() {
            self.q[i] = coordinate(multibody, self.link[i], self.axis[i]);
            self.qd[i] = velocity[self.place[i]] + half * self.qdd[i];
        }
    }

    /// Generalised force of friction and stops over the last step (N m or N):
    ///
    /// ```text
    /// constraint = M (dv/dt - a)
    /// ```
    ///
    /// with `M` and `a` the mass matrix and acceleration of the step before any constraint.
    fn constraint_effort(&self, effort: &mut [f64]) {
        let Some((multibody, _)) = self.world.multibody_joints.get(self.multibody) else { return };
        let factors = multibody.inv_augmented_mass();
        let free = multibody.generalized_acceleration();
        let mut excess = DVector::zeros(self.place.len());
        for (i, &place) in self.place.iter().enumerate() {
            excess[place] = self.qdd[i] - free[place];
        }
        let mut product = factors.l() * (factors.u() * excess);
        factors.p().inv_permute_rows(&mut product);
        for (i, &place) in self.place.iter().enumerate() {
            effort[i] = product[place];
        }
    }

    fn inverse_inertia(&mut self) -> Vec<f64> {
        let PhysicsWorld { bodies, multibody_joints, .. } = &mut self.world;
        let Some((multibody, _)) = multibody_joints.get_mut(self.multibody) else {
            return Vec::new();
        };
        let inverse = multibody.dof_inverse_inertia(bodies);
        self.place.iter().map(|&p| inverse[p]).collect()
    }
}

fn rigid_body(body: &EngineBody) -> RigidBodyBuilder {
    let properties = match &body.inertia {
        Some(inertia) => mass_properties(inertia),
        None => MassProperties::new(Vector::ZERO, 0.0, Vector::ZERO),
    };
    RigidBodyBuilder::dynamic()
        .can_sleep(false)
        .linear_damping(0.0)
        .angular_damping(0.0)
        .additional_mass_properties(properties)
}

/// Mass, centre of mass, principal moments and their frame.
///
/// Rapier's own principal axes come from a closed form that cannot resolve two nearly equal moments,
/// which costs 1 % of the WAM palm's gyroscopic torque. Below 1e-4 kg m² it also drops the products
/// of inertia. Therefore the axes are computed here.
fn mass_properties(inertia: &Inertia) -> MassProperties {
    let mut eigen = SymmetricEigen::new(inertia.about_com);
    if eigen.eigenvectors.determinant() < 0.0 {
        eigen.eigenvectors.neg_mut();
    }
    let axes = Rotation3::from_matrix_unchecked(eigen.eigenvectors);
    let frame = UnitQuaternion::from_rotation_matrix(&axes).coords;
    MassProperties::with_principal_inertia_frame(
        vector(&inertia.com_in_link),
        inertia.mass,
        vector(&eigen.eigenvalues.map(|moment| moment.max(0.0))),
        Rotation::from_xyzw(frame.x, frame.y, frame.z, frame.w),
    )
}

/// Rapier's free axis is the x axis of the joint's frames: turn it onto the body's axis.
fn joint(body: &EngineBody) -> GenericJoint {
    let (free, axis) = if body.turns {
        (JointAxesMask::LOCKED_REVOLUTE_AXES, JointAxesMask::ANG_X)
    } else {
        (JointAxesMask::LOCKED_PRISMATIC_AXES, JointAxesMask::LIN_X)
    };
    let x_to_axis = Rotation::from_rotation_arc(Vector::X, vector(&body.axis));
    let in_body = Pose::from_parts(Vector::ZERO, x_to_axis);
    let mut joint = GenericJoint::new(free);
    joint.local_frame1 = pose(&body.parent_from_body) * in_body;
    joint.local_frame2 = in_body;
    if let Some((min, max)) = body.stops {
        joint.limit_axes |= axis;
        let index = if body.turns { 3 } else { 0 };
        joint.limits[index].min = min;
        joint.limits[index].max = max;
    }
    joint
}

fn coordinate(multibody: &Multibody, link: usize, axis: usize) -> f64 {
    multibody.link(link).map_or(0.0, |l| l.joint().coords()[axis])
}

fn vector(v: &Vector3<f64>) -> Vector {
    Vector::new(v.x, v.y, v.z)
}

fn pose(isometry: &Isometry3<f64>) -> Pose {
    let r = isometry.rotation.coords;
    Pose::from_parts(vector(&isometry.translation.vector), Rotation::from_xyzw(r.x, r.y, r.z, r.w))
}
