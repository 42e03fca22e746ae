//! Whatever is named: every option, key and attribute that names a file, with everything that is no such file.

use std::fs::{self, File};
use std::os::unix::fs::symlink;
use std::path::Path;
use std::process::{Command, Stdio};
use std::thread::sleep;
use std::time::{Duration, Instant};

use checks::named_keys::{KEYS, WORDS};

use crate::arm::{self, Gap};
use crate::program::{Answer, PROGRAM};

/// A line of a file that nobody may see.
const SECRET: &str = "root:x:0:0:of nobody's business\n";
/// Within this time every answer is there.
const PATIENCE: Duration = Duration::from_secs(60);

/// What a name may lead to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Found {
    Pipe,
    Passwords,
    Zeros,
    Folder,
    LinkOut,
    Nothing,
    /// 65 MiB.
    Large,
}

pub const ALL: [Found; 7] = [
    Found::Pipe,
    Found::Passwords,
    Found::Zeros,
    Found::Folder,
    Found::LinkOut,
    Found::Nothing,
    Found::Large,
];

/// Puts it under the name `named` into a folder.
pub fn place(folder: &Path, found: Found) {
    let path = folder.join("named");
    match found {
        Found::Pipe => assert!(Command::new("mkfifo").arg(&path).status().unwrap().success()),
        Found::Passwords => arm::write(folder, "named", &SECRET.repeat(20)),
        Found::Zeros => symlink("/dev/zero", &path).unwrap(),
        Found::Folder => fs::create_dir(&path).unwrap(),
        Found::LinkOut => symlink("../secret", &path).unwrap(),
        Found::Nothing => {}
        Found::Large => File::create(&path).unwrap().set_len(65 << 20).unwrap(),
    }
}

/// The answer of the program, which is ended where it takes too long.
pub fn run(folder: &Path, arguments: &[String]) -> Answer {
    let mut child = checks::program::command(PROGRAM)
        .current_dir(folder)
        .args(arguments)
        .stdin(Stdio::null())
        .stdout(File::create(folder.join("stdout")).unwrap())
        .stderr(File::create(folder.join("stderr")).unwrap())
        .spawn()
        .unwrap();
    let start = Instant::now();
    while child.try_wait().unwrap().is_none() {
        let waits = start.elapsed() > PATIENCE;
        if waits {
            child.kill().unwrap();
            child.wait().unwrap();
        }
        assert!(!waits, "{arguments:?} waits");
        sleep(Duration::from_millis(2));
    }
    let text = |name: &str| String::from_utf8(fs::read(folder.join(name)).unwrap()).unwrap();
    let code = child.wait().unwrap().code().unwrap_or(-1);
    Answer { code, out: text("stdout"), err: text("stderr") }
}

/// A folder with an arm and its logs in `inside`, and a secret beside that.
pub fn prepared() -> tempfile::TempDir {
    let around = tempfile::tempdir().unwrap();
    arm::write(around.path(), "secret", &SECRET.repeat(20));
    let inside = around.path().join("inside");
    fs::create_dir_all(inside.join("diagnosis")).unwrap();
    arm::write(&inside, "arm.urdf", arm::URDF);
    arm::write(&inside, "diagnosis/extended.toml", "urdf = \"../arm.urdf\"\n");
    (0..2).for_each(|k| arm::write(&inside, &format!("run_{k}.csv"), &arm::log(k, Gap::None)));
    around
}

/// What is wrong with the answers to a key that names each of what is no file.
fn broken_by(inside: &Path, key: &str, written: &str, arguments: &[&str]) -> Vec<String> {
    let file = match written.chars().next() {
        Some('{') => "diagnosis/diagnosis.json",
        Some('<') => "x.toml.xml",
        _ => "x.toml",
    };
    arm::write(inside, file, &written.replace('X', "named"));
    let named = |word: &&str| if *word == "X" { "named".to_owned() } else { (*word).to_owned() };
    let arguments: Vec<String> = arguments.iter().map(named).collect();
    let mut broken = Vec::new();
    for found in ALL {
        place(inside, found);
        let answer = run(inside, &arguments);
        let said = format!("{}{}", answer.out, answer.err);
        let is_shown = said.contains("nobody") || said.contains("root:");
        if !matches!(answer.code, 2 | 3) || is_shown || !said.contains("named") {
            broken.push(format!("{key}, {found:?}: {answer:?}"));
        }
        let path = inside.join("named");
        let _ = if path.is_dir() { fs::remove_dir_all(path) } else { fs::remove_file(path) };
    }
    broken
}

#[test]
fn what_is_no_file_is_refused_by_name_and_nothing_of_it_is_shown() {
    let keys = KEYS.iter().map(|(path, owner, field, of)| (format!("{path} {owner} {field}"), *of));
    let words = WORDS.iter().map(|(word, of)| ((*word).to_owned(), *of));
    let around = prepared();
    let inside = around.path().join("inside");
    let (mut broken, mut count) = (Vec::new(), 0);
    for (key, of) in keys.chain(words) {
        if let Some((written, arguments)) = of.read_by(PROGRAM) {
            broken.extend(broken_by(&inside, &key, written, arguments));
            count += ALL.len();
        }
    }
    let least = if PROGRAM.ends_with("-bench") { 48 } else { 200 };
    assert!(count > least, "{count}");
    assert!(broken.is_empty(), "{}", broken.join("\n"));
}
