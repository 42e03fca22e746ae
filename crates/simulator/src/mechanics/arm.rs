use nalgebra::Isometry3;

use crate::mechanics::engine::{Engine, EngineBody, Load, Push};
use crate::mechanics::inject::Efforts;
use crate::mechanics::plant::Plant;
use crate::mechanics::rapier::RapierEngine;
use crate::mechanics::step_order::StepOrder;
use crate::mechanics::transmission::Transmission;
use crate::mechanics::tree::leapfrog::TreeEngine;

/// The moving arm: maps joints to the engine's degrees of freedom.
///
/// A joint with a rigid transmission has one degree of freedom for motor and link. A compliant one
/// has two: the motor's angle `theta` of a massless body with the rotor's inertia, and the
/// deflection `delta`, so that `q = theta + delta`.
pub(crate) struct EngineArm {
    engine: Box<dyn Engine>,
    joints: Vec<Drive>,
    /// Body of each link.
    link_body: Vec<usize>,
    load: Load,
    constraint: Vec<f64>,
    motor_q: Vec<f64>,
    motor_qd: Vec<f64>,
    q: Vec<f64>,
    qd: Vec<f64>,
    transmitted: Vec<f64>,
}

/// How one joint is driven.
#[derive(Debug, Clone)]
struct Drive {
    /// Degree of freedom of the motor.
    motor: usize,
    /// Degree of freedom of the deflection.
    deflection: Option<usize>,
    transmission: Transmission,
    rotor_inertia: f64,
    spring_stiffness: f64,
    spring_rest: f64,
}

impl EngineArm {
    /// Builds the engine's bodies from the plant; `None` if the engine cannot build such a tree.
    pub fn new(plant: &Plant, step_s: f64, order: StepOrder) -> Option<Self> {
        let mut bodies: Vec<EngineBody> = Vec::new();
        let mut link_body: Vec<usize> = Vec::new();
        let mut joints = Vec::new();
        for (link, &transmission) in plant.robot.links().iter().zip(&plant.transmissions) {
            let mut body = EngineBody {
                parent: link.parent.and_then(|p| link_body.get(p).copied()),
                turns: link.joint.kind.is_rotation(),
                parent_from_body: link.joint.parent_from_joint,
                axis: link.joint.axis_in_joint,
                inertia: None,
                armature: link.actuator.rotor_inertia,
                stops: link.joint.limits.position,
            };
            let motor = bodies.len();
            if !transmission.is_rigid() {
                bodies.push(body.clone());
                body.parent = Some(motor);
                body.parent_from_body = Isometry3::identity();
                body.armature = 0.0;
                body.stops = transmission
                    .stiffness
                    .is_none()
                    .then_some((-0.5 * transmission.gap, 0.5 * transmission.gap));
            }
            body.inertia = Some(link.inertia.clone());
            link_body.push(bodies.len());
            let deflection = (!transmission.is_rigid()).then_some(bodies.len());
            joints.push(Drive::new(&link.actuator, motor, deflection, transmission));
            bodies.push(body);
        }
        let count = joints.len();
        let gravity = plant.robot.gravity_in_base();
        Some(Self {
            engine: match order {
                StepOrder::First => Box::new(RapierEngine::new(&bodies, gravity, step_s)?),
                StepOrder::Second => Box::new(TreeEngine::new(&bodies, gravity, step_s)?),
            },
            joints,
            link_body,
            load: Load::none(bodies.len()),
            constraint: vec![0.0; bodies.len()],
            motor_q: vec![0.0; count],
            motor_qd: vec![0.0; count],
            q: vec![0.0; count],
            qd: vec![0.0; count],
            transmitted: vec![0.0; count],
        })
    }

    pub fn motor_q(&self) -> &[f64] {
        &self.motor_q
    }

    pub fn motor_qd(&self) -> &[f64] {
        &self.motor_qd
    }

    pub fn q(&self) -> &[f64] {
        &self.q
    }

    pub fn qd(&self) -> &[f64] {
        &self.qd
    }

    /// Torque that each transmission carried to its link (N m or N), at the last call of
    /// [`measure_load`](Self::measure_load).
    pub fn transmitted_torque(&self) -> &[f64] {
        &self.transmitted
    }

    /// Length of a step (s).
    pub fn step_s(&self) -> f64 {
        self.engine.step_s()
    }

    /// Sets motor positions and velocities, and the deflections `twist` of compliant transmissions.
    pub fn set_state(&mut self, q: &[f64], qd: &[f64], twist: &[f64]) {
        let mut at = Load::none(self.constraint.len());
        let mut velocity = at.effort.clone();
        for (i, joint) in self.joints.iter().enumerate() {
            at.effort[joint.motor] = q[i];
            velocity[joint.motor] = qd[i];
            if let Some(deflection) = joint.deflection {
                at.effort[deflection] = twist[i];
            }
        }
        self.engine.set_state(&at.effort, &velocity);
        self.transmitted.fill(0.0);
        self.observe();
    }

    /// One step of the engine under the efforts on the joints.
    pub fn step(&mut self, efforts: &Efforts) {
        self.load.clear();
        for (i, joint) in self.joints.iter().enumerate() {
            joint.add(self.engine.as_ref(), efforts, i, &mut self.load);
        }
        let body = |p: &Push| Push { body: self.link_body[p.body], ..*p };
        self.load.pushes.extend(efforts.pushes.iter().map(body));
        self.engine.step(&self.load);
        self.observe();
    }

    /// Computes the torque that each transmission carried in the last step:
    ///
    /// ```text
    /// rigid:    load = tau_motor + friction - viscous qd - J qdd
    /// otherwise load = spring or stop between motor and link
    /// ```
    pub fn measure_load(&mut self, efforts: &Efforts) {
        self.engine.constraint_effort(&mut self.constraint);
        let qdd = self.engine.qdd();
        for (i, joint) in self.joints.iter().enumerate() {
            self.transmitted[i] = match joint.deflection {
                Some(d) => {
                    self.load.effort[d] - self.load.damping[d] * self.engine.qd()[d]
                        + self.constraint[d]
                        - efforts.link[i]
                        - joint.spring(self.q[i])
                }
                None => {
                    let m = joint.motor;
                    motor_effort(efforts, i) + self.constraint[m]
                        - self.load.damping[m] * self.engine.qd()[m]
                        - joint.rotor_inertia * qdd[m]
                }
            };
        }
    }

    /// Inverse apparent inertia at each transmission, between motor and link where it is compliant
    /// (1/(kg m²) or 1/kg). Used to check that springs are soft enough for the step.
    pub fn inverse_inertia(&mut self) -> Vec<f64> {
        let of = self.engine.inverse_inertia();
        self.joints.iter().map(|j| of[j.deflection.unwrap_or(j.motor)]).collect()
    }

    fn observe(&mut self) {
        let (q, qd) = (self.engine.q(), self.engine.qd());
        for (i, joint) in self.joints.iter().enumerate() {
            self.motor_q[i] = q[joint.motor];
            self.motor_qd[i] = qd[joint.motor];
            self.q[i] = q[joint.motor] + joint.deflection.map_or(0.0, |d| q[d]);
            self.qd[i] = qd[joint.motor] + joint.deflection.map_or(0.0, |d| qd[d]);
        }
    }
}

impl Drive {
    fn new(
        actuator: &robot::Actuator,
        motor: usize,
        deflection: Option<usize>,
        transmission: Transmission,
    ) -> Self {
        Self {
            motor,
            deflection,
            transmission,
            rotor_inertia: actuator.rotor_inertia,
            spring_stiffness: actuator.spring_stiffness,
            spring_rest: actuator.spring_rest,
        }
    }

    /// Torque of the spring at the link (N m or N).
    fn spring(&self, q: f64) -> f64 {
        -self.spring_stiffness * (q - self.spring_rest)
    }

    /// Adds the efforts on joint `i` to the engine's load.
    ///
    /// A torque on the link does work on `q = theta + delta`, so it acts on both degrees of freedom.
    fn add(&self, engine: &dyn Engine, efforts: &Efforts, i: usize, load: &mut Load) {
        let deflection = self.deflection.map_or(0.0, |d| engine.q()[d]);
        let link = efforts.link[i] + self.spring(engine.q()[self.motor] + deflection);
        load.effort[self.motor] = motor_effort(efforts, i) + link;
        load.dry[self.motor] = (0.5 * (efforts.dry_forward[i] + efforts.dry_backward[i])).max(0.0);
        load.damping[self.motor] = efforts.viscous[i].max(0.0);
        let Some(d) = self.deflection else { return };
        load.effort[d] = link;
        match self.transmission.stiffness {
            // Without free play the damping is the engine's, which takes it implicitly.
            Some(stiffness) if self.transmission.gap <= 0.0 => {
                load.effort[d] -= stiffness * deflection;
                load.damping[d] = self.transmission.damping;
            }
            Some(_) => load.effort[d] += self.transmission.contact(deflection, engine.qd()[d]),
            None => {}
        }
    }
}

/// Torque on motor `i` without the engine's dry friction (N m or N).
///
/// The engine's friction has one level, the mean of both directions. Half the difference of the two
/// levels, applied as a torque against the positive direction, gives each direction its level, at
/// rest as well as in motion.
fn motor_effort(efforts: &Efforts, i: usize) -> f64 {
    let shift = 0.5 * (efforts.dry_forward[i] - efforts.dry_backward[i]);
    efforts.motor[i] + efforts.bristles[i] - shift
}
