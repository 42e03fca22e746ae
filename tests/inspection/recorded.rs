//! Recorded logs of real arms: nothing is told but what is known of them.

use std::path::{Path, PathBuf};
use std::time::Instant;

use checks::arms::data;
use inspection::{Observation, ObservationKind, Spoils, inspect};
use logs::{LogError, ReadOptions, Run, read_run};
use robot::Robot;

/// Folders of the recorded arms, and their descriptions; the WAM's is that of the workspace.
const ARMS: [(&str, &str); 8] = [
    ("barrett_wam", ""),
    ("dfki_pendulum", "robot.urdf"),
    ("kinova_gen3", "robot.urdf"),
    ("kuka_lwr4", "robot.urdf"),
    ("panda", "robot.toml"),
    ("panda", "robot.urdf"),
    ("staubli_tx40", "robot.urdf"),
    ("ur10e_joint_by_joint", "robot.urdf"),
];

/// The Parquet files of a folder as runs.
pub fn read_logs(folder: &Path, robot: &Robot) -> Result<Vec<Run>, LogError> {
    let mut files: Vec<PathBuf> = std::fs::read_dir(folder)
        .unwrap()
        .map(|f| f.unwrap().path())
        .filter(|f| f.extension().is_some_and(|e| e == "parquet"))
        .collect();
    files.sort();
    files.iter().map(|f| read_run(f, robot, &ReadOptions::default())).collect()
}

/// Robot and logs of a recorded arm.
fn recorded(folder: &str, file: &str) -> Option<(Robot, Vec<Run>)> {
    let path = data(folder)?;
    let robot = match file {
        "" => checks::arms::wam(),
        file => Robot::load(&path.join(file)).unwrap().robot,
    };
    let runs = read_logs(&path, &robot).unwrap();
    Some((robot, runs))
}

fn is_heavy(o: &Observation) -> bool {
    o.spoils > Spoils::Nothing && !matches!(o.kind, ObservationKind::AtLimit { .. })
}

#[test]
fn nothing_is_told_of_logs_that_are_right() {
    let mut wrong = Vec::new();
    for (folder, file) in ARMS {
        let Some((robot, runs)) = recorded(folder, file) else { return };
        let alone = runs.iter().map(|run| vec![run.clone()]);
        for set in alone.chain([runs.clone()]) {
            for told in inspect(&robot, &set) {
                let sentence = told.sentence(&robot, &set);
                println!("{folder} {}: {sentence}", set.len());
                if is_heavy(&told) {
                    wrong.push(format!("{folder}, {}: {sentence}", set[0].name));
                }
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}

#[test]
fn nothing_is_told_of_the_logs_of_another_engine() {
    let Some(root) = data("mujoco_wam") else { return };
    let robot = checks::arms::wam();
    let mut wrong = Vec::new();
    for folder in std::fs::read_dir(root).unwrap().map(|f| f.unwrap().path()) {
        let runs = read_logs(&folder, &robot).unwrap();
        let start = Instant::now();
        let told = inspect(&robot, &runs);
        println!("{}: {:.3} s", folder.display(), start.elapsed().as_secs_f64());
        wrong.extend(told.iter().filter(|o| is_heavy(o)).map(|o| o.sentence(&robot, &runs)));
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}
