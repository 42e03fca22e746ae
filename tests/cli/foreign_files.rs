//! Files that a file names: what may be read of them, and what is shown.

use std::fs;
use std::path::Path;
use std::time::{Duration, Instant};

use crate::arm::{self, Gap};
use crate::program::{Answer, run};

const SECRET: &str = "root:x:0:0:of nobody's business\n";

/// A folder with the arm in `inside/arm.urdf`, whose base looks like the mesh `name`, and a secret beside it.
fn folder(name: &str) -> tempfile::TempDir {
    let folder = arm::folder(Gap::None);
    let path = folder.path();
    fs::create_dir_all(path.join("inside/meshes")).unwrap();
    arm::write(path, "secret", &SECRET.repeat(20));
    arm::write(path, "inside/secret.stl", &SECRET.repeat(20));
    let mesh = "solid a\n facet normal 0 0 1\n endfacet\nendsolid a\n";
    arm::write(path, "outside.stl", mesh);
    arm::write(path, "inside/meshes/a.stl", mesh);
    let visual = format!("<visual><geometry><mesh filename=\"{name}\"/></geometry></visual>");
    let base = format!("<link name=\"base\">{visual}</link>");
    let urdf = arm::URDF.replace("<link name=\"base\"/>", &base);
    arm::write(path, "inside/arm.urdf", &urdf);
    folder
}

fn check(folder: &Path, more: &[&str]) -> Answer {
    run(folder, &[&["robot", "check", "inside/arm.urdf"], more].concat())
}

#[test]
fn a_mesh_lies_below_the_urdf_and_is_one() {
    const LEFT_OUT: &str = "mesh files are not there";
    let good = folder("meshes/a.stl");
    assert!(!check(good.path(), &[]).out.contains(LEFT_OUT));
    let outside = folder("../outside.stl");
    assert!(check(outside.path(), &[]).out.contains(LEFT_OUT));
    let allowed = check(outside.path(), &["--allow-outside"]);
    assert!(!allowed.out.contains(LEFT_OUT), "{}", allowed.out);
    for name in ["../secret", "secret.stl", "file:///etc/passwd", "package://etc/passwd", "meshes"]
    {
        let folder = folder(name);
        for more in [&[][..], &["--allow-outside"]] {
            let answer = check(folder.path(), more);
            assert!(answer.out.contains(LEFT_OUT), "{name}: {answer:?}");
            assert!(!answer.out.contains("nobody"), "{answer:?}");
        }
    }
}

#[test]
fn nothing_of_a_file_that_is_no_mesh_is_in_the_recording() {
    let folder = folder("secret.stl");
    let robot = ["--robot", "inside/arm.urdf", "--log", "run_0.csv", "run_1.csv"];
    let answer = run(folder.path(), &[&["diagnose", "--out", "out"], &robot[..]].concat());
    assert!(answer.code <= 1, "{}", answer.err);
    let recording = fs::read(folder.path().join("out/recording.rrd")).unwrap();
    assert!(!recording.windows(6).any(|bytes| bytes == b"nobody"));
}

#[test]
fn nothing_is_shown_of_a_file_that_is_extended_and_is_no_toml() {
    let folder = folder("meshes/a.stl");
    arm::write(folder.path(), "scenario.toml", "extends = \"secret\"\n");
    let answer = run(folder.path(), &["run", "scenario.toml", "--out", "out"]);
    assert_eq!(answer.code, 3, "{answer:?}");
    assert!(answer.err.contains("secret cannot be extended: line 1 is no TOML"), "{}", answer.err);
    assert!(!answer.err.contains("nobody"), "{}", answer.err);
    arm::write(folder.path(), "robot.toml", "urdf = \"secret\"\n");
    let answer = run(folder.path(), &["robot", "check", "robot.toml"]);
    assert_eq!(answer.code, 3, "{answer:?}");
    assert!(!answer.err.contains("nobody"), "{}", answer.err);
}

#[cfg(unix)]
#[test]
fn a_pipe_is_not_waited_for() {
    let folder = folder("pipe.stl");
    let path = folder.path();
    for pipe in ["inside/pipe.stl", "pipe"] {
        let made = std::process::Command::new("mkfifo").arg(path.join(pipe)).status().unwrap();
        assert!(made.success());
    }
    arm::write(path, "robot.toml", "urdf = \"pipe\"\n");
    arm::write(path, "scenario.toml", "extends = \"pipe\"\n");
    let start = Instant::now();
    assert_eq!(check(path, &[]).code, 0);
    for arguments in [&["robot", "check", "robot.toml"][..], &["run", "scenario.toml"]] {
        let answer = run(path, arguments);
        assert_eq!(answer.code, 3, "{answer:?}");
        assert!(answer.err.contains("pipe"), "{}", answer.err);
    }
    assert!(start.elapsed() < Duration::from_secs(20));
}

/// An arm whose base looks like the mesh `named.stl`, as URDF and as MJCF.
#[cfg(target_os = "linux")]
fn with_a_mesh() -> [(&'static str, String); 2] {
    const MJCF: &str = r#"<mujoco model="a"><asset><mesh name="m" file="named.stl"/></asset><worldbody>
<body name="b"><joint name="j" type="hinge"/><inertial pos="0 0 .1" mass="1" diaginertia="1 1 1"/>
<geom type="mesh" mesh="m"/></body></worldbody></mujoco>"#;
    let visual = "<visual><geometry><mesh filename=\"named.stl\"/></geometry></visual>";
    let base = format!("<link name=\"base\">{visual}</link>");
    let urdf = arm::URDF.replace("<link name=\"base\"/>", &base);
    [("mesh.urdf", urdf), ("mesh.xml", MJCF.to_owned())]
}

#[cfg(target_os = "linux")]
#[test]
fn a_mesh_that_is_no_file_is_left_out_by_name_and_nothing_of_it_is_shown() {
    use crate::named_files::{ALL, Found, place, prepared, run};

    let around = prepared();
    let inside = around.path().join("inside");
    for ((file, text), found) in
        with_a_mesh().into_iter().flat_map(|robot| ALL.map(|found| (robot.clone(), found)))
    {
        arm::write(&inside, file, &text);
        place(&inside, found);
        let path = inside.join("named.stl");
        if found != Found::Nothing {
            fs::rename(inside.join("named"), &path).unwrap();
        }
        let answer = run(&inside, &["robot", "check", file].map(str::to_owned));
        let said = format!("{}{}", answer.out, answer.err);
        assert_eq!(answer.code, 0, "{file}, {found:?}: {said}");
        assert!(said.contains("named.stl is one"), "{file}, {found:?}: {said}");
        assert!(!said.contains("nobody"), "{file}, {found:?}: {said}");
        let _ = if path.is_dir() { fs::remove_dir_all(path) } else { fs::remove_file(path) };
    }
}
