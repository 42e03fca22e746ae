//! The robot of the demo in MuJoCo along a motion that its diagnosis has not seen.
//!
//! MuJoCo's torques are in a file with its version, and are worked out again where MuJoCo is installed.

use checks::arms::workspace_root;
use exchange::{Format, export};
use robot::{Loaded, Robot};
use serde::Deserialize;

use crate::mujoco::mujoco;
use crate::rich::{State, torque, urdf};

/// Largest part by which the exported robot's error may differ from that of the extended one.
const SHARE: f64 = 0.05;

/// `held_out.json`, one entry a state.
#[derive(Deserialize)]
struct HeldOut {
    joints: Vec<String>,
    q: Vec<Vec<f64>>,
    qd: Vec<Vec<f64>>,
    qdd: Vec<Vec<f64>>,
    /// As the log has it (N·m).
    effort: Vec<Vec<f64>>,
    /// As MuJoCo's inverse dynamics has it (N·m).
    torque: Vec<Vec<f64>>,
}

impl HeldOut {
    fn states(&self) -> Vec<State> {
        let rows = self.q.iter().zip(&self.qd).zip(&self.qdd);
        rows.map(|((q, qd), qdd)| [q.clone(), qd.clone(), qdd.clone()]).collect()
    }

    /// RMS of the error of torques by joint (N·m), and over all joints at the end.
    fn error(&self, torques: &[Vec<f64>]) -> Vec<f64> {
        let of = |j: usize| {
            let pairs = torques.iter().zip(&self.effort);
            let squares = pairs.map(|(torque, effort)| (torque[j] - effort[j]).powi(2));
            (squares.sum::<f64>() / torques.len() as f64).sqrt()
        };
        let mut errors: Vec<f64> = (0..self.joints.len()).map(of).collect();
        errors.push(errors.iter().map(|error| error * error).sum::<f64>().sqrt());
        errors
    }
}

fn golden(name: &str) -> String {
    std::fs::read_to_string(workspace_root().join("tests/golden").join(name)).unwrap()
}

/// The extended robot of the demo.
fn extended() -> Loaded {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("robot.urdf"), urdf()).unwrap();
    std::fs::write(folder.path().join("robot.toml"), golden("held_out.toml")).unwrap();
    Robot::load(&folder.path().join("robot.toml")).unwrap()
}

#[test]
fn oracle_mujoco_errs_on_a_held_out_motion_as_the_extended_robot_does() {
    let loaded = extended();
    let mjcf = export(&loaded, &urdf(), Format::Mjcf).unwrap();
    // MuJoCo's torques are those of this file: tests/golden/make_held_out.py writes both anew.
    assert_eq!(mjcf.text, golden("held_out.xml"));
    let held_out: HeldOut = serde_json::from_str(&golden("held_out.json")).unwrap();
    let joints: Vec<&str> = held_out.joints.iter().map(String::as_str).collect();
    assert!(loaded.robot.joint_names().eq(joints.iter().copied()));
    let states = held_out.states();
    let ours = |robot: &Robot| -> Vec<f64> {
        held_out.error(&states.iter().map(|state| torque(robot, state)).collect::<Vec<_>>())
    };
    let (extended, held) = (ours(&loaded.robot), ours(&mjcf.robot));
    let live = mujoco(&mjcf.text, &joints, &states);
    for torques in std::iter::once(&held_out.torque).chain(&live) {
        let theirs = held_out.error(torques);
        println!("RMS (N m) of MuJoCo {theirs:.4?}, of the extended robot {extended:.4?}");
        for (theirs, ours) in theirs.iter().zip(&extended) {
            assert!((theirs - ours).abs() < SHARE * ours, "{theirs} N·m, not {ours}");
        }
    }
    assert_eq!(held, extended, "the export drops nothing of this robot");
    let nominal = ours(&loaded.robot_in_urdf);
    assert!(nominal[7] > 10.0 * extended[7], "{nominal:?} does as well as {extended:?}");
    if let Some(live) = live {
        let pairs = live.iter().flatten().zip(held_out.torque.iter().flatten());
        let apart = pairs.map(|(now, then)| (now - then).abs()).fold(0.0, f64::max);
        assert!(apart < 1e-4, "MuJoCo needs {apart} N·m other than what is in the file");
    }
}
