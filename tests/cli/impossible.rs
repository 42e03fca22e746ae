use std::f64::consts::{PI, TAU};
use std::fs;
use std::path::Path;

use rand::SeedableRng;
use rand_chacha::ChaCha8Rng;
use rand_distr::{Distribution, Normal};

use crate::arm::{self, Gap};
use crate::program::{Answer, run};

const FRICTION: Gap = Gap::Friction(1.5);

/// Columns of the log of the arm.
const POSITION: usize = 4;
const EFFORT: usize = 6;

/// A folder with the arm, two logs, and one in which fields of the first were changed.
fn folder(column: usize, change: impl Fn(usize, f64) -> f64) -> tempfile::TempDir {
    let folder = arm::folder(FRICTION);
    let log = arm::log(0, FRICTION);
    let changed = |(row, line): (usize, &str)| {
        let mut fields: Vec<String> = line.split(',').map(str::to_owned).collect();
        if row > 0 {
            fields[column] = format!("{:e}", change(row, fields[column].parse().unwrap()));
        }
        fields.join(",") + "\n"
    };
    let text: String = log.lines().enumerate().map(changed).collect();
    arm::write(folder.path(), "changed.csv", &text);
    folder
}

/// The same with the elbow at an impossible place in row 3001.
fn one(value: f64) -> tempfile::TempDir {
    folder(POSITION, |row, q| if row == 3001 { value } else { q })
}

fn diagnose(folder: &Path) -> Answer {
    let logs = ["--log", "changed.csv", "run_1.csv"];
    run(folder, &[&["diagnose", "--robot", "arm.urdf", "--out", "out"], &logs[..]].concat())
}

/// One line, whatever the width that it was wrapped to.
fn words(answer: &Answer) -> String {
    format!("{} {}", answer.out, answer.err).split_whitespace().collect::<Vec<_>>().join(" ")
}

#[test]
fn one_impossible_position_is_left_out_and_told_and_the_cause_found() {
    for (value, said) in [(100.0, "100"), (1000.0, "1000"), (4_294_967_296.0, "4294967296")] {
        let folder = one(value);
        let answer = diagnose(folder.path());
        assert_eq!(answer.code, 0, "{}{}", answer.out, answer.err);
        assert!(answer.out.contains("FR02 Coulomb friction"), "{}", answer.out);
        let expected =
            format!("column elbow.position, row 3001: found {said}, but joint elbow is at");
        let words = words(&answer);
        assert!(words.contains(&expected), "{words}");
        assert!(words.contains("limited to -2.9 .. 2.9 rad; the row is left out"), "{words}");
    }
}

#[test]
fn every_command_that_reads_logs_leaves_it_out_and_says_so() {
    let folder = one(1e300);
    let path = folder.path();
    let commands: [&[&str]; 4] = [
        &["log", "info", "changed.csv", "--robot", "arm.urdf"],
        &["replay", "--robot", "arm.urdf", "--log", "changed.csv", "--out", "replay"],
        &[
            "learn",
            "--robot",
            "arm.urdf",
            "--train",
            "changed.csv",
            "--test",
            "run_1.csv",
            "--models",
            "cad,rbd",
            "--out",
            "learn",
        ],
        &[
            "compare",
            "--robot",
            "arm.urdf",
            "--before",
            "changed.csv",
            "--after",
            "run_1.csv",
            "--out",
            "compare",
        ],
    ];
    for command in commands {
        let answer = run(path, command);
        assert!(answer.code <= 1, "{command:?}: {answer:?}");
        let words = words(&answer);
        assert!(words.contains("column elbow.position, row 3001: found 1"), "{command:?}: {words}");
    }
}

#[test]
fn one_effort_of_no_drive_is_left_out() {
    let folder = folder(EFFORT, |row, tau| if row == 3001 { 1e300 } else { tau });
    let answer = diagnose(folder.path());
    assert_eq!(answer.code, 0, "{}{}", answer.out, answer.err);
    assert!(words(&answer).contains("column elbow.effort, row 3001"), "{}", answer.out);
}

/// Zeros of lost messages: one row in two hundred is left out, every other row is refused with the way out.
#[test]
fn zeros_of_lost_messages_are_left_out_where_they_are_few_and_refused_where_they_are_many() {
    let few = folder(EFFORT, |row, tau| if row % 200 == 0 { 0.0 } else { tau });
    let answer = diagnose(few.path());
    assert_eq!(answer.code, 0, "{}{}", answer.out, answer.err);
    let told = words(&answer);
    assert!(told.contains("a lost message or another publisher wrote it"), "{told}");
    assert!(told.contains("FR02 Coulomb friction") && !told.contains("DR02"), "{told}");
    let many = folder(EFFORT, |row, tau| if row % 2 == 0 { 0.0 } else { tau });
    let answer = diagnose(many.path());
    assert_eq!((answer.code, answer.out.as_str()), (3, ""));
    assert!(answer.err.contains("changed.csv: column elbow.effort, row"), "{}", answer.err);
    assert!(answer.err.contains("take these rows out of the file"), "{}", answer.err);
}

#[test]
fn many_are_refused_with_the_first_and_their_number() {
    let folder = folder(POSITION, |row, q| if row % 7 == 0 && row > 1000 { 1000.0 } else { q });
    let answer = diagnose(folder.path());
    assert_eq!((answer.code, answer.out.as_str()), (3, ""));
    let expected = "changed.csv: column elbow.position, row 1001: found 1000, but";
    assert!(answer.err.contains(expected), "{}", answer.err);
    assert!(answer.err.contains("715 of 6000 rows are like it, up to 60"), "{}", answer.err);
    assert!(!folder.path().join("out").exists());
}

#[test]
fn an_angle_that_wraps_is_unwrapped_and_told() {
    let folder = folder(POSITION, |_, q| (q + 2.5 + PI).rem_euclid(TAU) - PI);
    let answer = run(folder.path(), &["log", "info", "changed.csv", "--robot", "arm.urdf"]);
    assert_eq!(answer.code, 0, "{}", answer.err);
    assert!(answer.out.contains("the position jumps by full turns"), "{}", answer.out);
    let answer = run(
        folder.path(),
        &["replay", "--robot", "arm.urdf", "--log", "changed.csv", "--out", "out"],
    );
    assert!(answer.code == 0 && answer.out.contains("jumps by full turns"), "{answer:?}");
}

#[test]
fn a_mass_that_no_body_has_is_refused() {
    let folder = arm::folder(FRICTION);
    for mass in ["1e308", "1e7"] {
        let heavy = arm::URDF.replace("mass value=\"2\"", &format!("mass value=\"{mass}\""));
        arm::write(folder.path(), "heavy.urdf", &heavy);
        let answer = run(folder.path(), &["robot", "check", "heavy.urdf"]);
        assert_eq!(answer.code, 3, "{answer:?}");
        assert!(answer.err.contains("link fore: mass is"), "{}", answer.err);
        assert!(answer.err.contains("up to 1e6 kg was expected"), "{}", answer.err);
    }
}

#[test]
fn time_in_nanoseconds_is_replayed_as_such_or_refused() {
    let folder = folder(0, |_, t| (t * 1e9).round());
    let replay = ["replay", "--robot", "arm.urdf", "--log", "changed.csv", "--out", "out"];
    let answer = run(folder.path(), &replay);
    assert!(matches!(answer.code, 0 | 3), "{answer:?}");
    assert!(words(&answer).contains("second"), "{answer:?}");
    let text = fs::read_to_string(folder.path().join("changed.csv")).unwrap();
    assert!(text.lines().nth(2).unwrap().starts_with("5e6,"), "{:?}", text.lines().nth(2));
}

#[test]
fn a_clock_that_does_not_count_in_seconds_is_charged_to_its_own_log() {
    for (unit, count) in [("ms", 1e3), ("us", 1e6), ("ns", 1e9)] {
        let folder = folder(0, |_, t| (t * count).round());
        for logs in [["changed.csv", "run_1.csv"], ["run_1.csv", "changed.csv"]] {
            let words = ["diagnose", "--robot", "arm.urdf", "--out", "out", "--log"];
            let answer = run(folder.path(), &[&words[..], &logs].concat());
            assert_eq!(answer.code, 3, "{answer:?}");
            let expected = format!("its time looks like {unit}, seconds were expected");
            assert!(answer.err.starts_with("error: run changed: its rows are"), "{answer:?}");
            assert!(answer.err.contains(&expected), "{answer:?}");
        }
    }
}

/// A log whose efforts are a walk of both joints, each step one of the normal distribution (N m).
fn walk(run: u32, seed: u64) -> String {
    let mut random = ChaCha8Rng::seed_from_u64(seed);
    let step = Normal::new(0.0, 0.2).unwrap();
    let (log, mut walk) = (arm::log(run, Gap::None), [0.0; 2]);
    let mut lines = log.lines();
    let header = format!("{}\n", lines.next().unwrap());
    let row = |line: &str| {
        let mut fields: Vec<String> = line.split(',').map(str::to_owned).collect();
        for (effort, column) in walk.iter_mut().zip([3, EFFORT]) {
            *effort += step.sample(&mut random);
            fields[column] = effort.to_string();
        }
        fields.join(",") + "\n"
    };
    header + &lines.map(row).collect::<String>()
}

/// Nothing of them follows from the motion, whatever may be named at a joint.
#[test]
fn efforts_of_a_random_walk_are_never_called_explained() {
    for seed in [1, 4, 5] {
        let folder = arm::folder(Gap::None);
        arm::write(folder.path(), "changed.csv", &walk(0, seed));
        arm::write(folder.path(), "run_1.csv", &walk(1, seed + 100));
        let answer = diagnose(folder.path());
        assert_eq!(answer.code, 1, "{seed}: {answer:?}");
        assert!(words(&answer).contains("structure"), "{seed}: {answer:?}");
    }
}

/// A chain of links of a metre.
fn chain(joints: usize) -> String {
    let link = |i: usize| {
        let next = i + 1;
        format!(
            "<link name=\"l{next}\"><inertial><origin xyz=\"0.1 0 0\"/><mass value=\"1\"/>\
             <inertia ixx=\"0.01\" iyy=\"0.01\" izz=\"0.01\" ixy=\"0\" ixz=\"0\" iyz=\"0\"/></inertial></link>\
             <joint name=\"j{next}\" type=\"revolute\"><parent link=\"l{i}\"/><child link=\"l{next}\"/>\
             <origin xyz=\"0.1 0 0\"/><axis xyz=\"0 {} {}\"/>\
             <limit lower=\"-1\" upper=\"1\" effort=\"10\" velocity=\"3\"/></joint>",
            i % 2,
            1 - i % 2
        )
    };
    let links: String = (0..joints).map(link).collect();
    format!("<robot name=\"chain\"><link name=\"l0\"/>{links}</robot>")
}

#[test]
fn a_chain_of_100_joints_is_checked_and_one_of_more_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    for (joints, code) in [(100, 0), (101, 3), (1000, 3)] {
        arm::write(folder.path(), "chain.urdf", &chain(joints));
        let answer = run(folder.path(), &["robot", "check", "chain.urdf"]);
        assert_eq!(answer.code, code, "{joints}: {}", answer.err);
        let expected = format!("{joints} joints that move, up to 100 were expected");
        assert_eq!(answer.err.contains(&expected), joints > 100, "{}", answer.err);
    }
}

/// Stamps of arrival, late by up to ten milliseconds and so by two rows.
#[test]
fn stamps_with_jitter_of_many_rows_are_put_on_an_even_clock() {
    let folder = arm::folder(FRICTION);
    let log = arm::log(0, FRICTION);
    let mut state = 1_u64;
    let mut late = |line: &str| {
        state = state.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1);
        let (time, _) = line.split_once(',').unwrap();
        time.parse::<f64>().unwrap() + 0.02 * (state >> 11) as f64 / (1_u64 << 53) as f64
    };
    let mut stamps: Vec<f64> = log.lines().skip(1).map(&mut late).collect();
    stamps.sort_unstable_by(f64::total_cmp);
    let rows = log.lines().skip(1).zip(stamps);
    let row = |(line, time): (&str, f64)| format!("{time},{}\n", line.split_once(',').unwrap().1);
    let text = format!("{}\n{}", log.lines().next().unwrap(), rows.map(row).collect::<String>());
    arm::write(folder.path(), "changed.csv", &text);
    let start = std::time::Instant::now();
    let answer = diagnose(folder.path());
    assert!(start.elapsed() < std::time::Duration::from_secs(60));
    assert_eq!(answer.code, 0, "{}{}", answer.out, answer.err);
    assert!(answer.out.contains("FR02 Coulomb friction"), "{}", answer.out);
    assert!(words(&answer).contains("ms off an even clock of 5.00"), "{}", answer.out);
}
