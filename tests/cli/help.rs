//! The help of the program and of its commands.

use crate::program::{Answer, plumbline, run};

/// The groups of `plumbline --help` and their commands.
const GROUPS: [(&str, &[&str]); 3] = [
    (
        "Your arm:",
        &["diagnose", "compare", "design", "export", "log", "robot", "explain", "view", "demo"],
    ),
    ("Simulation and research:", &["simulate", "run", "replay", "learn", "track"]),
    ("Shell:", &["completions", "man", "schema"]),
];

/// Every command with options of its own.
const COMMANDS: [&[&str]; 18] = [
    &["diagnose"],
    &["compare"],
    &["design"],
    &["export"],
    &["log", "info"],
    &["robot", "check"],
    &["robot", "init"],
    &["explain"],
    &["view"],
    &["demo"],
    &["simulate"],
    &["run"],
    &["replay"],
    &["learn"],
    &["track"],
    &["completions"],
    &["man"],
    &["schema"],
];

/// The help of a command on a terminal of so many columns.
fn help(command: &[&str], columns: usize) -> String {
    let mut program = plumbline();
    program.args(command).arg("--help").env("COLUMNS", columns.to_string());
    let answer: Answer = program.output().unwrap().into();
    assert_eq!((answer.code, answer.err.as_str()), (0, ""), "{command:?}");
    answer.out
}

/// The lines below a title up to the next empty line.
fn section<'a>(text: &'a str, title: &str) -> Vec<&'a str> {
    let below = text.lines().skip_while(|line| *line != title).skip(1);
    below.take_while(|line| !line.is_empty()).collect()
}

#[test]
fn the_commands_stand_in_groups() {
    let text = help(&[], 100);
    for (title, names) in GROUPS {
        let lines = section(&text, title);
        let found: Vec<&str> = lines
            .iter()
            .filter(|line| !line.starts_with("    "))
            .filter_map(|line| line.split_whitespace().next())
            .collect();
        assert_eq!(found, names, "{title}\n{text}");
    }
    for words in ["Shows a whole run on an arm", "Makes logs alone", "diagnoses its logs, and"] {
        assert!(text.contains(words), "{words} is missing in\n{text}");
    }
    assert!(!text.contains("\n  effects"), "{text}");
}

#[test]
fn no_line_of_a_help_is_wider_than_the_terminal_and_none_is_cut_twice() {
    for command in COMMANDS {
        let wide = help(command, 100);
        for columns in [72, 80, 100, 160] {
            let text = help(command, columns);
            // clap does not wrap the line of the usage.
            let is_long = |line: &&str| {
                line.chars().count() > columns.min(100) && !line.starts_with("Usage: ")
            };
            let long: Vec<&str> = text.lines().filter(is_long).collect();
            assert_eq!(long, [""; 0], "{command:?} at {columns}:\n{text}");
            assert!(columns < 100 || text == wide, "{command:?} at {columns}");
            let words: Vec<&str> = text.split_whitespace().collect();
            assert_eq!(words, wide.split_whitespace().collect::<Vec<_>>(), "{command:?}");
        }
    }
}

/// What a list says of a name begins in one column, on every line.
#[test]
fn what_wraps_in_a_list_stands_below_its_beginning() {
    for (command, columns) in [("compare", 100), ("run", 80), ("diagnose", 80)] {
        let text = help(&[command], columns);
        let lines = section(&text, "The output folder holds");
        assert!(lines[0].starts_with("  report.html "), "{text}");
        let words = &lines[0]["  report.html".len()..];
        let begin = lines[0].len() - words.trim_start().len();
        for line in &lines {
            let indent = line.len() - line.trim_start().len();
            assert!(indent == 2 || indent == begin, "{line:?} in\n{text}");
        }
    }
    let text = help(&["compare"], 100).split_whitespace().collect::<Vec<_>>().join(" ");
    let sentence = "its findings are the changes, and \"was\" is the size before";
    assert!(text.contains(sentence), "{text}");
}

#[test]
fn options_that_many_commands_share_stand_after_the_own_ones() {
    let robot = "Which part of the robot is meant, and its meshes:";
    let logs = "How logs are read:";
    for command in ["diagnose", "compare", "design", "export", "replay", "learn"] {
        let text = help(&[command], 100);
        let at = |words: &str| text.find(words).unwrap_or_else(|| panic!("{words} in\n{text}"));
        assert!(at("\nOptions:\n") < at(robot) && at(robot) < at(logs), "{text}");
        for own in ["--out", "--json", "--help"] {
            assert!(at(own) < at(robot), "{command} {own}\n{text}");
        }
        let shared = ["--joints", "--package", "--allow-outside"];
        assert!(shared.iter().all(|option| at(option) > at(robot)), "{text}");
        let shared = ["--map", "--effort", "--topic", "--episodes", "--from-s", "--all-samples"];
        assert!(shared.iter().all(|option| text.rfind(option) > Some(at(logs))), "{text}");
    }
}

#[test]
fn every_help_has_examples_of_its_command() {
    for command in COMMANDS {
        let text = help(command, 100);
        let begin = format!("  plumbline {}", command.join(" "));
        let lines = section(&text, "Examples:");
        assert!(!lines.is_empty() && lines[0].starts_with(&begin), "{command:?}: {lines:?}");
    }
}

#[test]
fn every_output_folder_has_a_default() {
    for command in COMMANDS {
        let text = help(command, 100).split_whitespace().collect::<Vec<_>>().join(" ");
        let Some((_, out)) = text.split_once("--out <DIR>") else { continue };
        let own = out.split(" --").next().unwrap();
        assert!(own.contains("[default: out/") || command == ["export"], "{command:?}: {own}");
        assert!(!text.contains("--out <DIR> <"), "{command:?}");
        let usage = text.split("Options:").next().unwrap();
        assert!(!usage.contains("--out"), "{command:?}: {usage}");
    }
}

#[test]
fn effects_is_explain_without_an_effect() {
    let folder = tempfile::tempdir().unwrap();
    let list = run(folder.path(), &["explain"]);
    assert_eq!((list.code, list.err.as_str()), (0, ""));
    assert_eq!(run(folder.path(), &["effects"]).out, list.out);
}
