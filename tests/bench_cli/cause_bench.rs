//! CauseBench from outside: sets without their truth, the same bytes anywhere, and answers scored.

use std::collections::BTreeMap;
use std::fs;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

use checks::arms::workspace_root;
use checks::book::can;
use checks::recorded;
use serde_json::{Value, json};

use crate::disk::{Disk, Fault};
use crate::program::{plumbline_bench, run};
use crate::writers::EXPORT;

/// The first trials of the set, without their truth.
fn export(folder: &Path, name: &str, arguments: &[&str]) {
    let few: &[&str] = if arguments.contains(&"--first") { &[] } else { &["--first", "3"] };
    let all = [&["export", "--set", "smoke", "--out", name, "--quiet"], few, arguments].concat();
    let answer = run(folder, &all);
    assert_eq!((answer.code, answer.err.as_str()), (0, ""), "{all:?}");
}

/// Every file below a folder by its path from there, with its content and its time.
fn files(folder: &Path) -> BTreeMap<PathBuf, (Vec<u8>, SystemTime)> {
    let (mut found, mut open) = (BTreeMap::new(), vec![folder.to_owned()]);
    while let Some(next) = open.pop() {
        for entry in fs::read_dir(&next).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                open.push(path);
                continue;
            }
            let time = fs::metadata(&path).unwrap().modified().unwrap();
            let name = path.strip_prefix(folder).unwrap().to_owned();
            found.insert(name, (fs::read(&path).unwrap(), time));
        }
    }
    found
}

fn json_of(path: &Path) -> Value {
    serde_json::from_slice(&fs::read(path).unwrap()).unwrap()
}

/// All numbers in a value.
fn numbers(value: &Value, found: &mut Vec<f64>) {
    match value {
        Value::Number(number) => found.push(number.as_f64().unwrap()),
        Value::Array(all) => all.iter().for_each(|value| numbers(value, found)),
        Value::Object(all) => all.values().for_each(|value| numbers(value, found)),
        _ => {}
    }
}

fn holds(bytes: &[u8], part: &[u8]) -> bool {
    bytes.windows(part.len()).any(|window| window == part)
}

#[test]
fn a_set_has_the_same_bytes_for_any_number_of_jobs_and_one_time() {
    let folder = tempfile::tempdir().unwrap();
    export(folder.path(), "one", &["--jobs", "1"]);
    export(folder.path(), "two", &["--jobs", "2"]);
    let [one, two] = ["one", "two"].map(|name| files(&folder.path().join(name)));
    assert!(one == two && one.len() > 20);
    let times: Vec<&SystemTime> = one.values().map(|(_, time)| time).collect();
    assert!(times.windows(2).all(|pair| pair[0] == pair[1]));
    let truth = |name: &str| fs::read(folder.path().join(name)).unwrap();
    assert!(truth("one.truth.json") == truth("two.truth.json"));
    export(folder.path(), "other", &["--seed", "7"]);
    assert!(truth("one.truth.json") != truth("other.truth.json"));
}

#[test]
fn nothing_of_the_truth_is_in_the_folder_of_a_set() {
    let folder = tempfile::tempdir().unwrap();
    export(folder.path(), "set", &[]);
    let shown = files(&folder.path().join("set"));
    let truth = json_of(&folder.path().join("set.truth.json"));
    let text = |seed: &Value| seed.to_string().into_bytes();
    for trial in truth["trials"].as_object().unwrap().values() {
        let mut hidden = Vec::new();
        for key in ["causes", "strangers"] {
            numbers(&trial["sheet"][key], &mut hidden);
        }
        // A round number may stand anywhere.
        hidden.retain(|number| number.to_string().len() > 8);
        for (path, (bytes, _)) in &shown {
            assert!(!holds(bytes, &text(&trial["sheet"]["seed"])), "{}", path.display());
            for number in &hidden {
                let is_there = holds(bytes, number.to_string().as_bytes())
                    || holds(bytes, &number.to_le_bytes());
                assert!(!is_there, "{} has {number}", path.display());
            }
        }
    }
    let manifest = json_of(&folder.path().join("set/manifest.json"));
    for trial in manifest["trials"].as_array().unwrap() {
        assert_eq!(trial["held_out"]["channels"], json!(["position", "velocity"]));
    }
    let names: Vec<&str> = shown.keys().filter_map(|path| path.to_str()).collect();
    assert!(names.iter().all(|name| !name.contains("sheet") && !name.contains("truth")));
}

/// Bytes of an npz file of columns that are stored as they are: head and values of each, and what a zip says of it.
fn npz_bytes(rows: usize, columns: &[String]) -> usize {
    let [array_head, local_head, central_head, end] = [128, 30, 46, 22];
    let each = |name: &String| {
        array_head + 8 * rows + local_head + central_head + 2 * (name.len() + ".npy".len())
    };
    end + columns.iter().map(each).sum::<usize>()
}

#[test]
fn sizes_of_files_follow_from_rows_and_columns_and_no_trial_from_the_others() {
    let folder = tempfile::tempdir().unwrap();
    export(folder.path(), "set", &[]);
    let set = folder.path().join("set");
    let manifest = json_of(&set.join("manifest.json"));
    let trials = manifest["trials"].as_array().unwrap();
    for trial in trials {
        let joints: Vec<&str> =
            trial["joints"].as_array().unwrap().iter().filter_map(Value::as_str).collect();
        for log in trial["logs"].as_array().unwrap().iter().chain([&trial["held_out"]]) {
            let channels = log["channels"].as_array().unwrap().iter().filter_map(Value::as_str);
            let of_joints = channels.flat_map(|c| joints.iter().map(move |j| format!("{j}.{c}")));
            let columns: Vec<String> =
                std::iter::once("time".to_owned()).chain(of_joints).collect();
            let rows = log["rows"].as_u64().unwrap() as usize;
            let bytes = fs::metadata(set.join(log["npz"].as_str().unwrap())).unwrap().len();
            assert_eq!(bytes as usize, npz_bytes(rows, &columns), "{log}");
        }
    }
    // Neither number nor order of the trials is in them: those of a shorter set are the same, whatever they hide.
    export(folder.path(), "shorter", &["--first", "2"]);
    let shorter = files(&folder.path().join("shorter"));
    let all = files(&set);
    let same = |(path, file): (&PathBuf, &(Vec<u8>, SystemTime))| {
        path.ends_with("manifest.json") || all.get(path) == Some(file)
    };
    assert!(shorter.len() > 10 && shorter.iter().all(same));
    let named = trials.iter().map(|trial| trial["name"].as_str().unwrap());
    assert!(named.eq(["trial_001", "trial_002", "trial_003"]));
}

#[test]
fn a_truth_inside_the_set_and_a_folder_with_files_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let arguments = ["export", "--set", "smoke", "--first", "1", "--out", "set"];
    let answer = run(path, &[&arguments[..], &["--truth", "set/truth.json"]].concat());
    assert_eq!(answer.code, 2);
    assert!(answer.err.contains("one outside of it was expected"), "{}", answer.err);
    fs::write(path.join("set/old"), "").unwrap();
    let answer = run(path, &arguments);
    assert_eq!(answer.code, 2);
    assert!(answer.err.contains("set: a folder with files in it was found"), "{}", answer.err);
}

/// A set whose export is killed once it has files is begun anew, and is the set of an export that nothing disturbed.
#[test]
fn an_export_that_was_killed_is_begun_anew() {
    let folder = tempfile::tempdir().unwrap();
    let arguments = ["export", "--set", "smoke", "--first", "12", "--quiet", "--out", "set"];
    let mut killed = plumbline_bench().args(arguments).current_dir(folder.path()).spawn().unwrap();
    let set = folder.path().join("set");
    let has_trials = || fs::read_dir(&set).is_ok_and(|entries| entries.count() > 1);
    while !has_trials() {
        assert!(killed.try_wait().unwrap().is_none(), "it came to its end without a trial");
        std::thread::sleep(std::time::Duration::from_millis(1));
    }
    killed.kill().unwrap();
    killed.wait().unwrap();
    assert!(!set.join("manifest.json").exists(), "it came to its end");
    export(folder.path(), "set", &[]);
    export(folder.path(), "whole", &[]);
    assert!(files(&set) == files(&folder.path().join("whole")), "another set");
}

#[test]
fn coulomb_friction_everywhere_scores() {
    if !can("python3", &["-c", ""]) {
        println!("no python3 here: the entrant is left out");
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    export(folder.path(), "set", &[]);
    let script = workspace_root().join("tests/benches/entrants/coulomb.py");
    let script = script.to_str().unwrap();
    assert!(can(
        "python3",
        &[
            script,
            folder.path().join("set").to_str().unwrap(),
            folder.path().join("coulomb").to_str().unwrap()
        ]
    ));
    let answer =
        run(folder.path(), &["score", "set", "coulomb", "--truth", "set.truth.json", "--json"]);
    assert_eq!((answer.code, answer.err.as_str()), (0, ""));
    let scores: Value = serde_json::from_str(&answer.out).unwrap();
    let all = &scores["rows"][0];
    assert_eq!((&scores["entrant"], &all["count"]), (&json!("coulomb"), &json!(3)));
    assert!(all["name"]["value"].as_f64().unwrap() > 0.1, "{all}");
    assert_eq!(all["predict"]["value"], json!(1.0));
    let answer = run(folder.path(), &["score", "set", "coulomb", "--truth", "set.truth.json"]);
    assert!(answer.out.starts_with("coulomb of smoke: task, number"), "{}", answer.out);
}

#[test]
fn an_answer_that_is_no_json_is_told_and_is_a_gap() {
    let folder = tempfile::tempdir().unwrap();
    export(folder.path(), "set", &[]);
    fs::create_dir(folder.path().join("me")).unwrap();
    fs::write(
        folder.path().join("me/trial_001.json"),
        "{\"names\": [{\"effect\": \"\\u001b[2J\"}]}",
    )
    .unwrap();
    let answer = run(folder.path(), &["score", "set", "me", "--truth", "set.truth.json"]);
    assert_eq!((answer.code, answer.err.as_str()), (1, ""));
    assert!(answer.out.contains("3 count as nothing said:"), "{}", answer.out);
    assert!(!answer.out.contains('\u{1b}') && answer.out.contains("[2J"), "{}", answer.out);
}

/// Real arms: the held-out efforts are predicted, names count nowhere.
#[test]
fn logs_of_real_arms_are_a_set_whose_causes_nobody_knows() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    let export = ["export", "--set", "recorded", "--out", "set", "--quiet"];
    let answer = run(path, &export);
    assert_eq!(answer.code, 2);
    assert!(answer.err.contains("--data <DIR>"), "{}", answer.err);
    let answer = run(path, &[&export[..], &["--data", "nowhere"]].concat());
    assert_eq!(answer.code, 2);
    assert!(answer.err.contains("nowhere"), "{}", answer.err);
    let Some(data) = recorded::folder() else { return };
    let some = ["--data", data.to_str().unwrap(), "--first", "2"];
    let answer = run(path, &[&export[..], &some].concat());
    assert_eq!((answer.code, answer.err.as_str()), (0, ""));
    let manifest = json_of(&path.join("set/manifest.json"));
    fs::create_dir(path.join("me")).unwrap();
    for trial in manifest["trials"].as_array().unwrap() {
        let channels = trial["held_out"]["channels"].as_array().unwrap();
        assert!(!channels.contains(&json!("effort")), "{channels:?}");
        let named = json!({"names": [{"effect": "FR02", "joint": trial["joints"][0]}]});
        let file = format!("me/{}.json", trial["name"].as_str().unwrap());
        fs::write(path.join(file), named.to_string()).unwrap();
    }
    let answer = run(path, &["score", "set", "me", "--truth", "set.truth.json", "--json"]);
    assert_eq!((answer.code, answer.err.as_str()), (0, ""));
    let scores: Value = serde_json::from_str(&answer.out).unwrap();
    let all = &scores["rows"][0];
    for task in ["name", "true_names", "named", "size", "abstain"] {
        assert_eq!(all[task]["items"], json!(0), "{task}: {all}");
    }
    assert_eq!((&all["predict"]["value"], &all["predict"]["of"]), (&json!(1.0), &json!(2)));
}

/// The properties of an object of a schema, with those of the objects that it refers to, and none open to others.
fn keys(schema: &Value, object: &Value) -> Vec<String> {
    assert_eq!(object["additionalProperties"], json!(false), "{object}");
    let mut found = Vec::new();
    for (name, property) in object["properties"].as_object().unwrap() {
        found.push(name.clone());
        let kind = property["items"]["$ref"].as_str().and_then(|to| to.rsplit('/').next());
        let below = kind.map(|kind| keys(schema, &schema["$defs"][kind])).unwrap_or_default();
        found.extend(below.into_iter().map(|key| format!("{name}.{key}")));
    }
    found
}

#[test]
fn the_schema_of_answers_has_every_key_that_is_read_and_no_other() {
    let folder = tempfile::tempdir().unwrap();
    let answer = run(folder.path(), &["schema", "answers"]);
    assert_eq!((answer.code, answer.err.as_str()), (0, ""));
    let schema: Value = serde_json::from_str(&answer.out).unwrap();
    let mut found = keys(&schema, &schema);
    found.sort();
    let expected = [
        "left_open",
        "model",
        "names",
        "names.effect",
        "names.joint",
        "names.link",
        "names.rivals",
        "names.rivals.effect",
        "names.rivals.joint",
        "names.rivals.link",
        "names.sizes",
        "names.sizes.described",
        "names.sizes.interval",
        "names.sizes.parameter",
        "names.sizes.value",
        "prediction",
        "refused",
        "seconds",
    ];
    assert_eq!(found, expected);
    assert_eq!(schema["$defs"]["NamedCause"]["required"], json!(["effect"]));
    let answer = run(folder.path(), &["schema", "manifest"]);
    let schema: Value = serde_json::from_str(&answer.out).unwrap();
    assert!(schema["properties"]["truth_sha256"].is_object(), "{schema}");
}

#[test]
fn the_page_of_the_book_is_the_one_of_the_program() {
    let root = workspace_root();
    let folder = fs::read_dir(root.join("docs/cause_bench")).unwrap();
    let mut files: Vec<PathBuf> = folder.map(|entry| entry.unwrap().path()).collect();
    files.sort();
    let files: Vec<&str> = files.iter().map(|file| file.to_str().unwrap()).collect();
    let answer = run(&root, &[&["board"], &files[..]].concat());
    assert_eq!((answer.code, answer.err.as_str()), (0, ""));
    let page = fs::read_to_string(checks::book::folder().join("benchmark.md")).unwrap();
    let anew =
        format!("plumbline-bench board {} > docs/src/benchmark.md makes it anew", files.join(" "));
    assert!(page == answer.out, "{anew}");
}

/// The disk fails at each read of an answer and of its prediction: the score, which would count nothing said, is not told.
#[test]
fn an_answer_that_the_disk_refuses_has_no_score() {
    let Some(disk) = Disk::build() else {
        println!("skipped: there is no compiler cc");
        return;
    };
    let folder = tempfile::tempdir().unwrap();
    let made = run(folder.path(), &EXPORT.split(' ').collect::<Vec<_>>());
    assert_eq!(made.code, 0, "{}", made.err);
    let answers = folder.path().join("out/answers");
    fs::create_dir(&answers).unwrap();
    fs::copy(folder.path().join("out/set/trial_001/held_out.npz"), answers.join("one.npz"))
        .unwrap();
    fs::write(answers.join("trial_001.json"), r#"{"prediction": "one.npz"}"#).unwrap();
    let score = ["score", "out/set", "out/answers", "--truth", "out/set.truth.json"];
    let (whole, calls) = disk.run(folder.path(), &score, None);
    let first_read = |file: &str| {
        let of_file =
            |call: &&crate::disk::Call| call.operation == "read" && call.path.ends_with(file);
        calls.iter().find(of_file).unwrap()
    };
    for file in ["trial_001.json", "one.npz"] {
        let call = first_read(file);
        let (answer, _) = disk.run(folder.path(), &score, Some((call.number, Fault::Broken)));
        assert_eq!(answer.code, 2, "{file}: {} instead of {}", answer.err, whole.out);
        assert!(answer.err.contains(file) && answer.out.is_empty(), "{}", answer.err);
    }
}
