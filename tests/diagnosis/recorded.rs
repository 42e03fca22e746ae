//! The recorded logs of four arms: what is known of them is found, with no setting changed
//! from robot to robot. There is no ground truth; what is known comes from the data sheets
//! and published fits that go with the logs.

use std::path::Path;

use catalogue::EffectKind;
use checks::arms::wam;
use checks::recorded::folder;
use diagnosis::{Diagnosis, Settings, Silent, Verdict, diagnose};
use logs::{ReadOptions, Run, read_run};
use robot::Robot;

use crate::world::{finding, named};

const FRICTIONS: [EffectKind; 3] =
    [EffectKind::ViscousFriction, EffectKind::CoulombFriction, EffectKind::AsymmetricFriction];

/// The robot beside the logs of an arm.
fn robot_of(folder: &Path, arm: &str) -> Robot {
    Robot::load(&folder.join(arm).join("robot.urdf")).unwrap().robot
}

/// The diagnosis of an arm's logs; runs without the asked-for effort are left out.
fn diagnosis(robot: &Robot, folder: &Path, runs: &[&str], effort: &str) -> Diagnosis {
    let runs = read(robot, folder, runs, effort);
    diagnose(robot, &runs, &Settings::default(), &Silent).unwrap().diagnosis
}

fn read(robot: &Robot, folder: &Path, runs: &[&str], effort: &str) -> Vec<Run> {
    let options = ReadOptions { effort, ..ReadOptions::default() };
    let read = |run: &&str| read_run(&folder.join(format!("{run}.parquet")), robot, &options);
    runs.iter().map(read).collect::<Result<_, _>>().unwrap()
}

/// Findings with one determined parameter whose interval holds the nominal value.
fn undecided(diagnosis: &Diagnosis) -> Vec<String> {
    let holds = |f: &&diagnosis::Finding| {
        let determined: Vec<_> = f.parameters.iter().filter(|p| p.determined).collect();
        let [p] = determined.as_slice() else { return false };
        f.at.joint.is_some() && p.ci95[0] <= p.nominal && p.nominal <= p.ci95[1]
    };
    diagnosis.findings.iter().filter(holds).map(|f| f.at.words()).collect()
}

fn joints_with(diagnosis: &Diagnosis, kinds: &[EffectKind]) -> Vec<String> {
    let of = |f: &&diagnosis::Finding| kinds.contains(&f.at.effect);
    let mut joints: Vec<String> =
        diagnosis.findings.iter().filter(of).filter_map(|f| f.at.joint.clone()).collect();
    joints.sort();
    joints.dedup();
    joints
}

const KINOVA: [&str; 5] = [
    "Trajectory1",
    "RunTrajectory1",
    "RecordTrajectory_quadratic",
    "opti_traj_testing1",
    "opti_traj_testing2",
];

#[test]
fn recorded_kinova_has_friction_in_the_motors_and_hardly_any_in_the_sensors() {
    let Some(folder) = folder() else { return };
    let robot = robot_of(&folder, "kinova_gen3");
    let folder = folder.join("kinova_gen3");
    let motor = diagnosis(&robot, &folder, &KINOVA, "effort");
    let all: Vec<String> = (1..=7).map(|j| format!("joint_{j}")).collect();
    assert_eq!(joints_with(&motor, &FRICTIONS), all);

    let sensor = diagnosis(&robot, &folder, &KINOVA_WITH_SENSOR, "effort_sensor");
    let (of_motor, of_sensor) = (coulomb(&motor), coulomb(&sensor));
    println!("Coulomb levels: motors {of_motor:?}, sensors {of_sensor:?}");
    let sum = |levels: &[f64]| levels.iter().sum::<f64>();
    assert!(sum(&of_sensor) < 0.4 * sum(&of_motor));
    assert_eq!([undecided(&motor), undecided(&sensor)], [Vec::<String>::new(), Vec::new()]);
}

/// More by which the held-out error may exceed that of a search without springs, as a share: a
/// search that has looked at one may end elsewhere. With the spring it is .24 more.
const ELSEWHERE: f64 = 0.05;

/// Columns of a spring explain 1.6 % of what is wrong with joint 2; the spring that they stand for,
/// 394 N m/rad, rings with the motion and explains less than none.
#[test]
fn recorded_kinova_gets_no_spring_that_takes_it_further_from_its_logs() {
    let Some(folder) = folder() else { return };
    let robot = robot_of(&folder, "kinova_gen3");
    let runs = read(&robot, &folder.join("kinova_gen3"), &KINOVA, "effort");
    let left = |without: Vec<EffectKind>| {
        let settings = Settings { without, ..Settings::default() };
        let gain = diagnose(&robot, &runs, &settings, &Silent).unwrap().diagnosis.gain.inverse;
        gain.rms_after_nm.iter().map(|rms| rms * rms).sum::<f64>().sqrt()
    };
    let [with, without] = [vec![], vec![EffectKind::JointElasticity]].map(left);
    println!("held out {with:.3} N m, {without:.3} N m where no spring is looked for");
    assert!(with < (1.0 + ELSEWHERE) * without, "{with} and {without} N m");
}

/// Without one run the friction of joint 2 is 6.1 N m forward and 7.4 N m backward, and either is
/// known to 2.5 N m: asymmetry has no name there.
#[test]
fn recorded_kinova_gets_no_asymmetry_that_may_be_none() {
    let Some(folder) = folder() else { return };
    let robot = robot_of(&folder, "kinova_gen3");
    let runs: Vec<&str> = KINOVA.into_iter().filter(|run| *run != "RunTrajectory1").collect();
    let answer = diagnosis(&robot, &folder.join("kinova_gen3"), &runs, "effort");
    let found: Vec<_> = answer.findings.iter().map(|f| f.at.words()).collect();
    println!("{found:?}");
    let of = |kind| joints_with(&answer, &[kind]).contains(&"joint_2".to_owned());
    assert!(of(EffectKind::CoulombFriction), "{found:?}");
    assert!(!of(EffectKind::AsymmetricFriction), "{found:?}");
}

/// Without one run joint 1 turns mostly one way, and an offset of 2.9 N m explains what dry friction does.
#[test]
fn recorded_kinova_has_dry_friction_where_an_offset_explains_as_much() {
    let Some(folder) = folder() else { return };
    let robot = robot_of(&folder, "kinova_gen3");
    let runs: Vec<&str> = KINOVA.into_iter().filter(|run| *run != "opti_traj_testing1").collect();
    let answer = diagnosis(&robot, &folder.join("kinova_gen3"), &runs, "effort");
    let of = |kind| joints_with(&answer, &[kind]).contains(&"joint_1".to_owned());
    assert!(of(EffectKind::CoulombFriction), "{:?}", named(&answer));
    assert!(!of(EffectKind::TorqueOffset), "{:?}", named(&answer));
}

/// The runs that have a column `effort_sensor`.
const KINOVA_WITH_SENSOR: [&str; 3] =
    ["RunTrajectory1", "opti_traj_testing1", "opti_traj_testing2"];

/// Mean Coulomb level found at each joint (N m), zero where none is.
fn coulomb(diagnosis: &Diagnosis) -> Vec<f64> {
    let level = |joint: &String| {
        let here = |f: &&diagnosis::Finding| {
            f.at.joint.as_ref() == Some(joint)
                && f.at.effect != EffectKind::ViscousFriction
                && FRICTIONS.contains(&f.at.effect)
        };
        let mean = |f: &diagnosis::Finding| {
            f.parameters.iter().map(|p| p.value).sum::<f64>() / f.parameters.len() as f64
        };
        diagnosis.findings.iter().filter(here).map(mean).sum()
    };
    diagnosis.joints.iter().map(|j| level(&j.name)).collect()
}

#[test]
fn recorded_wam_has_friction_at_the_shoulder_and_says_nothing_of_joints_at_rest() {
    let Some(folder) = folder() else { return };
    let folder = folder.join("barrett_wam");
    let answer = diagnosis(&wam(), &folder, &["shoulder_elbow_sweep"], "effort");
    let found: Vec<_> = answer.findings.iter().map(|f| f.at.words()).collect();
    println!("{found:?}");
    let shoulder = "j2_shoulder_pitch".to_owned();
    assert!(joints_with(&answer, &FRICTIONS).contains(&shoulder), "{found:?}");
    for at_rest in [0, 2, 4, 5, 6] {
        assert_eq!(answer.joints[at_rest].verdict, Verdict::DataInadequate);
    }
}

#[test]
fn recorded_tx40_has_friction_at_its_first_four_joints() {
    let Some(folder) = folder() else { return };
    let robot = robot_of(&folder, "staubli_tx40");
    let answer = diagnosis(&robot, &folder.join("staubli_tx40"), &["excitation"], "effort");
    let joints = joints_with(&answer, &FRICTIONS);
    println!("friction at {joints:?}");
    assert!((1..=4).all(|j| joints.contains(&format!("joint_{j}"))), "{joints:?}");
}

/// Relative errors of published least squares with friction and offset, fitted on the
/// second and third run and tested on the first (Bethge et al. 2017), rounded.
const LWR4_KNOWN: [f64; 7] = [0.25, 0.024, 0.086, 0.044, 0.23, 0.28, 0.68];

/// Half a unit of the last digit of most of them.
const ROUNDING: f64 = 0.005;

/// The joint that does not come down to its known error, by index, and the error that it
/// may not exceed meanwhile. A miss, not a standard.
const MISSED: (usize, f64) = (5, 0.29);

#[test]
fn recorded_lwr4_has_two_sensor_offsets_and_all_joints_but_one_are_predicted_as_well_as_known() {
    let Some(folder) = folder() else { return };
    let robot = robot_of(&folder, "kuka_lwr4");
    let runs = ["measurements_1", "measurements_2", "measurements_3"];
    let answer = diagnosis(&robot, &folder.join("kuka_lwr4"), &runs, "effort");
    for (joint, known, within) in [("lwr_0_joint", 0.85, 0.15), ("lwr_4_joint", -0.72, 0.2)] {
        let offset = finding(&answer, &format!("DR03 torque offset at {joint}"));
        let offset = offset.unwrap_or_else(|| panic!("no offset at {joint}"));
        let value = offset.parameters[0].value;
        println!("offset at {joint}: {value:.3} N m, known {known}");
        assert!((value - known).abs() <= within, "{joint}: {value}");
    }
    let first = answer.gain.inverse.folds.iter().find(|f| f.name == "measurements_1").unwrap();
    let error: Vec<f64> =
        first.rms_after_nm.iter().zip(&first.torque_rms_nm).map(|(e, t)| e / t).collect();
    println!("held-out relative errors {error:.4?}, known {LWR4_KNOWN:?}");
    let (missed, least) = MISSED;
    let worse = |&j: &usize| error[j] > if j == missed { least } else { LWR4_KNOWN[j] + ROUNDING };
    assert!(!(0..error.len()).any(|j| worse(&j)), "{error:?}");
}

/// The diagnosis of an arm's files, as `plumbline diagnose` reads them, and the frequencies of disturbances (Hz).
fn diagnosis_of_files(robot: &Path, files: &[&str]) -> (Diagnosis, Vec<f64>) {
    let folder = robot.parent().unwrap();
    let robot = Robot::load(robot).unwrap().robot;
    let read = |file: &&str| read_run(&folder.join(file), &robot, &ReadOptions::default());
    let runs: Vec<Run> = files.iter().map(read).collect::<Result<_, _>>().unwrap();
    let found = diagnose(&robot, &runs, &Settings::default(), &Silent).unwrap().diagnosis;
    let is_disturbance = |f: &&diagnosis::Finding| f.at.effect == EffectKind::ExternalDisturbance;
    let frequency = |f: &diagnosis::Finding| f.parameters[1].value;
    let disturbances = found.findings.iter().filter(is_disturbance).map(frequency).collect();
    (found, disturbances)
}

/// What drives the elbow of this UR10 from 2.4 to 3.1 Hz has a width: three lines of .8 to .6 N m in one run.
#[test]
fn recorded_ur10_has_an_elbow_that_vibrates_in_a_band_and_no_disturbance() {
    let Some(folder) = folder() else { return };
    let robot = folder.join("ur10_bag/ur10_robot.urdf");
    let (found, disturbances) = diagnosis_of_files(&robot, &["ur10_exciting_trajectory.db3.gz"]);
    assert_eq!(disturbances, Vec::<f64>::new());
    let band = "elbow_joint oscillates in a band from 2.4 to 3.1 Hz";
    assert!(found.warnings.iter().any(|w| w.starts_with(band)), "{:?}", found.warnings);
}

/// The three files are parts of one motion, in which every joint follows one sine: lines of its fifth joint at .38 and
/// .47 Hz are between harmonics of its .1 Hz and of others. Ripple of 240 periods a turn follows the position.
#[test]
fn recorded_ar5_has_ripple_and_no_disturbance_at_a_harmonic_of_its_motion() {
    let Some(folder) = folder() else { return };
    let robot = folder.join("ar5/robot.toml");
    let (found, disturbances) =
        diagnosis_of_files(&robot, &["part_1.csv", "part_2.csv", "part_3.csv"]);
    assert_eq!(disturbances, Vec::<f64>::new());
    let ripple = finding(&found, "DR01 torque ripple at joint2").expect("ripple");
    let periods = &ripple.parameters[1];
    assert!(periods.ci95[0] < 240.0 && 240.0 < periods.ci95[1], "{periods:?}");
}
