//! The module of Python, loaded as its users load it; the snippets and the notebooks of the book in it. Where there is
//! no `python3` with what they import, a test says so and is left out.
#![allow(clippy::unwrap_used, reason = "a helper that fails is a test that fails")]

use std::ffi::OsString;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::sync::OnceLock;

use checks::arms::{wam, workspace_root};
use checks::lerobot::{Layout, write};
use checks::synthetic::{Noise, Truth, run};
use colours::Role;

#[cfg(unix)]
mod book;
#[cfg(unix)]
mod wheel;

/// Imports of the module itself.
const NUMPY: &str = "import numpy, sys; assert sys.version_info >= (3, 10)";

/// The library as cargo has just built it for this test: the newest of the places it is put. It is read once, and before
/// the wheel is built, which puts another one there.
fn library() -> &'static [u8] {
    static LIBRARY: OnceLock<Vec<u8>> = OnceLock::new();
    LIBRARY.get_or_init(|| {
        let deps = std::env::current_exe().unwrap().parent().unwrap().to_owned();
        let (prefix, suffix) = (std::env::consts::DLL_PREFIX, std::env::consts::DLL_SUFFIX);
        let name = format!("{prefix}_plumbline{suffix}");
        let places = [deps.join(&name), deps.join("..").join(&name)];
        let made = |path: &PathBuf| fs::metadata(path).and_then(|data| data.modified()).ok();
        let places = places.into_iter().filter(|path| path.exists());
        fs::read(places.max_by_key(made).unwrap()).unwrap()
    })
}

/// A folder with the module in it, to be on the path of Python; none, said so, where a command of Python fails that
/// imports what `tested` needs.
fn module(imports: &str, tested: &str) -> Option<tempfile::TempDir> {
    if !checks::book::can("python3", &["-c", imports]) {
        println!("python3 fails at `{imports}` here: {tested} left untested");
        return None;
    }
    let folder = tempfile::tempdir().unwrap();
    let package = folder.path().join("plumbline");
    fs::create_dir(&package).unwrap();
    for entry in fs::read_dir(workspace_root().join("crates/python/python/plumbline")).unwrap() {
        let entry = entry.unwrap();
        if entry.file_type().unwrap().is_file() {
            fs::copy(entry.path(), package.join(entry.file_name())).unwrap();
        }
    }
    let extension = if cfg!(windows) { "pyd" } else { "abi3.so" };
    fs::write(package.join(format!("_plumbline.{extension}")), library()).unwrap();
    Some(folder)
}

/// Python with the module on its path.
fn python(module: &Path) -> Command {
    let mut python = Command::new("python3");
    python.env("PYTHONPATH", module).env("PYTHONDONTWRITEBYTECODE", "1");
    python
}

/// Runs tests of Python on the module.
fn hold(module: &Path, tests: &str, environment: &[(&str, OsString)]) {
    let ended = python(module)
        .arg(workspace_root().join("tests/python").join(tests))
        .env("PLUMBLINE_ROOT", workspace_root())
        .envs(environment.iter().cloned())
        .output()
        .unwrap();
    let said = String::from_utf8_lossy(&ended.stderr);
    assert!(ended.status.success(), "{said}");
    println!("{said}");
}

#[test]
fn what_cannot_be_used_is_an_exception_that_names_the_argument() {
    let Some(module) = module(NUMPY, "arguments are") else { return };
    hold(module.path(), "test_arguments.py", &[]);
}

#[test]
fn frames_files_and_robots_are_read_as_they_are_asked_for() {
    let Some(module) = module(NUMPY, "frames are") else { return };
    hold(module.path(), "test_inputs.py", &[]);
}

#[test]
fn the_module_does_what_it_says() {
    let Some(module) = module(NUMPY, "the module is") else { return };
    // Two episodes whose first sample differs.
    let robot = wam();
    let dataset = module.path().join("dataset");
    let runs = [1, 2].map(|seed| run(&Truth::of(&robot), &Noise::of_a_wam(), 2.0, seed));
    write(&dataset, &runs, Layout::OneFile, &[]);
    let starts = runs.map(|run| run.joints[0].position[0].to_string());
    let environment =
        [("PLUMBLINE_DATASET", dataset.into()), ("PLUMBLINE_STARTS", starts.join(" ").into())];
    hold(module.path(), "test_module.py", &environment);
}

#[test]
fn a_plot_has_the_colours_of_reports() {
    let file = workspace_root().join("crates/python/python/plumbline/_plot.py");
    let plot = fs::read_to_string(file).unwrap();
    for role in [Role::Measured, Role::Nominal, Role::Extended] {
        let said = format!("\"{}\": \"{}\"", role.name(), role.colour().on_white);
        assert!(plot.contains(&said), "{said}");
    }
}
