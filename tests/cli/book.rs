//! The book: every command in it is run as a reader types it, and prints what the book shows.

use std::fs;
use std::os::unix::fs::symlink;
use std::path::{Path, PathBuf};
use std::process::Command;

use checks::arms::workspace_root;
use checks::book::{Page, blocks, can, missing, pages, reader};
use checks::lerobot::{Layout, write};
use logs::{Channel, ReadOptions, Run, read_run};
use robot::Robot;

use crate::program::{Answer, run};
use crate::servo::as_goals;

/// Commands of a block, a line with a backslash at its end together with the next.
fn commands(block: &str) -> Vec<String> {
    let joined = block.replace("\\\n", " ");
    joined.lines().filter(|line| !line.starts_with('#')).map(str::to_owned).collect()
}

/// Runs a line with the program on the path.
fn typed(line: &str, folder: &Path, path: &str) -> Answer {
    if line.contains("dataset.py") && !can("python3", &["-c", "import pyarrow"]) {
        return dataset(line, folder);
    }
    let mut shell = Command::new("bash");
    shell.args(["-c", line]).current_dir(folder).env("PATH", path).env_remove("CLICOLOR_FORCE");
    shell.output().unwrap().into()
}

/// Does what the script does where there is no pyarrow for it: `python3 SCRIPT ROBOT STEP FOLDER LOG ...`.
fn dataset(line: &str, folder: &Path) -> Answer {
    println!("no pyarrow here: the dataset is written by the tests instead of {line}");
    let words: Vec<&str> = line.split_whitespace().skip(2).collect();
    let (&[robot, step, set], logs) = words.split_first_chunk().unwrap();
    let robot = Robot::load(&folder.join(robot)).unwrap().robot;
    let read = |log: &&str| {
        let run = read_run(&folder.join(log), &robot, &ReadOptions::default()).unwrap();
        as_goals(thinned(run, step.parse().unwrap()))
    };
    let runs: Vec<Run> = logs.iter().map(read).collect();
    let left_out = [Channel::Effort, Channel::Velocity];
    write(&folder.join(set), &runs, Layout::FileAnEpisode, &left_out);
    Answer { code: 0, out: String::new(), err: String::new() }
}

/// Every `step`-th row.
fn thinned(mut run: Run, step: usize) -> Run {
    let thin = |samples: &mut Vec<f64>| *samples = samples.iter().copied().step_by(step).collect();
    thin(&mut run.time);
    for joint in &mut run.joints {
        thin(&mut joint.position);
        [&mut joint.desired_position, &mut joint.desired_velocity]
            .into_iter()
            .flatten()
            .for_each(thin);
    }
    run
}

/// Runs the commands of a page and holds what they print against what the page shows behind them.
fn hold(name: &str) {
    let page = pages().into_iter().find(|page| page.name == name).unwrap();
    if page.text.contains("python3 ") && !can("python3", &["-c", ""]) {
        println!("no python3 here: {name} is left out");
        return;
    }
    let folder = reader(&page);
    let programs = tempfile::tempdir().unwrap();
    symlink(env!("CARGO_BIN_EXE_plumbline"), programs.path().join("plumbline")).unwrap();
    let path = format!("{}:{}", programs.path().display(), std::env::var("PATH").unwrap());
    // What a block of Python prints is held by `tests/python`.
    let mut printed = None;
    for block in blocks(&page.text) {
        match (block.language.as_str(), block.tag.as_str()) {
            ("sh", "run") => printed = Some(told(&page, &block.text, folder.path(), &path)),
            ("python", _) => printed = None,
            ("text", "printed") => {
                let Some(printed) = &printed else { continue };
                let absent = missing(&block.text, printed);
                assert!(absent.is_none(), "{name}: {absent:?} is not in\n{printed}");
            }
            _ => {}
        }
    }
}

/// What the commands of a block print. They end with 0, or with 1 where something is left.
fn told(page: &Page, block: &str, folder: &Path, path: &str) -> String {
    let of = |line: &String| {
        let answer = typed(line, folder, path);
        assert!(answer.code <= 1, "{}: {line}\n{}", page.name, answer.err);
        answer.out + &answer.err
    };
    commands(block).iter().map(of).collect()
}

#[test]
fn an_arm_goes_from_its_urdf_to_an_mjcf() {
    hold("ten-minutes.md");
}

#[test]
fn the_program_that_was_installed_is_of_this_version() {
    hold("install.md");
}

#[test]
fn a_first_log_is_looked_at_and_diagnosed() {
    hold("first-log.md");
}

#[test]
fn a_bag_becomes_an_mjcf() {
    hold("ur-arm.md");
}

#[test]
fn a_servo_arm_is_diagnosed_from_a_dataset() {
    hold("hobby-arm.md");
}

#[test]
fn a_payload_is_what_changed() {
    hold("payload.md");
}

#[test]
fn every_page_with_commands_is_held() {
    let held =
        ["install.md", "ten-minutes.md", "first-log.md", "ur-arm.md", "hobby-arm.md", "payload.md"];
    let with_commands = |page: &Page| blocks(&page.text).iter().any(|block| block.language == "sh");
    let names: Vec<String> = pages().into_iter().filter(with_commands).map(|p| p.name).collect();
    assert_eq!(names, held);
}

#[test]
fn the_catalogue_is_the_one_of_the_program() {
    let answer = run(&workspace_root(), &["explain", "--markdown"]);
    let path: PathBuf = checks::book::folder().join("effects.md");
    let page = fs::read_to_string(&path).unwrap();
    assert!(page == answer.out, "plumbline explain --markdown > docs/src/effects.md makes it anew");
}
