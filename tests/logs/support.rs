use std::{
    collections::BTreeMap,
    fs,
    path::{Path, PathBuf},
};

use logs::{Channels, LogError, ReadOptions, Run, read_run};
use nalgebra::{Isometry3, Vector3};
use robot::{Actuator, Inertia, Joint, JointKind, Limits, Link, Robot};
use tempfile::TempDir;

/// A robot whose joints have these names and kinds, limited to ±2.9 and a speed of 2.
pub fn robot(joints: &[(&str, JointKind)]) -> Robot {
    let link = |(index, (name, kind)): (usize, &(&str, JointKind))| Link {
        name: format!("{name}_link"),
        parent: index.checked_sub(1),
        joint: Joint {
            name: (*name).to_owned(),
            kind: *kind,
            parent_from_joint: Isometry3::identity(),
            axis_in_joint: Vector3::z_axis(),
            limits: Limits {
                position: (*kind != JointKind::Continuous).then_some((-2.9, 2.9)),
                velocity: Some(2.0),
                effort: Some(50.0),
            },
        },
        inertia: Inertia::zero(),
        actuator: Actuator::default(),
        merged: Vec::new(),
    };
    let links = joints.iter().enumerate().map(link).collect();
    Robot::new("arm", Vector3::new(0.0, 0.0, -9.81), links).unwrap()
}

/// A robot with the revolute joints `j1` and `j2`.
pub fn two_joints() -> Robot {
    robot(&[("j1", JointKind::Revolute), ("j2", JointKind::Revolute)])
}

/// A folder with one file.
pub struct Scratch {
    pub folder: TempDir,
    pub path: PathBuf,
}

impl Scratch {
    pub fn new(name: &str, content: impl AsRef<[u8]>) -> Self {
        let folder = TempDir::new().unwrap();
        let path = folder.path().join(name);
        fs::write(&path, content).unwrap();
        Self { folder, path }
    }

    pub fn read(&self, robot: &Robot) -> Result<Run, LogError> {
        read_run(&self.path, robot, &ReadOptions::default())
    }

    /// The message of a failed reading, without the folder.
    pub fn message(&self, robot: &Robot) -> String {
        self.told(self.read(robot))
    }

    pub fn told<T: std::fmt::Debug>(&self, result: Result<T, LogError>) -> String {
        let folder = format!("{}/", self.folder.path().display());
        result.unwrap_err().to_string().replace(&folder, "")
    }
}

/// A run of the joints given by position, velocity (where `Some`) and effort.
pub fn run(time: Vec<f64>, joints: Vec<Channels>) -> Run {
    Run {
        name: "run".to_owned(),
        source: PathBuf::from("run.csv"),
        sha256: String::new(),
        is_torn: false,
        mended: Vec::new(),
        time,
        joints,
        extra: BTreeMap::new(),
    }
}

/// A joint that follows `position`, with an effort that differs from sample to sample.
pub fn follows(name: &str, time: &[f64], position: impl Fn(f64) -> f64) -> Channels {
    Channels {
        name: name.to_owned(),
        position: time.iter().map(|&t| position(t)).collect(),
        effort: time.iter().map(|&t| (7.3 * t).sin() + 0.1 * t).collect(),
        ..Channels::default()
    }
}

/// `count` samples at `rate_hz`, from 0.
pub fn clock(count: usize, rate_hz: f64) -> Vec<f64> {
    (0..count).map(|k| k as f64 / rate_hz).collect()
}

/// Root of the workspace.
pub fn root() -> &'static Path {
    Path::new(concat!(env!("CARGO_MANIFEST_DIR"), "/.."))
}

/// A file of `tests/golden/logs`.
pub fn golden(name: &str) -> Vec<u8> {
    fs::read(root().join("tests/golden/logs").join(name)).unwrap()
}

/// The numbers that the scripts of `tests/golden/logs` put into their files.
pub fn assert_golden(run: &Run) {
    let of = |f: &dyn Fn(f64) -> f64| (0..5).map(|k| f(f64::from(k))).collect::<Vec<_>>();
    assert_eq!(run.time, of(&|k| 0.125 * k));
    for (j, joint) in [0.0, 1.0].into_iter().zip(&run.joints) {
        assert_eq!(joint.position, of(&|k| 0.25 * k + j));
        assert_eq!(joint.effort, of(&|k| k - 2.0 * j));
    }
}
