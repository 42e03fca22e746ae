//! Datasets of LeRobot from the command line.

use std::fs;
use std::path::Path;

use checks::lerobot::{Layout, write};
use logs::{ReadOptions, Run, read_run};
use robot::Robot;
use serde_json::Value;

use crate::arm::{self, Gap};
use crate::program::run;

/// What a diagnosis of these logs finds.
fn findings(folder: &Path, logs: &[&str]) -> Value {
    let answer = run(
        folder,
        &[&["diagnose", "--robot", "arm.urdf", "--out", "out", "--log"], logs].concat(),
    );
    assert!(answer.code <= 1, "{}", answer.err);
    let text = fs::read_to_string(folder.join("out/diagnosis.json")).unwrap();
    serde_json::from_str::<Value>(&text).unwrap()["findings"].take()
}

fn runs(folder: &Path) -> Vec<Run> {
    let robot = Robot::from_urdf(arm::URDF).unwrap();
    let read = |k: usize| {
        let path = folder.join(format!("run_{k}.csv"));
        read_run(&path, &robot, &ReadOptions::default()).unwrap()
    };
    (0..3).map(read).collect()
}

#[test]
fn a_friction_is_found_in_a_dataset_as_it_is_in_files() {
    let folder = arm::folder(Gap::Friction(2.0));
    let of_files = findings(folder.path(), &["run_0.csv", "run_1.csv", "run_2.csv"]);
    assert!(of_files.to_string().contains("coulomb_friction"), "{of_files}");
    for layout in [Layout::FileAnEpisode, Layout::OneFile] {
        let name = format!("{layout:?}");
        write(&folder.path().join(&name), &runs(folder.path()), layout, &[]);
        assert_eq!(findings(folder.path(), &[&name]), of_files, "{name}");
    }
}

/// Positions in per cent of the calibrated range, which LeRobot writes by default, and which no unit converts.
#[test]
fn positions_that_are_no_radians_may_be_degrees_or_normalised() {
    let folder = arm::folder(Gap::None);
    let mut runs = runs(folder.path());
    let joints = runs.iter_mut().flat_map(|run| &mut run.joints);
    joints.for_each(|joint| joint.position.iter_mut().for_each(|q| *q *= 60.0));
    write(&folder.path().join("set"), &runs, Layout::OneFile, &[]);
    let refused = run(folder.path(), &["log", "info", "set", "--robot", "arm.urdf"]);
    assert_eq!(refused.code, 3, "{refused:?}");
    for expected in ["unit = \"deg\"", "normalised to -100 .. 100", "scale = (b - a) / 200"] {
        assert!(refused.err.contains(expected), "{expected} is missing in\n{}", refused.err);
    }
}

#[test]
fn episodes_are_chosen_and_one_that_is_not_there_is_told() {
    let folder = arm::folder(Gap::None);
    write(&folder.path().join("set"), &runs(folder.path()), Layout::OneFile, &[]);
    let info = |more: &[&str]| {
        run(folder.path(), &[&["log", "info", "set", "--robot", "arm.urdf"], more].concat())
    };
    let all = info(&[]);
    assert!(all.err.contains("columns are read as --map lerobot"), "{}", all.err);
    assert_eq!(all.out.matches("set (episode ").count(), 3, "{}", all.out);
    let some = info(&["--episodes", "0,2-9"]);
    assert!(some.out.contains("(episode 0)") && some.out.contains("(episode 2)"), "{}", some.out);
    assert!(!some.out.contains("(episode 1)"), "{}", some.out);
    let none = info(&["--episodes", "3-9"]);
    assert_eq!(none.code, 3, "{none:?}");
    assert!(none.err.contains("none of the episodes that --episodes asks for"), "{}", none.err);
    assert_eq!(info(&["--episodes", "2-1"]).code, 2);
    let file = run(folder.path(), &["log", "info", "run_0.csv", "--episodes", "0"]);
    assert_eq!(file.code, 3, "{file:?}");
}
