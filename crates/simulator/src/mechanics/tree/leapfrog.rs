use nalgebra::Vector3;

use crate::mechanics::engine::{Engine, EngineBody, Load};
use crate::mechanics::tree::bodies::Bodies;
use crate::mechanics::tree::held::{HeldSystem, Hold};
use crate::mechanics::tree::kick::{Kick, Kicker};

/// Product of step, damping and inverse inertia below which the weight of damping is taken from its series.
const SMALL_DAMPING: f64 = 1e-3;

/// Share of the largest inertia of a joint below which that of another is rounding.
const LEAST_INERTIA: f64 = 1e-14;

/// A tree of bodies, stepped as a leapfrog whose error falls with the square of the step:
///
/// ```text
/// v(k+1/2) = v(k-1/2) + dt M(q_k)^-1 (effort_k - bias(q_k, v_k) - d ((1 - w) v(k-1/2) + w v(k+1/2)) + friction)
/// q(k+1)   = q(k) + dt v(k+1/2),    v_k = v(k-1/2) + dt/2 dv/dt
/// ```
///
/// Every term belongs to the middle of its step, but for the bias, whose velocity is carried on by half a step with the
/// last acceleration. Friction is integrated through its changes ([`Kicker`]).
///
/// `w = 1/(1 - e^-z) - 1/z` with `z = dt d / inertia` is 1/2 for small steps and 1 for large ones, and exact for one
/// damped inertia (Liniger & Willoughby 1970).
pub(crate) struct TreeEngine {
    bodies: Bodies,
    stops: Vec<Option<(f64, f64)>>,
    step_s: f64,
    kicker: Kicker,
    /// Inverse inertias with which the weight of damping is chosen: those at position zero.
    inverse_inertia: Vec<f64>,
    matrix: Vec<f64>,
    force: Vec<f64>,
    bounds: Vec<(f64, f64)>,
    q: Vec<f64>,
    qd: Vec<f64>,
    qdd: Vec<f64>,
    /// The velocity belongs to the time of the position, not half a step before.
    fresh: bool,
}

impl TreeEngine {
    /// Builds the tree at rest at position zero; parents come before their children.
    pub fn new(bodies: &[EngineBody], gravity_in_base: Vector3<f64>, step_s: f64) -> Option<Self> {
        let count = bodies.len();
        let zeros = vec![0.0; count];
        let mut engine = Self {
            bodies: Bodies::new(bodies, gravity_in_base)?,
            stops: bodies.iter().map(|b| b.stops).collect(),
            step_s,
            kicker: Kicker::new(count),
            inverse_inertia: zeros.clone(),
            matrix: vec![0.0; count * count],
            force: zeros.clone(),
            bounds: vec![(f64::NEG_INFINITY, f64::INFINITY); count],
            q: zeros.clone(),
            qd: zeros.clone(),
            qdd: zeros,
            fresh: true,
        };
        engine.inverse_inertia = engine.inverse_inertia();
        Some(engine)
    }

    /// Matrix, forces and bounds of a kick of `span_s`.
    fn prepare(&mut self, load: &Load, span_s: f64) {
        self.bodies.place(&self.q, &self.qd, &load.pushes);
        self.matrix.copy_from_slice(self.bodies.mass());
        let count = self.q.len();
        for i in 0..count {
            self.force[i] = load.effort[i] - self.bodies.bias()[i];
            let damping = load.damping[i];
            if damping > 0.0 {
                self.force[i] -= damping * self.kicker.velocity[i];
                let weight = damping_weight(span_s * damping * self.inverse_inertia[i]);
                self.matrix[i * count + i] += weight * span_s * damping;
            }
            if let Some((min, max)) = self.stops[i] {
                self.bounds[i] = ((min - self.q[i]) / self.step_s, (max - self.q[i]) / self.step_s);
            }
        }
    }
}

/// Share of the velocity after a kick in its damping, for `z = span d / inertia`.
fn damping_weight(z: f64) -> f64 {
    if z < SMALL_DAMPING { 0.5 + z / 12.0 } else { -(-z).exp_m1().recip() - z.recip() }
}

impl Engine for TreeEngine {
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
        self.q.copy_from_slice(q);
        self.qd.copy_from_slice(qd);
        self.qdd.fill(0.0);
        self.kicker = Kicker::new(q.len());
        self.kicker.velocity.copy_from_slice(qd);
        self.fresh = true;
    }

    fn step(&mut self, load: &Load) {
        let span_s = if self.fresh { 0.5 * self.step_s } else { self.step_s };
        self.fresh = false;
        self.prepare(load, span_s);
        self.qdd.copy_from_slice(&self.kicker.velocity);
        self.kicker.kick(&Kick {
            matrix: &self.matrix,
            force: &self.force,
            dry: &load.dry,
            bounds: &self.bounds,
            span_s,
        });
        for i in 0..self.q.len() {
            let velocity = self.kicker.velocity[i];
            self.qdd[i] = (velocity - self.qdd[i]) / span_s;
            self.q[i] += self.step_s * velocity;
            self.qd[i] = velocity + 0.5 * self.step_s * self.kicker.acceleration[i];
        }
    }

    fn constraint_effort(&self, effort: &mut [f64]) {
        effort.copy_from_slice(&self.kicker.constraint);
    }

    fn inverse_inertia(&mut self) -> Vec<f64> {
        let count = self.q.len();
        self.bodies.place(&self.q, &vec![0.0; count], &[]);
        let own: Vec<f64> = (0..count).map(|i| self.bodies.mass()[i * count + i]).collect();
        let least = LEAST_INERTIA * own.iter().copied().fold(0.0, f64::max);
        if own.iter().any(|&inertia| inertia <= least) {
            // The matrix has no inverse: the joints that are to blame have no inertia of their own.
            let inverse =
                |&inertia: &f64| if inertia > least { 1.0 / inertia } else { f64::INFINITY };
            return own.iter().map(inverse).collect();
        }
        let (mut system, holds) = (HeldSystem::new(count), vec![Hold::NONE; count]);
        let column = |i: usize| {
            let mut one = vec![0.0; count];
            one[i] = 1.0;
            system.solve(self.bodies.mass(), &one, &holds);
            system.rate[i]
        };
        (0..count).map(column).collect()
    }
}
