//! The wheel that a user builds and installs, from the dependencies of the workspace's build: maturin, where it is, makes
//! it of the tree; an environment without Rust has it from there.

use std::os::unix::fs::PermissionsExt;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Instant;
use std::{env, fs};

use checks::arms::workspace_root;
use checks::book::{can, pages};

use crate::{NUMPY, book, library};

/// Most that a wheel is (bytes).
const LARGEST: u64 = 25_000_000;

/// Longest that the import of the module takes beside NumPy (s), the best of some.
const LONGEST_IMPORT_S: f64 = 0.3;
const IMPORTS: usize = 5;

/// What an installed module says of its import.
const IMPORT: &str = "import time, numpy; begin = time.perf_counter(); import plumbline; print(time.perf_counter() - begin)";

/// Stands before cargo. maturin names an interpreter to pyo3, which a library for every Python from 3.10 on has no use
/// for; without that, and on the same path, the dependencies are those that are there.
const CARGO: &str = "#!/bin/sh
PATH=$PLUMBLINE_PATH
unset PYO3_PYTHON PYO3_CONFIG_FILE PYO3_ENVIRONMENT_SIGNATURE PYO3_BUILD_EXTENSION_MODULE PYTHON_SYS_EXECUTABLE
exec \"$PLUMBLINE_CARGO\" \"$@\"
";

/// Ends with what it wrote; where it fails, the test does.
fn done(command: &mut Command) -> String {
    let ended = command.output().unwrap();
    let (said, told) = (ended.stdout, String::from_utf8_lossy(&ended.stderr).into_owned());
    let said = String::from_utf8(said).unwrap();
    assert!(ended.status.success(), "{command:?}: {said}{told}");
    said
}

/// Variables that cargo gives to a test; build scripts of dependencies run again where they differ.
const OF_CARGO: [&str; 2] = ["CARGO_PKG_", "CARGO_MANIFEST_"];

/// Builds the wheel into a folder; none where this test is not of a release build, whose dependencies it would build.
fn built(folder: &Path) -> Option<PathBuf> {
    let program = env::current_exe().unwrap();
    let profile = program.parent().and_then(Path::parent).unwrap();
    if !profile.ends_with("release") {
        println!("this is no release build: the wheel is left unbuilt");
        return None;
    }
    let cargo = folder.join("cargo");
    fs::write(&cargo, CARGO).unwrap();
    fs::set_permissions(&cargo, fs::Permissions::from_mode(0o755)).unwrap();
    let root = workspace_root();
    let mut maturin = Command::new("maturin");
    for (name, _) in env::vars_os() {
        if OF_CARGO.iter().any(|of| name.to_string_lossy().starts_with(of)) {
            maturin.env_remove(name);
        }
    }
    done(
        maturin
            .args(["build", "--release", "--offline", "--manifest-path"])
            .arg(root.join("crates/python/Cargo.toml"))
            .arg("--out")
            .arg(folder)
            .env("CARGO", &cargo)
            .env("PLUMBLINE_PATH", env::var_os("PATH").unwrap_or_default())
            .env("PLUMBLINE_CARGO", env::var_os("CARGO").unwrap_or_else(|| "cargo".into()))
            .env("CARGO_TARGET_DIR", profile.parent().unwrap()),
    );
    let files = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
    files.into_iter().find(|path| path.extension().is_some_and(|e| e == "whl"))
}

/// A fresh environment with the wheel, and NumPy from the one outside.
fn installed(wheel: &Path, folder: &Path) -> PathBuf {
    let environment = folder.join("environment");
    done(Command::new("python3").args(["-m", "venv", "--system-site-packages"]).arg(&environment));
    let python = environment.join("bin/python");
    done(Command::new(&python).args(["-m", "pip", "install", "-q", "--no-index"]).arg(wheel));
    environment.join("bin")
}

/// A program of the environment, which finds neither cargo nor rustc.
fn program(bin: &Path, name: &str) -> Command {
    let mut command = Command::new(bin.join(name));
    command.env("PATH", "/usr/bin:/bin").env_remove("PYTHONPATH");
    command
}

#[test]
fn a_wheel_installs_without_rust_and_names_what_is_hidden() {
    let has_venv = "import venv, ensurepip";
    if !can("maturin", &["--version"])
        || !can("python3", &["-c", NUMPY])
        || !can("python3", &["-c", has_venv])
    {
        println!("no maturin, NumPy or venv here: the wheel is left unbuilt");
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    library();
    let begin = Instant::now();
    let Some(wheel) = built(folder.path()) else { return };
    let name = wheel.file_name().unwrap().to_str().unwrap().to_owned();
    assert!(name.contains("-cp310-abi3-"), "{name}");
    let size = fs::metadata(&wheel).unwrap().len();
    assert!(size <= LARGEST, "{name}: {size} bytes");
    println!("{name}: {size} bytes, built in {:.0} s", begin.elapsed().as_secs_f64());

    let bin = installed(&wheel, folder.path());
    let import =
        || done(program(&bin, "python").args(["-c", IMPORT])).trim().parse::<f64>().unwrap();
    let import_s = (0..IMPORTS).map(|_| import()).fold(f64::INFINITY, f64::min);
    assert!(import_s < LONGEST_IMPORT_S, "{import_s} s");
    println!("import beside NumPy's: {import_s:.3} s");
    let page = pages().into_iter().find(|page| page.name == "python.md").unwrap();
    book::hold(&page, program(&bin, "python"));
    let version = done(program(&bin, "plumbline").arg("--version"));
    assert_eq!(version.trim(), concat!("plumbline ", env!("CARGO_PKG_VERSION")));
}
