use catalogue::EffectKind;
use nalgebra::{DMatrix, Vector3};
use robot::Robot;
use simulator::Truth;

use crate::moving::body_torque;
use crate::oracle::column::{StandIn, TorqueColumn};
use crate::oracle::motion::SeenRun;
use crate::robot_files::RobotFiles;
use crate::sheet::CauseRole;
use crate::trial::differences::Difference;

/// Key of `robot.toml` that says how an arm stands.
const KEY: &str = "gravity_m_per_s2";

/// Least and largest tilt of a mount that a model leaves out (rad): a wall is at pi/2.
const TILTS: [f64; 2] = [0.08, 1.6];

/// Whether an arm stands on a tilted base and does not hang.
pub(crate) fn is_tilted(robot: &Robot) -> bool {
    let tilt = robot.gravity_in_base().angle(&-Vector3::z());
    (TILTS[0]..TILTS[1]).contains(&tilt)
}

/// The same model of an arm that stands upright.
pub(crate) fn upright(files: &RobotFiles) -> RobotFiles {
    let lines = files.toml.lines().filter(|line| !line.starts_with(KEY));
    let toml = lines.flat_map(|line| [line, "\n"]).collect();
    RobotFiles { toml, ..files.clone() }
}

/// The mount as a cause, where gravity is not that of the nominal model:
///
/// ```text
/// g = exp(w x) g_nominal,   w = angle (g_nominal x g) / |g_nominal x g| = tilt_1 e_1 + tilt_2 e_2
/// tau = bodies(g) - bodies(g_nominal)
/// ```
///
/// with `e_1`, `e_2` the x and y axes of the upright base.
pub(crate) fn difference(truth: &Robot, nominal: &Robot, runs: &[SeenRun]) -> Option<Difference> {
    let [g, known] = [truth, nominal].map(Robot::gravity_in_base);
    let turn = known.cross(&g).try_normalize(1e-9)? * known.angle(&g);
    let upright = truth.clone().with_gravity(known);
    let torque = |run: &SeenRun| {
        let mut torque = DMatrix::zeros(run.rows(), truth.joint_count());
        let mut tau = vec![0.0; truth.joint_count()];
        for (robot, sign) in [(truth, 1.0), (&upright, -1.0)] {
            for i in 0..run.rows() {
                let of = |m: &DMatrix<f64>| m.row(i).iter().copied().collect::<Vec<f64>>();
                body_torque(robot, &of(&run.q), &of(&run.qd), &of(&run.qdd), &mut tau);
                tau.iter().enumerate().for_each(|(j, tau)| torque[(i, j)] += sign * tau);
            }
        }
        torque
    };
    Some(Difference {
        role: CauseRole::Nominal,
        truth: Truth::everywhere(
            EffectKind::GravityDirection,
            &[("tilt_1", turn.x), ("tilt_2", turn.y)],
        ),
        column: TorqueColumn {
            stands_for: StandIn::Itself,
            torque: runs.iter().map(torque).collect(),
            prior: 0.0,
        },
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn pendulum() -> Robot {
        Robot::from_urdf(
            r#"<robot name="arm"><link name="base"/>
            <link name="upper"><inertial><origin xyz="0.5 0 0"/><mass value="2"/>
            <inertia ixx="0.01" ixy="0" ixz="0" iyy="0.01" iyz="0" izz="0.02"/></inertial></link>
            <joint name="a" type="revolute"><parent link="base"/><child link="upper"/>
            <axis xyz="0 0 1"/><limit lower="-2" upper="2" velocity="3" effort="50"/></joint></robot>"#,
        )
        .unwrap()
    }

    /// Gravity along -y is the turn of -z by -90 degrees about x; on a wall a vertical axis carries
    /// `m g c cos q`, of which the upright model knows nothing.
    #[test]
    fn a_wall_mount_is_a_quarter_turn_and_loads_an_upright_axis() {
        let wall = pendulum().with_gravity(Vector3::new(0.0, -9.81, 0.0));
        assert!(is_tilted(&wall) && !is_tilted(&pendulum()));
        let still = DMatrix::zeros(3, 1);
        let q = DMatrix::from_column_slice(3, 1, &[0.0, 0.5, 1.0]);
        let run = SeenRun {
            step_s: 0.02,
            thinned: 1,
            q: q.clone(),
            qd: still.clone(),
            qdd: still.clone(),
            effort: still.clone(),
            beyond: still,
        };
        let cause = difference(&wall, &pendulum(), std::slice::from_ref(&run)).unwrap();
        let quarter = std::f64::consts::FRAC_PI_2;
        assert!((cause.truth.parameters["tilt_1"] + quarter).abs() < 1e-12);
        assert!(cause.truth.parameters["tilt_2"].abs() < 1e-12);
        for i in 0..3 {
            let expected = 2.0 * 9.81 * 0.5 * q[(i, 0)].cos();
            assert!((cause.column.torque[0][(i, 0)] - expected).abs() < 1e-12);
        }
        assert!(difference(&wall, &wall, &[run]).is_none());
    }
}
