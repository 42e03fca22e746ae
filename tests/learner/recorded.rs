//! Rigid bodies learned from recorded arms, judged on runs that they have not seen.

use std::path::Path;

use checks::arms::wam;
use checks::recorded::folder;
use dynamics::{ColumnSet, Dynamics, RegressorColumn};
use learner::{Regression, RigidBodyFit, Samples, Weighting};
use logs::{PrepareSettings, ReadOptions, prepare, read_run};
use robot::Robot;

const NO_ROTOR: ColumnSet = ColumnSet { rotor: false, ..ColumnSet::ALL };

fn samples(robot: &Robot, folder: &Path, runs: &[&str]) -> Samples {
    let options = ReadOptions::default();
    let read = |run: &&str| read_run(&folder.join(run), robot, &options).unwrap();
    let runs: Vec<_> = runs.iter().map(read).collect();
    Samples::new(&prepare(&runs, &PrepareSettings::default()).unwrap())
}

/// Norm of the error over that of the torque, for every joint.
fn relative_errors(robot: &Robot, set: ColumnSet, pi: &[f64], samples: &Samples) -> Vec<f64> {
    let dynamics = Dynamics::new(robot);
    let (n, width) = (robot.joint_count(), pi.len());
    let (mut ws, mut y) = (dynamics.workspace(), vec![0.0; n * width]);
    let mut sums = vec![[0.0; 2]; n];
    for k in 0..samples.len() {
        let state = samples.state(k);
        dynamics.columns_into(&mut ws, [state.q, state.qd, state.qdd], set, &mut y);
        for ((row, tau), sums) in y.chunks_exact(width).zip(samples.tau(k)).zip(&mut sums) {
            let predicted: f64 = row.iter().zip(pi).map(|(y, p)| y * p).sum();
            sums[0] += (tau - predicted).powi(2);
            sums[1] += tau * tau;
        }
    }
    sums.iter().map(|[error, torque]| (error / torque).sqrt()).collect()
}

fn fit(robot: &Robot, set: ColumnSet, samples: &Samples) -> RigidBodyFit {
    let mut regression = Regression::new(robot, set);
    regression.add_samples(samples).unwrap();
    regression.fit(None).unwrap()
}

/// Relative errors from the notes beside the recordings, of a least squares with a filter of
/// its own (Bethge et al. 2017).
const KNOWN: [f64; 7] = [0.25, 0.024, 0.086, 0.044, 0.23, 0.28, 0.68];

#[test]
fn a_kuka_is_predicted_on_a_run_that_was_not_learned_from() {
    let Some(folder) = folder() else { return };
    let robot = Robot::load(&folder.join("kuka_lwr4/robot.urdf")).unwrap().robot;
    let part = |runs: &[&str]| samples(&robot, &folder.join("kuka_lwr4"), runs);
    let fit = fit(&robot, NO_ROTOR, &part(&["measurements_2.parquet", "measurements_3.parquet"]));
    let asked = part(&["measurements_1.parquet"]);
    let errors = relative_errors(&robot, NO_ROTOR, &fit.parameters, &asked);
    for (joint, (found, known)) in errors.iter().zip(KNOWN).enumerate() {
        assert!(*found < 1.12 * known, "joint {joint}: {found} and {known}");
    }
}

/// Coulomb friction of the same notes, whose least squares pooled these runs.
#[test]
fn coulomb_friction_of_a_kinova_is_the_known_one() {
    let Some(folder) = folder() else { return };
    let robot = Robot::load(&folder.join("kinova_gen3/robot.urdf")).unwrap().robot;
    let runs = [
        "RecordTrajectory_quadratic.parquet",
        "RunTrajectory1.parquet",
        "Trajectory1.parquet",
        "opti_traj_testing1.parquet",
        "opti_traj_testing2.parquet",
    ];
    let fit = fit(&robot, NO_ROTOR, &samples(&robot, &folder.join("kinova_gen3"), &runs));
    assert!(matches!(fit.weighting, Weighting::Converged { .. }), "{:?}", fit.weighting);
    for (joint, known) in [2.9, 5.0, 2.4, 3.2, 1.0, 1.1, 1.2].into_iter().enumerate() {
        let place =
            fit.columns.iter().position(|c| *c == RegressorColumn::Coulomb { joint }).unwrap();
        let found = fit.parameters[place];
        assert!((found - known).abs() < 0.2, "joint {joint}: {found} and {known}");
    }
    // Some seconds of motion do not show every inertia, and the fit says which.
    assert_eq!(fit.rank + fit.undetermined.len(), fit.base.rank());
    assert!(fit.rank < fit.base.rank());
}

/// Two joints of seven move: what hardly shows must not run off when the links are made bodies.
#[test]
fn physical_links_predict_a_wam_whose_wrist_stands_still_as_well_as_any() {
    let Some(folder) = folder() else { return };
    let robot = wam();
    let samples = samples(&robot, &folder.join("barrett_wam"), &["shoulder_elbow_sweep.parquet"]);
    let fit = fit(&robot, ColumnSet::ALL, &samples);
    let consistent = fit.consistent(&robot, 1.0).unwrap();
    let errors = |pi: &[f64]| relative_errors(&robot, ColumnSet::ALL, pi, &samples);
    let (free, physical) = (errors(&fit.parameters), errors(&consistent.parameters));
    for (joint, (free, physical)) in free.iter().zip(physical).enumerate() {
        assert!(physical < 1.3 * free, "joint {joint}: {physical} and {free}");
    }
}
