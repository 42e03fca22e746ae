//! The module of Python, loaded as its users load it. Where there is no `python3` with NumPy, the test says
//! so and is left out.
#![allow(clippy::unwrap_used, reason = "a helper that fails is a test that fails")]

use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;

/// The folder of the workspace's manifest.
fn root() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..").canonicalize().unwrap()
}

/// The library as cargo has just built it for this test: the newest of the places it is put.
fn library() -> PathBuf {
    let deps = std::env::current_exe().unwrap().parent().unwrap().to_owned();
    let name =
        format!("{}_plumbline{}", std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX);
    let places = [deps.join(&name), deps.join("..").join(&name)];
    let made = |path: &PathBuf| fs::metadata(path).and_then(|data| data.modified()).ok();
    places.into_iter().filter(|path| path.exists()).max_by_key(made).unwrap()
}

/// Whether a command of Python ends well.
fn python_can(code: &str) -> bool {
    Command::new("python3").args(["-c", code]).output().is_ok_and(|o| o.status.success())
}

#[test]
fn the_module_does_what_it_says() {
    if !python_can("import numpy, sys; assert sys.version_info >= (3, 10)") {
        eprintln!("no python3 of 3.10 or later with NumPy here: the module is left untested");
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let package = folder.path().join("plumbline");
    fs::create_dir(&package).unwrap();
    for entry in fs::read_dir(root().join("crates/python/python/plumbline")).unwrap() {
        let entry = entry.unwrap();
        if entry.file_type().unwrap().is_file() {
            fs::copy(entry.path(), package.join(entry.file_name())).unwrap();
        }
    }
    let extension = if cfg!(windows) { "pyd" } else { "abi3.so" };
    fs::copy(library(), package.join(format!("_plumbline.{extension}"))).unwrap();
    let ended = Command::new("python3")
        .arg(root().join("tests/python/test_module.py"))
        .env("PYTHONPATH", folder.path())
        .env("PYTHONDONTWRITEBYTECODE", "1")
        .env("PLUMBLINE_ROOT", root())
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&ended.stderr);
    assert!(ended.status.success(), "{said}");
    eprintln!("{said}");
}
