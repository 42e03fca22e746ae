//! Torques of the rigid bodies of a robot and of the springs at its joints along a motion of its links.

use dynamics::{Dynamics, PARAMETERS_PER_LINK};
use nalgebra::{UnitVector3, Vector3};
use robot::Robot;

use crate::motion::cable_loop::Loop;
use crate::motion::drive::spring_torque;
use crate::motion::encoders::JointMotions;

/// `[joint][parameter][sample]`: torque per unit of the ten parameters of a link; empty where the joint does not
/// carry it.
pub(crate) type LinkRegressor = Vec<Vec<Vec<f64>>>;

/// Samples that are evaluated before they are sorted into signals; they fit into a core's cache.
const BATCH: usize = 32;

/// Torque of the links and springs of every joint, `[joint][sample]` (N·m or N).
pub(crate) fn loads(robot: &Robot, motion: &JointMotions) -> Vec<Vec<f64>> {
    let n = robot.joint_count();
    let dynamics = Dynamics::new(robot);
    let mut ws = dynamics.workspace();
    let mut load = vec![vec![0.0; samples(motion)]; n];
    let mut tau = vec![0.0; n];
    along(motion, |t, [q, qd, qdd]| {
        dynamics.inverse_dynamics_into(&mut ws, q, qd, qdd, &mut tau);
        for (i, link) in robot.links().iter().enumerate() {
            load[i][t] = tau[i] + spring_torque(&link.actuator, q[i]);
        }
    });
    for (i, link) in robot.links().iter().enumerate() {
        if let Some(dragged) = Loop::of(&link.actuator, &motion[0][i]) {
            load[i].iter_mut().zip(dragged.torque).for_each(|(load, h)| *load += h);
        }
    }
    load
}

/// Torque of every joint per unit of the parameters of a link.
pub(crate) fn link_regressor(robot: &Robot, motion: &JointMotions, link: usize) -> LinkRegressor {
    let width = PARAMETERS_PER_LINK * robot.joint_count();
    let carriers: Vec<usize> =
        std::iter::successors(Some(link), |&at| robot.links()[at].parent).collect();
    let signals = |joint: usize| {
        let count = if carriers.contains(&joint) { PARAMETERS_PER_LINK } else { 0 };
        // A clone of an empty vector has no room.
        (0..count).map(|_| Vec::with_capacity(samples(motion))).collect()
    };
    let mut regressor: LinkRegressor = (0..robot.joint_count()).map(signals).collect();
    let dynamics = Dynamics::new(robot);
    let mut ws = dynamics.workspace();
    let mut batch: Vec<f64> = Vec::new();
    let mut sort = |batch: &mut Vec<f64>| {
        for (joint, signals) in regressor.iter_mut().enumerate() {
            for (k, signal) in signals.iter_mut().enumerate() {
                let at = joint * PARAMETERS_PER_LINK + k;
                signal.extend(batch.chunks_exact(width).map(|y| y[at]));
            }
        }
        batch.clear();
    };
    along(motion, |_, state| {
        let from = batch.len();
        batch.resize(from + width, 0.0);
        dynamics.link_regressor_into(&mut ws, link, state, &mut batch[from..]);
        if batch.len() == BATCH * width {
            sort(&mut batch);
        }
    });
    sort(&mut batch);
    regressor
}

/// Torque of every joint per radian of tilt about the two horizontal axes.
pub(crate) fn tilt(robot: &Robot, motion: &JointMotions) -> Vec<[Vec<f64>; 2]> {
    let n = robot.joint_count();
    let gravity = robot.gravity_in_base();
    let turned = tilt_axes(gravity).map(|axis| axis.cross(&gravity));
    let dynamics = Dynamics::new(robot);
    let mut ws = dynamics.workspace();
    let mut tilt = vec![[(); 2].map(|()| vec![0.0; samples(motion)]); n];
    let mut g = vec![0.0; 3 * n];
    along(motion, |t, [q, ..]| {
        dynamics.gravity_regressor_into(&mut ws, q, &mut g);
        for (tilt, g) in tilt.iter_mut().zip(g.chunks_exact(3)) {
            let weight = Vector3::from_row_slice(g);
            tilt.iter_mut().zip(&turned).for_each(|(s, v)| s[t] = weight.dot(v));
        }
    });
    tilt
}

/// Two horizontal axes, unit vectors orthogonal to gravity and to each other.
pub(crate) fn tilt_axes(gravity: Vector3<f64>) -> [Vector3<f64>; 2] {
    let down = UnitVector3::try_new(gravity, 1e-9).unwrap_or_else(|| -Vector3::z_axis());
    // The base axis that is most nearly horizontal starts the pair: x for an upright arm.
    let start = if down.x.abs() < 0.9 { Vector3::x() } else { Vector3::y() };
    let first = (start - down.into_inner() * down.dot(&start)).normalize();
    [first, (-down.into_inner()).cross(&first)]
}

/// Number of samples of a motion.
pub(crate) fn samples(motion: &JointMotions) -> usize {
    motion[0].first().map_or(0, Vec::len)
}

/// Calls `of` with position, velocity and acceleration of all joints at every sample.
pub(crate) fn along(motion: &JointMotions, mut of: impl FnMut(usize, [&[f64]; 3])) {
    let mut state = motion.each_ref().map(|signals| vec![0.0; signals.len()]);
    for t in 0..samples(motion) {
        for (x, signals) in state.iter_mut().zip(motion) {
            x.iter_mut().zip(signals).for_each(|(x, s)| *x = s[t]);
        }
        of(t, state.each_ref().map(Vec::as_slice));
    }
}
