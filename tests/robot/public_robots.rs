use std::path::{Path, PathBuf};

use robot::Robot;

use super::in_workspace;

/// The folder with the public recordings, where there is one.
fn data() -> PathBuf {
    let named = std::env::var_os("PLUMBLINE_DATA").map(PathBuf::from);
    named.unwrap_or_else(|| in_workspace("../shared/data"))
}

#[test]
fn recorded_urdfs_of_other_arms_load() {
    for (folder, joints, base, mass) in [
        ("kuka_lwr4", 7, "box", 14.4),
        ("kinova_gen3", 7, "world", 5.4772),
        ("staubli_tx40", 6, "base_link", 23.01),
    ] {
        let path = data().join(folder).join("robot.urdf");
        if !path.exists() {
            println!("skipped: {} is not there", path.display());
            continue;
        }
        let loaded = Robot::load(&path).unwrap();
        assert_eq!(loaded.robot.joint_count(), joints, "{folder}");
        assert_eq!(loaded.base_link, base, "{folder}");
        let found: f64 = loaded.robot.links().iter().map(|l| l.inertia.mass).sum();
        assert!((found - mass).abs() < 1e-9, "{folder}: moving mass {found} kg, not {mass}");
        println!("{folder}: {} warnings", loaded.warnings.len());
        loaded.warnings.iter().for_each(|w| println!("  {w}"));
    }
}

#[test]
fn robots_people_have_load_as_published() {
    for (name, joints, locked) in
        [("ur5_robot.urdf", 6, 0), ("z1.urdf", 7, 0), ("z1.toml", 7, 0), ("so101.urdf", 6, 0)]
    {
        let path = data().join("formats").join(name);
        if !path.exists() {
            println!("skipped: {} is not there", path.display());
            continue;
        }
        let loaded = Robot::load(&path).unwrap();
        assert_eq!((loaded.robot.joint_count(), loaded.locked.len()), (joints, locked), "{name}");
    }
}

/// The folder `robots` of the Python package example-robot-data, where that is installed.
fn example_robots() -> Option<PathBuf> {
    let asked = "import sysconfig; print(sysconfig.get_paths()['purelib'])";
    let answer = std::process::Command::new("python3").args(["-c", asked]).output().ok()?;
    let packages = PathBuf::from(String::from_utf8(answer.stdout).ok()?.trim());
    Some(packages.join("cmeel.prefix/share/example-robot-data/robots")).filter(|p| p.is_dir())
}

/// Every file with this ending in a folder and those below it, sorted.
fn files_below(folder: &Path, ending: &str) -> Vec<PathBuf> {
    let (mut folders, mut files) = (vec![folder.to_owned()], vec![]);
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(folder).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.extension().is_some_and(|e| e == ending) {
                files.push(path);
            }
        }
    }
    files.sort();
    files
}

#[test]
fn urdfs_of_example_robot_data_load_or_say_why_not() {
    let Some(folder) = example_robots() else {
        println!("skipped: the Python package example-robot-data is not installed");
        return;
    };
    let mut refused = vec![];
    let files = files_below(&folder, "urdf");
    for path in &files {
        let name = path.file_name().unwrap().to_string_lossy().into_owned();
        match Robot::load(path) {
            Ok(loaded) => {
                let (moving, locked) = (loaded.robot.joint_count(), loaded.locked.len());
                println!("{name}: {moving} joints, {locked} locked");
                let of_motion = loaded.warnings.iter().filter(|w| w.is_about_motion());
                of_motion.for_each(|warning| println!("  {warning}"));
            }
            Err(error) => {
                println!("{name}: {error}");
                refused.push(name);
            }
        }
    }
    let fixed_arms = [
        "ur3_robot.urdf",
        "ur5_robot.urdf",
        "ur10_robot.urdf",
        "panda.urdf",
        "kinova.urdf",
        "baxter.urdf",
        "tiago.urdf",
        "z1.urdf",
        "so101.urdf",
        "talos_left_arm.urdf",
        "xarm7.urdf",
    ];
    for arm in fixed_arms {
        assert!(!refused.iter().any(|name| name == arm), "{arm} is refused");
    }
    println!("{} of {} load", files.len() - refused.len(), files.len());
}
