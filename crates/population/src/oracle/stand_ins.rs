use nalgebra::DMatrix;
use robot::{Inertia, Robot};

use crate::moving::Moving;
use crate::oracle::column::{StandIn, TorqueColumn};
use crate::oracle::motion::SeenRun;

/// Speed up to which a joint creeps or stands (rad/s or m/s). Its friction is then anything up to the level, and
/// no encoder that is read for a tenth of a second shows which way it goes: 2e-4 rad are an eighth of a step of 12
/// bits.
const CREEP: f64 = 2e-3;

/// Prior deviation of bodies: share of mass, offset of the centre of mass as a share of the radius of
/// gyration, and share of inertia.
const KNOWN: f64 = 0.05;

/// Whether a joint of this velocity moves.
pub(crate) fn moves(qd: f64) -> bool {
    qd.abs() > CREEP
}

/// Sign of the velocity of a joint that moves, zero of one that does not.
pub(crate) fn dry(qd: f64) -> f64 {
    if moves(qd) { qd.signum() } else { 0.0 }
}

/// Columns that may explain a cause instead: dry and viscous friction, an offset and a rotor of any size at
/// every joint, and the ten parameters of every body, known to a twentieth.
pub(crate) fn stand_ins(robot: &Robot, runs: &[SeenRun]) -> Vec<TorqueColumn> {
    let joints = robot.joint_count();
    let mut columns = Vec::with_capacity(14 * joints);
    for j in 0..joints {
        let alone = |of: &dyn Fn(&SeenRun, usize) -> f64| {
            let only = |run: &SeenRun| {
                let value = |i, k| if k == j { of(run, i) } else { 0.0 };
                DMatrix::from_fn(run.rows(), joints, value)
            };
            runs.iter().map(only).collect()
        };
        let free = |stands_for, torque| TorqueColumn { stands_for, torque, prior: 0.0 };
        columns.push(free(StandIn::Dry(j), alone(&|run, i| dry(run.qd[(i, j)]))));
        columns.push(free(StandIn::Viscous(j), alone(&|run, i| run.qd[(i, j)])));
        columns.push(free(StandIn::Offset(j), alone(&|_, _| 1.0)));
        columns.push(free(StandIn::Rotor(j), alone(&|run, i| run.qdd[(i, j)])));
    }
    let known: Vec<[f64; 10]> = robot.links().iter().map(|l| deviations(&l.inertia)).collect();
    let bodies = body_columns(robot, runs);
    for ((link, parameter), torque) in bodies {
        let prior = known[link][parameter].powi(-2);
        columns.push(TorqueColumn { stands_for: StandIn::Body(link), torque, prior });
    }
    columns
}

/// Prior deviations of a body's ten parameters.
fn deviations(body: &Inertia) -> [f64; 10] {
    let mass = body.mass.max(1e-6);
    let radius = (body.about_com.trace() / (2.0 * mass)).sqrt().max(1e-4);
    let reach = body.com_in_link.norm() + radius;
    let (m, h, i) = (KNOWN * mass, KNOWN * mass * reach, KNOWN * mass * reach * reach);
    [m, h, h, h, i, i, i, i, i, i]
}

type BodyColumn = ((usize, usize), Vec<DMatrix<f64>>);

/// Torque per unit of each of the ten parameters of each body.
fn body_columns(robot: &Robot, runs: &[SeenRun]) -> Vec<BodyColumn> {
    let joints = robot.joint_count();
    let zero = || runs.iter().map(|run| DMatrix::zeros(run.rows(), joints)).collect();
    let places = (0..joints).flat_map(|link| (0..10).map(move |parameter| (link, parameter)));
    let mut columns: Vec<BodyColumn> = places.map(|place| (place, zero())).collect();
    let mut tau = vec![0.0; joints];
    for (r, run) in runs.iter().enumerate() {
        for i in 0..run.rows() {
            let moving = run.moving(robot, i);
            for ((link, parameter), torque) in &mut columns {
                let mut unit = [0.0; 10];
                unit[*parameter] = 1.0;
                tau.fill(0.0);
                moving.add_body(*link, &unit, &mut tau);
                tau.iter().enumerate().for_each(|(j, tau)| torque[r][(i, j)] = *tau);
            }
        }
    }
    columns
}

impl SeenRun {
    /// Motion of the links at a sample.
    pub fn moving(&self, robot: &Robot, i: usize) -> Moving {
        let of = |m: &DMatrix<f64>| m.row(i).iter().copied().collect::<Vec<f64>>();
        Moving::new(robot, &of(&self.q), &of(&self.qd), &of(&self.qdd))
    }
}
