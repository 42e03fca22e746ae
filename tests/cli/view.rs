use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

use crate::program::{Answer, plumbline, run};

/// A folder with these files, all empty.
fn folder(files: &[&str]) -> tempfile::TempDir {
    let folder = tempfile::tempdir().unwrap();
    files.iter().for_each(|name| fs::write(folder.path().join(name), "").unwrap());
    folder
}

/// A program of the search path that answers `--version` and otherwise leaves its arguments in
/// a file.
fn program(folder: &Path, name: &str, version: &str) {
    let told = folder.join(format!("{name}.txt"));
    let script = format!(
        "#!/bin/sh\nif [ \"$1\" = --version ]; then echo '{version}'; exit; fi\n\
         echo \"$@\" > '{0}.new' && /bin/mv '{0}.new' '{0}'\n",
        told.display()
    );
    let path = folder.join(name);
    fs::write(&path, script).unwrap();
    #[cfg(unix)]
    {
        use std::os::unix::fs::PermissionsExt;
        fs::set_permissions(&path, fs::Permissions::from_mode(0o755)).unwrap();
    }
}

/// The answer where no programs are known but those of a folder.
fn view(programs: &Path, folder: &Path) -> Answer {
    let mut command = plumbline();
    let answer = command.env("PATH", programs).arg("view").arg(folder).output();
    answer.unwrap().into()
}

/// What a program that was left running was given.
fn arguments_of(programs: &Path, name: &str) -> String {
    let told = programs.join(format!("{name}.txt"));
    let start = Instant::now();
    while !told.exists() && start.elapsed() < Duration::from_secs(60) {
        std::thread::yield_now();
    }
    fs::read_to_string(told).unwrap()
}

#[test]
fn what_would_be_opened_is_named_and_not_opened() {
    let folder = folder(&["b.rrd", "recording.rrd", "report.html", "tracking.json"]);
    let answer = run(folder.path(), &["view", ".", "--print"]);
    let expected = "report     ./report.html\n\
                    recording  ./b.rrd\n\
                    recording  ./recording.rrd\n";
    assert_eq!((answer.code, answer.out.as_str(), answer.err.as_str()), (0, expected, ""));
}

#[test]
fn a_folder_with_nothing_to_look_at_is_an_error_that_names_what_it_holds() {
    let folder = folder(&["tracking.json", "log.parquet"]);
    let answer = run(folder.path(), &["view", "."]);
    assert_eq!(answer.code, 3);
    let expected = "error: .: a report.html or a recording (.rrd) was expected, \
                    found log.parquet, tracking.json\n";
    assert_eq!(answer.err, expected);
    let answer = run(folder.path(), &["view", "missing"]);
    assert_eq!(answer.code, 3);
    assert!(answer.err.starts_with("error: missing: it cannot be listed ("), "{}", answer.err);
    let answer = run(folder.path(), &["view", "log.parquet"]);
    assert_eq!(answer.code, 3);
}

#[test]
fn a_recording_without_its_viewer_says_how_to_get_one() {
    let (nothing, alone) = (folder(&[]), folder(&["recording.rrd"]));
    let answer = view(nothing.path(), alone.path());
    assert_eq!(answer.code, 2);
    for expected in ["recording.rrd: the program rerun", "pip install rerun-sdk==0.36.3"] {
        assert!(answer.err.contains(expected), "{expected} is missing in\n{}", answer.err);
    }
}

#[cfg(target_os = "linux")]
#[test]
fn report_and_recordings_are_given_to_their_programs() {
    let (programs, output) = (folder(&[]), folder(&["a.rrd", "b.rrd", "report.html"]));
    let path = |name: &str| output.path().join(name).display().to_string();
    program(programs.path(), "xdg-open", "");
    let answer = view(programs.path(), output.path());
    assert_eq!(answer.code, 0, "{}", answer.err);
    assert!(answer.err.contains("cargo install rerun-cli --version 0.36.3"), "{}", answer.err);
    assert_eq!(arguments_of(programs.path(), "xdg-open"), format!("{}\n", path("report.html")));

    program(programs.path(), "rerun", "rerun_py 0.36.3 [rustc 1.92.0]");
    let answer = view(programs.path(), output.path());
    assert_eq!((answer.code, answer.err.as_str()), (0, ""));
    let expected = format!("{} {}\n", path("a.rrd"), path("b.rrd"));
    assert_eq!(arguments_of(programs.path(), "rerun"), expected);

    program(programs.path(), "rerun", "rerun_py 0.41.0 [rustc 1.98.0]");
    let answer = view(programs.path(), output.path());
    assert_eq!(answer.code, 0);
    let expected = "warning: rerun 0.41.0 was found, the recordings are written for 0.36";
    assert!(answer.err.starts_with(expected), "{}", answer.err);
}

#[cfg(target_os = "linux")]
#[test]
fn a_report_that_no_program_opens_is_an_error_with_its_path() {
    let (nothing, output) = (folder(&[]), folder(&["report.html"]));
    let answer = view(nothing.path(), output.path());
    assert_eq!(answer.code, 2);
    assert!(answer.err.contains("report.html: it cannot be opened"), "{}", answer.err);
}
