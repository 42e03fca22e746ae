//! Logs whose rows come faster than their values: a slower message is repeated in every row until the next one comes.

use std::collections::BTreeMap;
use std::path::Path;

use checks::arms::data;
use checks::synthetic::{Noise, wam};
use diagnosis::{Diagnosis, Settings, Silent, diagnose};
use logs::{ReadOptions, Run, read_run, run_of_columns};
use robot::{Robot, TorqueSource};

use crate::world::{World, finding, named, sign};

const FRICTION: [&str; 2] =
    ["FR02 Coulomb friction at j2_shoulder_pitch", "FR01 viscous friction at j2_shoulder_pitch"];

/// Dry friction of 3 N m and viscous friction of 1.5 N m s/rad at the second joint, whose efforts a sensor measures.
fn logs() -> (Robot, Vec<Run>) {
    let world = World::nominal().torque(1, |[_, qd, _]| 3.0 * sign(qd) + 1.5 * qd);
    let mut robot = wam();
    for link in 0..robot.joint_count() {
        robot.link_mut(link).unwrap().actuator.torque_source = TorqueSource::Measured;
    }
    (robot, world.runs(3, 20.0, &Noise::of_a_wam(), 31))
}

/// A run whose row `k` of column `c` has the value of row `source(k, c)`, read as a file is.
fn held(robot: &Robot, run: &Run, source: impl Fn(usize, &str) -> usize) -> Run {
    let mut columns = BTreeMap::from([("time".to_owned(), run.time.clone())]);
    for joint in &run.joints {
        for (name, x) in [("position", &joint.position), ("effort", &joint.effort)] {
            let x = (0..x.len()).map(|row| x[source(row, name)]).collect();
            columns.insert(format!("{}.{name}", joint.name), x);
        }
    }
    run_of_columns(&run.name, columns, robot, &ReadOptions::default()).unwrap()
}

#[track_caller]
fn has_that_friction_alone(robot: &Robot, runs: &[Run], what: &str) {
    let answer = diagnose(robot, runs, &Settings::default(), &Silent).unwrap().diagnosis;
    println!("{what}: {:?} {:?}", named(&answer), answer.warnings);
    assert_eq!(answer.findings.len(), 2, "{what}: {:?}", named(&answer));
    for (words, truth) in FRICTION.into_iter().zip([3.0, 1.5]) {
        let found = &finding(&answer, words).unwrap().parameters[0];
        assert!((found.value / truth - 1.0).abs() < 0.03, "{what}: {words} {found:?}");
    }
}

#[test]
fn friction_is_the_same_however_often_a_message_is_repeated() {
    let (robot, runs) = logs();
    let all = |source: &dyn Fn(usize, &str) -> usize| -> Vec<Run> {
        runs.iter().map(|run| held(&robot, run, source)).collect()
    };
    has_that_friction_alone(&robot, &all(&|row, _| row), "as recorded");
    has_that_friction_alone(&robot, &all(&|row, _| row / 5 * 5), "every message in five rows");
    let slow = |row: usize, column: &str| if column == "effort" { row / 5 * 5 } else { row };
    has_that_friction_alone(&robot, &all(&slow), "efforts in five rows");
    let slow = |row: usize, column: &str| if column == "position" { row / 4 * 4 } else { row };
    has_that_friction_alone(&robot, &all(&slow), "positions in four rows");
    // A third of the rows, in no order: a multiplicative hash.
    let stale = |row: &usize| *row > 0 && ((row * 2_654_435_761) >> 16).is_multiple_of(3);
    let last = |row: usize, _: &str| (0..=row).rev().find(|row| !stale(row)).unwrap_or(0);
    has_that_friction_alone(&robot, &all(&last), "a third of the rows repeat the one before");
}

fn diagnosis(robot: &Path, logs: &[&Path]) -> Diagnosis {
    let robot = Robot::load(robot).unwrap().robot;
    let read = |log: &&Path| read_run(log, &robot, &ReadOptions::default()).unwrap();
    let runs: Vec<Run> = logs.iter().map(read).collect();
    diagnose(&robot, &runs, &Settings::default(), &Silent).unwrap().diagnosis
}

/// Three logs of a Panda, 40 Hz in rows of 200 Hz: before, a link at (0 +- 6700) m, a torque constant of .01 and an
/// encoder offset.
#[test]
fn a_panda_at_40_hz_in_rows_of_200_hz_has_its_friction() {
    let Some(folder) = data("field_threads/v_zoh_pa") else { return };
    let logs = [1, 2, 3].map(|k| folder.join(format!("run{k}.csv.gz")));
    let logs = logs.each_ref().map(|log| log.as_path());
    let answer = diagnosis(&folder.join("robot.urdf"), &logs);
    let coulomb = [0.4, 0.5, 0.4, 0.6, 0.3, 0.25, 0.25];
    for (joint, level) in (1..).zip(coulomb) {
        let words = format!("FR02 Coulomb friction at panda_joint{joint}");
        let found = &finding(&answer, &words).unwrap().parameters[0];
        assert!((found.value / level - 1.0).abs() < 0.03, "{words}: {found:?}");
    }
    let everyday = ["FR01", "FR02", "IN03"];
    let is_everyday = |words: &String| everyday.iter().any(|code| words.starts_with(code));
    assert!(named(&answer).iter().all(is_everyday), "{:?}", named(&answer));
    let said: Vec<&String> =
        answer.warnings.iter().filter(|w| w.contains("held in rows")).collect();
    assert_eq!(said.len(), 1, "{said:?}");
    assert!(said[0].contains("40 Hz") && said[0].contains("200 Hz"), "{said:?}");
}
