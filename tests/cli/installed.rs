//! Robots by the names that installed packages of Python give them.

use std::fs;
use std::path::Path;

use checks::program::Answer;

use crate::arm::{self, Gap};
use crate::program::plumbline;

/// `robot check` in an environment of its own.
fn check(folder: &Path, robot: &str) -> Answer {
    let mut command = plumbline();
    command.args(["robot", "check", robot]).current_dir(folder).env("PATH", "").env("HOME", folder);
    for variable in ["PYTHONPATH", "CONDA_PREFIX", "MENAGERIE_ROOT", "MENAGERIE_CACHE_DIR"] {
        command.env_remove(variable);
    }
    command.env_remove("XDG_CACHE_HOME").env_remove("ROBOT_DESCRIPTION_COMMIT");
    command.env("ROBOT_DESCRIPTIONS_CACHE", "~/.cache/robot_descriptions");
    command.env("VIRTUAL_ENV", folder.join("venv")).output().unwrap().into()
}

#[test]
fn a_robot_of_an_installed_package_is_read_by_its_name() {
    let folder = arm::folder(Gap::None);
    let at = |name: &str| folder.path().join(name);
    let absent = check(folder.path(), "menagerie:arm");
    assert_eq!(absent.code, 3);
    assert!(absent.err.contains("menagerie:arm: "), "{}", absent.err);
    assert!(absent.err.contains("pip install mujoco-menagerie"), "{}", absent.err);
    assert!(!absent.err.contains("help:"), "{}", absent.err);
    let site = at("venv/lib/python3.13/site-packages");
    fs::create_dir_all(site.join("robot_descriptions")).unwrap();
    arm::write(
        &site,
        "robot_descriptions/_repositories.py",
        "REPOSITORIES = {\n    \"arms\": Repository(\n        url=\"\",\n        cache_path=\"arms\",\n    ),\n}\n",
    );
    arm::write(
        &site,
        "robot_descriptions/arm_description.py",
        "REPOSITORY_PATH: str = _clone_to_cache(\n    \"arms\",\n)\nURDF_PATH: str = _path.join(REPOSITORY_PATH, \"arm.urdf\")\n",
    );
    let missing = check(folder.path(), "description:arm_description");
    assert_eq!(missing.code, 3);
    assert!(missing.err.contains("robot_descriptions pull arm_description"), "{}", missing.err);
    assert!(!missing.err.contains("help:"), "{}", missing.err);
    let cache = at(".cache/robot_descriptions/arms");
    fs::create_dir_all(&cache).unwrap();
    fs::copy(at("arm.urdf"), cache.join("arm.urdf")).unwrap();
    let found = check(folder.path(), "description:arm");
    assert_eq!((found.code, found.err.as_str()), (0, ""));
    assert!(found.out.contains("shoulder"), "{}", found.out);
}
