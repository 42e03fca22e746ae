//! Robots from files: what a good one gives, and what a bad one is told.
#![allow(clippy::unwrap_used, reason = "helper functions of a test may fail loudly")]
#![allow(clippy::panic, reason = "helper functions of a test may fail loudly")]
#![allow(clippy::float_cmp, reason = "numbers that pass through a file unchanged are equal")]

mod as_published;
mod bad_files;
mod bad_urdf;
mod merging;
mod mjcf;
mod part;
mod public_robots;
mod toml_keys;
mod wam;
mod writing;

use std::path::{Path, PathBuf};

use robot::{Loaded, Robot, RobotError};

/// A file of the workspace.
fn in_workspace(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("..").join(path)
}

fn wam() -> Loaded {
    Robot::load(&in_workspace("robots/wam7/robot.toml")).unwrap()
}

/// Loads `files` (name, content), the first of them, from a folder of their own.
/// Messages come back without the folder's name.
fn load(files: &[(&str, &str)]) -> Result<Loaded, String> {
    let folder = tempfile::tempdir().unwrap();
    for (name, content) in files {
        std::fs::write(folder.path().join(name), content).unwrap();
    }
    load_in(folder.path(), files[0].0)
}

fn load_in(folder: &Path, name: &str) -> Result<Loaded, String> {
    Robot::load(&folder.join(name)).map_err(|e| message(&e, folder))
}

fn message(error: &RobotError, folder: &Path) -> String {
    let message = error.to_string();
    assert!(!message.contains('\n'), "more than one line: {message}");
    message.replace(&format!("{}/", folder.display()), "")
}

/// The message a URDF is refused with.
fn refused(urdf: &str) -> String {
    match load(&[("robot.urdf", urdf)]) {
        Ok(loaded) => panic!("it was accepted: {:?}", loaded.robot),
        Err(message) => message,
    }
}

/// A two-joint arm with `extra` elements; a URDF that loads without them.
fn arm_with(extra: &str) -> String {
    format!(
        r#"<robot name="arm">
  <link name="base"/>
  <link name="upper"><inertial><mass value="2"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <link name="lower"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <joint name="shoulder" type="revolute"><parent link="base"/><child link="upper"/><axis xyz="0 1 0"/></joint>
  <joint name="elbow" type="continuous"><parent link="upper"/><child link="lower"/><origin xyz="0.3 0 0"/><axis xyz="0 1 0"/></joint>
  {extra}
</robot>"#
    )
}
