//! What is fitted beside the findings: what no single cause shows and all together predict.

use checks::recorded::folder;
use diagnosis::{DiagnosisRun, FittedParameter, Settings, Silent, diagnose, unexplained_torque};
use logs::{PrepareSettings, ReadOptions, Run, prepare, read_run};
use robot::Robot;

use crate::world::{World, sign};

/// What logs say with changes that have no name, and without.
fn outcomes(robot: &Robot, runs: &[Run]) -> [DiagnosisRun; 2] {
    [false, true].map(|only_findings| {
        let settings = Settings { only_findings, ..Settings::default() };
        diagnose(robot, runs, &settings, &Silent).unwrap()
    })
}

/// RMS of measured minus predicted effort at every joint along a run (N m).
fn errors(robot: &Robot, run: &Run) -> Vec<f64> {
    let prepared = prepare(std::slice::from_ref(run), &PrepareSettings::default()).unwrap();
    let along = unexplained_torque(robot, &vec![0.0; robot.joint_count()], &prepared).unwrap();
    let rms =
        |left: &Vec<f64>| (left.iter().map(|e| e * e).sum::<f64>() / left.len() as f64).sqrt();
    along[0].left.iter().map(rms).collect()
}

/// A LWR 4 whose links are all described roughly. The third run is in no log of the diagnosis.
#[test]
fn a_rough_description_predicts_better_with_changes_that_have_no_name() {
    let Some(folder) = folder() else { return };
    let folder = folder.join("kuka_lwr4");
    let robot = Robot::load(&folder.join("robot.urdf")).unwrap().robot;
    let options = ReadOptions { effort: "effort", ..ReadOptions::default() };
    let read =
        |run: u8| read_run(&folder.join(format!("measurements_{run}.parquet")), &robot, &options);
    let runs: Vec<Run> = [1, 2].map(|run| read(run).unwrap()).to_vec();
    let [with, alone] = outcomes(&robot, &runs);
    let also = with.diagnosis.also_fitted.as_ref().expect("nothing is fitted beside the findings");
    assert_eq!(alone.diagnosis.also_fitted, None);
    assert_eq!(with.diagnosis.findings, alone.diagnosis.findings);
    assert_eq!(also.rms_named_nm, alone.diagnosis.gain.inverse.rms_after_nm);
    let is_changed = |p: &FittedParameter| (p.value - p.before).abs() > 0.0;
    assert!(also.parameters.len() > 3 && also.parameters.iter().all(is_changed), "{also:?}");
    let new = read(3).unwrap();
    let (with, alone) = (errors(&with.extended, &new), errors(&alone.extended, &new));
    println!("with {with:.4?}\nalone {alone:.4?}");
    let total = |errors: &[f64]| errors.iter().map(|e| e * e).sum::<f64>().sqrt();
    assert!(total(&with) < total(&alone));
}

/// The errors of a friction that is named are noise: there is nothing left to fit.
#[test]
fn nothing_is_fitted_without_a_name_where_one_friction_is_all() {
    let world = World::nominal().torque(3, |[_, qd, _]| 0.5 * sign(qd));
    let [with, alone] = outcomes(&World::nominal().robot, &world.log(7300));
    assert_eq!(with.diagnosis, alone.diagnosis);
    assert_eq!(with.diagnosis.also_fitted, None);
    assert_eq!(with.extended, alone.extended);
}
