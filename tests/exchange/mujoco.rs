//! MuJoCo loads the MJCF and needs the same torque; where it is not installed these tests say so.

use checks::arms::workspace_root;
use exchange::{Format, export};
use robot::{Loaded, Robot};

use crate::python::{ask, has_mujoco};
use crate::rich::{DRIVES, State, states, torque, urdf, wam_with};

/// Largest difference of a torque over the largest torque: a constant torque is a spring of
/// 0.0001 /rad, of which 2e-5 N m are left; it was 4e-7.
const TOLERANCE: f64 = 1e-5;

/// Torques by MuJoCo's inverse dynamics, of joints by name in these states; `None` without MuJoCo.
const SCRIPT: &str = "
import json, sys, mujoco
question = json.load(sys.stdin)
model = mujoco.MjModel.from_xml_string(question['model'])
# States are drawn without regard to limits, which would push.
model.opt.disableflags |= mujoco.mjtDisableBit.mjDSBL_LIMIT
data = mujoco.MjData(model)
joints = [model.joint(name) for name in question['joints']]
places = [(j.qposadr[0], j.dofadr[0]) for j in joints]
answer = []
for q, qd, qdd in question['states']:
    for (p, d), x, v, a in zip(places, q, qd, qdd):
        data.qpos[p], data.qvel[d], data.qacc[d] = x, v, a
    mujoco.mj_inverse(model, data)
    answer.append([data.qfrc_inverse[d] for _, d in places])
json.dump(answer, sys.stdout)
";

pub fn mujoco(model: &str, joints: &[&str], states: &[State]) -> Option<Vec<Vec<f64>>> {
    if !has_mujoco() {
        return None;
    }
    let question = serde_json::json!({ "model": model, "joints": joints, "states": states });
    let answer = ask(SCRIPT, &question, &format!("MuJoCo refuses\n{model}"));
    Some(serde_json::from_str(&answer).unwrap())
}

/// Largest difference over the largest torque, of an MJCF changed by `change`.
fn difference(keys: &str, change: impl Fn(String) -> String) -> Option<f64> {
    let folder = tempfile::tempdir().unwrap();
    let loaded = wam_with(folder.path(), keys);
    let mjcf = change(export(&loaded, &urdf(), Format::Mjcf).unwrap().text);
    difference_of(&loaded, &mjcf)
}

/// Largest difference of the torques of a robot and of an MJCF over the largest torque.
fn difference_of(loaded: &Loaded, mjcf: &str) -> Option<f64> {
    let joints: Vec<&str> = loaded.robot.joint_names().collect();
    let states = states(joints.len(), 50);
    let theirs = mujoco(mjcf, &joints, &states)?;
    let ours = states.iter().map(|state| torque(&loaded.robot, state));
    let pairs: Vec<(f64, f64)> = ours.flatten().zip(theirs.into_iter().flatten()).collect();
    let largest = pairs.iter().map(|(ours, _)| ours.abs()).fold(0.0, f64::max);
    Some(pairs.iter().map(|(ours, theirs)| (ours - theirs).abs()).fold(0.0, f64::max) / largest)
}

#[test]
fn oracle_mujoco_needs_the_torque_of_the_extended_robot() {
    let Some(difference) = difference(DRIVES, |mjcf| mjcf) else { return };
    println!("largest difference over largest torque: {difference:.2e}");
    assert!(difference < TOLERANCE, "{difference}");
}

#[test]
fn oracle_mujoco_needs_the_torque_of_rigid_bodies_alone() {
    let Some(difference) = difference("", |mjcf| mjcf) else { return };
    assert!(difference < 1e-10, "{difference}");
}

/// What the tolerance can tell: each quantity left out alone is a hundred times as far off.
#[test]
fn oracle_mujoco_misses_what_is_left_out() {
    for (written, instead) in [
        (" damping=\"0.7\"", ""),
        (" armature=\"0.0346\"", ""),
        (" frictionloss=\"1.75\"", ""),
        (" stiffness=\"3 0 0.5\"", " stiffness=\"3\""),
        ("gravity=\"0.3 -0.2 -9.79\"", ""),
        ("coef=\"-1.3\"", "coef=\"1.3\""),
    ] {
        let without = |mjcf: String| {
            assert!(mjcf.contains(written), "{written} is not in\n{mjcf}");
            mjcf.replace(written, instead)
        };
        let Some(difference) = difference(DRIVES, without) else { return };
        assert!(difference > 100.0 * TOLERANCE, "{written}: {difference}");
    }
}

#[test]
fn a_transmission_that_gives_way_loads_as_a_second_joint() {
    let keys = "
[joint.j4_elbow_pitch]
rotor_inertia_kg_m2 = 0.03
elasticity_nm_per_rad = 900.0
[joint.j5_wrist_yaw]
rotor_inertia_kg_m2 = 0.003
backlash_rad = 0.01
";
    let folder = tempfile::tempdir().unwrap();
    let loaded = wam_with(folder.path(), keys);
    let mjcf = export(&loaded, &urdf(), Format::Mjcf).unwrap().text;
    let joints = ["j4_elbow_pitch_give", "j5_wrist_yaw_give"];
    let state: State = [vec![0.01, 0.0], vec![0.0, 0.0], vec![0.0, 0.0]];
    let rest: State = [vec![0.0, 0.0], vec![0.0, 0.0], vec![0.0, 0.0]];
    let Some(torques) = mujoco(&mjcf, &joints, &[state, rest]) else { return };
    // 900 N·m/rad over 0.01 rad, up to the weight that moves with it.
    let spring = torques[0][0] - torques[1][0];
    assert!((spring - 9.0).abs() < 0.5, "{spring}");
}

/// A body whose moments no body has, and one without mass: MuJoCo loads them, and it is told.
#[test]
fn impossible_inertias_load_and_are_told() {
    let text = r#"<robot name="r"><link name="base"/><link name="a"/><link name="b"><inertial><mass value="1"/><inertia ixx="-0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.5"/></inertial></link><joint name="j" type="continuous"><parent link="base"/><child link="a"/><axis xyz="0 1 0"/></joint><joint name="k" type="continuous"><parent link="a"/><child link="b"/><axis xyz="0 0 1"/></joint></robot>"#;
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("arm.urdf"), text).unwrap();
    let loaded = Robot::load(&folder.path().join("arm.urdf")).unwrap();
    let written = export(&loaded, text, Format::Mjcf).unwrap();
    let told: Vec<&str> = written.fates.iter().map(|f| f.fate.word()).collect();
    assert_eq!(told, ["approximated", "approximated"]);
    let rest: State = [vec![0.0; 2], vec![0.0; 2], vec![0.0; 2]];
    let moving: State = [vec![0.3, -0.4], vec![0.5, 0.8], vec![2.0, -3.0]];
    let Some(torques) = mujoco(&written.text, &["j", "k"], &[rest, moving.clone()]) else { return };
    assert!(torques[0].iter().all(|torque| torque.is_finite()));
    let held = torque(&written.robot, &moving);
    let apart = held.iter().zip(&torques[1]).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
    assert!(
        apart < 1e-9,
        "{held:?} is what the file is said to need, {:?} what it needs",
        torques[1]
    );
}

#[test]
fn oracle_mujoco_needs_the_torque_of_every_robot_of_this_project() {
    for name in ["wam7", "ur5e", "panda", "so101"] {
        let loaded =
            Robot::load(&workspace_root().join(format!("robots/{name}/robot.toml"))).unwrap();
        let source = std::fs::read_to_string(&loaded.urdf_path).unwrap();
        let mjcf = export(&loaded, &source, Format::Mjcf).unwrap().text;
        let Some(difference) = difference_of(&loaded, &mjcf) else { return };
        assert!(difference < 1e-10, "{name}: {difference}");
    }
}
