//! A library that ends a program which asks for a socket.

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

use crate::program::{Answer, PROGRAM};

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
pub const ASKED: i32 = 99;

/// The library, where there is a compiler of C, as there is where a linker of Rust is.
pub fn alarm(folder: &Path) -> Option<PathBuf> {
    let (source, library) = (folder.join("alarm.c"), folder.join("alarm.so"));
    fs::write(&source, ALARM).unwrap();
    let mut compiler = Command::new("cc");
    compiler.args(["-shared", "-fPIC", "-o"]).arg(&library).arg(&source);
    compiler.status().is_ok_and(|status| status.success()).then_some(library)
}

pub fn alarmed(alarm: &Path, folder: &Path, arguments: &[&str]) -> Answer {
    let mut command = Command::new(PROGRAM);
    command.current_dir(folder).env("LD_PRELOAD", alarm).args(arguments);
    command.output().unwrap().into()
}
