//! No command opens a socket but `track --live`.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::faults::{COMMANDS, Place, words};
use crate::program::{Answer, plumbline};

/// A library that ends the program it is loaded into where that asks for a socket.
const ALARM: &str = r#"
#include <unistd.h>
int socket(int domain, int type, int protocol) {
    static const char told[] = "a socket is asked for\n";
    (void)!write(2, told, sizeof told - 1);
    _exit(99);
}
"#;

/// The exit code of a program that [`ALARM`] has ended.
const ASKED: i32 = 99;

/// The library, where there is a compiler of C, as there is where a linker of Rust is.
fn alarm(folder: &Path) -> Option<PathBuf> {
    let (source, library) = (folder.join("alarm.c"), folder.join("alarm.so"));
    fs::write(&source, ALARM).unwrap();
    let mut compiler = Command::new("cc");
    compiler.args(["-shared", "-fPIC", "-o"]).arg(&library).arg(&source);
    compiler.status().is_ok_and(|status| status.success()).then_some(library)
}

fn alarmed(alarm: &Path, folder: &Path, arguments: &[&str]) -> Answer {
    let mut command = plumbline();
    command.current_dir(folder).env("LD_PRELOAD", alarm).args(arguments);
    command.output().unwrap().into()
}

#[test]
fn no_command_opens_a_socket_but_track_live() {
    let place = Place::of_files(1);
    let Some(alarm) = alarm(place.path()) else {
        println!("skipped: there is no compiler cc");
        return;
    };
    for (index, (command, _)) in COMMANDS.iter().enumerate() {
        place.prepare(index);
        let answer = alarmed(&alarm, place.path(), &words(index));
        assert!(answer.code <= 1, "{command}: {}", answer.err);
    }
    let others: [&[&str]; 5] = [
        &["robot", "check", "arm.urdf"],
        &["log", "info", "--robot", "arm.urdf", "run_0.csv"],
        &["export", "arm.urdf", "--to", "mjcf", "--out", "exported"],
        &["effects"],
        &["explain", "FR02"],
    ];
    for arguments in others {
        let answer = alarmed(&alarm, place.path(), arguments);
        assert!(answer.code <= 1, "{arguments:?}: {}", answer.err);
    }
    // A viewer may be there or not: it is asked for.
    let live = ["track", "tracking.toml", "--live", "--out", "live"];
    let answer = alarmed(&alarm, place.path(), &live);
    assert_eq!(answer.code, ASKED, "{}", answer.err);
}
