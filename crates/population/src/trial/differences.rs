use catalogue::EffectKind as K;
use nalgebra::DMatrix;
use robot::{Inertia, Robot};
use simulator::Truth;

use crate::oracle::column::{StandIn, TorqueColumn};
use crate::oracle::motion::SeenRun;
use crate::oracle::stand_ins::dry;
use crate::sheet::CauseRole;
use crate::trial::background::Friction;

/// A difference of an arm from its nominal model, with the torque that it causes.
pub(crate) struct Difference {
    pub role: CauseRole,
    pub truth: Truth,
    pub column: TorqueColumn,
}

/// Whether the effort of a log contains the friction and rotors of the drives.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Drives {
    /// It does: the effort is a motor's or a command.
    Seen,
    /// It does not: the effort is measured behind the drives.
    Unseen,
}

/// All differences of an arm from its nominal model: friction and rotor of each joint, where the effort contains
/// them, and the body of each link.
///
/// ```text
/// tau = (F - F_nominal) sign(qd),  (b - b_nominal) qd,  (J - J_nominal) qdd,  Y (pi - pi_nominal)
/// ```
pub(crate) fn differences(
    truth: &Robot,
    friction: &[Friction],
    nominal: &Robot,
    runs: &[SeenRun],
    drives: Drives,
) -> Vec<Difference> {
    let mut all = Vec::new();
    for (j, (link, model)) in truth.links().iter().zip(nominal.links()).enumerate() {
        let name = link.joint.name.as_str();
        let at = |kind, parameter, size| Truth::at_joint(kind, name, &[(parameter, size)]);
        let mut add = |role, truth, stands_for, size: f64, of: &dyn Fn(&SeenRun, usize) -> f64| {
            if drives == Drives::Seen && size.abs() > 0.0 {
                let torque = runs.iter().map(|run| alone(run, j, &|i| size * of(run, i))).collect();
                all.push(Difference {
                    role,
                    truth,
                    column: TorqueColumn { stands_for, torque, prior: 0.0 },
                });
            }
        };
        let (known, real) = (&model.actuator, &link.actuator);
        let level = friction[j].coulomb + real.coulomb_forward - known.coulomb_forward;
        let slope = friction[j].viscous + real.viscous - known.viscous;
        let rotor = real.rotor_inertia - known.rotor_inertia;
        add(
            CauseRole::Background,
            at(K::CoulombFriction, "level", level),
            StandIn::Dry(j),
            level,
            &|run, i| dry(run.qd[(i, j)]),
        );
        add(
            CauseRole::Background,
            at(K::ViscousFriction, "viscous", slope),
            StandIn::Viscous(j),
            slope,
            &|run, i| run.qd[(i, j)],
        );
        add(
            CauseRole::Nominal,
            at(K::RotorInertia, "inertia", rotor),
            StandIn::Rotor(j),
            rotor,
            &|run, i| run.qdd[(i, j)],
        );
    }
    for (l, (link, model)) in truth.links().iter().zip(nominal.links()).enumerate() {
        if link.inertia != model.inertia {
            let column = body(truth, l, &model.inertia, runs);
            all.push(Difference {
                role: CauseRole::Nominal,
                truth: weighs(&link.name, &link.inertia),
                column,
            });
        }
    }
    all
}

fn alone(run: &SeenRun, joint: usize, of: &dyn Fn(usize) -> f64) -> DMatrix<f64> {
    let value = |i, k| if k == joint { of(i) } else { 0.0 };
    DMatrix::from_fn(run.rows(), run.q.ncols(), value)
}

/// Torque of a body beyond its nominal model.
fn body(robot: &Robot, link: usize, nominal: &Inertia, runs: &[SeenRun]) -> TorqueColumn {
    let (real, known) = (robot.links()[link].inertia.parameters(), nominal.parameters());
    let mut beyond = real;
    beyond.iter_mut().zip(known).for_each(|(real, known)| *real -= known);
    let torque = |run: &SeenRun| {
        let mut torque = DMatrix::zeros(run.rows(), robot.joint_count());
        let mut tau = vec![0.0; robot.joint_count()];
        for i in 0..run.rows() {
            tau.fill(0.0);
            run.moving(robot, i).add_body(link, &beyond, &mut tau);
            tau.iter().enumerate().for_each(|(j, tau)| torque[(i, j)] = *tau);
        }
        torque
    };
    TorqueColumn {
        stands_for: StandIn::Body(link),
        torque: runs.iter().map(torque).collect(),
        prior: 0.0,
    }
}

fn weighs(link: &str, body: &Inertia) -> Truth {
    let c = body.com_in_link;
    let parameters = [("mass", body.mass), ("com_x", c.x), ("com_y", c.y), ("com_z", c.z)];
    Truth::at_link(K::InertialParameters, link, &parameters)
}
