//! Robots from MJCF: the torque that MuJoCo gives them, and what is told of the rest.

use dynamics::Dynamics;
use robot::{JointKind, Loaded, PdGain, Robot, RobotWarning};
use serde::Deserialize;

use crate::{in_workspace, load};

#[derive(Deserialize)]
struct Golden {
    joints: Vec<String>,
    q_qd_qdd_tau: Vec<[Vec<f64>; 4]>,
}

fn arm() -> Loaded {
    Robot::load(&in_workspace("tests/golden/mjcf/arm.xml")).unwrap()
}

/// Torque of the rigid bodies and of what an MJCF says of drives.
fn torque(robot: &Robot, q: &[f64], qd: &[f64], qdd: &[f64]) -> Vec<f64> {
    let rigid = Dynamics::new(robot).inverse_dynamics(q, qd, qdd).unwrap();
    let drives = robot.links().iter().map(|link| &link.actuator).enumerate();
    drives
        .map(|(i, a)| {
            let spring = a.spring_stiffness * (q[i] - a.spring_rest);
            let friction = a.viscous * qd[i] + a.coulomb_forward * qd[i].signum();
            rigid[i] + a.rotor_inertia * qdd[i] + friction + spring
        })
        .collect()
}

/// Bodies of shapes and of `<inertial>`, classes, an include, frames, every orientation, a joint off
/// its body's origin, two joints in one body.
#[test]
fn oracle_an_mjcf_needs_the_torque_that_mujoco_gives_it() {
    let golden: Golden = serde_json::from_str(
        &std::fs::read_to_string(in_workspace("tests/golden/mjcf/arm.json")).unwrap(),
    )
    .unwrap();
    let robot = arm().robot;
    assert_eq!(robot.joint_names().collect::<Vec<_>>(), golden.joints);
    let mut largest = 0.0_f64;
    for [q, qd, qdd, expected] in &golden.q_qd_qdd_tau {
        for (ours, theirs) in torque(&robot, q, qd, qdd).iter().zip(expected) {
            assert!((ours - theirs).abs() < 1e-10, "{ours} {theirs}");
            largest = largest.max(theirs.abs());
        }
    }
    assert!(largest > 10.0, "the golden file is of an arm at rest: {largest}");
}

#[test]
fn limits_gains_and_shapes_are_read() {
    let loaded = arm();
    let links = loaded.robot.links();
    let degrees = |value: f64| value.to_radians();
    assert_eq!(links[0].joint.limits.position, Some((degrees(-150.0), degrees(150.0))));
    assert_eq!(links[1].joint.kind, JointKind::Continuous);
    assert_eq!(links[2].joint.kind, JointKind::Prismatic);
    let efforts: Vec<_> = links.iter().map(|link| link.joint.limits.effort).collect();
    assert_eq!(efforts, [Some(50.0), Some(60.0), None, Some(12.0)]);
    let gains =
        [None, Some(PdGain { kp: 400.0, kd: 20.0 }), None, Some(PdGain { kp: 80.0, kd: 4.0 })];
    assert_eq!(loaded.control.gains, gains);
    assert_eq!(links[3].merged, ["tool"]);
    assert_eq!(loaded.fixed_to_base, ["column"]);
    // The box of the tool and its shapes; a plane is not drawn.
    assert_eq!(loaded.looks.base.len(), 1);
    assert!(loaded.expanded.is_some_and(|text| text.contains("<default class=\"strong\">")));
}

/// A hinge with `body` in its body and `rest` behind the world.
fn hinge(body: &str, rest: &str) -> String {
    format!(
        r#"<mujoco><worldbody><body name="arm"><joint name="hinge"/><inertial pos="0.1 0 0" mass="1" diaginertia="1 1 1"/>{body}</body></worldbody>{rest}</mujoco>"#
    )
}

fn loaded(body: &str, rest: &str) -> Loaded {
    load(&[("arm.xml", &hinge(body, rest))]).unwrap()
}

fn refused(text: &str) -> String {
    load(&[("arm.xml", text)]).unwrap_err()
}

#[test]
fn a_joint_of_an_equality_is_held_where_the_other_has_it() {
    let finger = r#"<body name="finger"><joint name="grip" type="slide"/><inertial pos="0 0 0" mass="1" diaginertia="1 1 1"/></body>"#;
    let equal =
        r#"<equality><joint joint1="grip" joint2="hinge" polycoef="0.02 1 0 0 0"/></equality>"#;
    let loaded = loaded(finger, equal);
    assert_eq!(loaded.robot.joint_count(), 1);
    assert_eq!(loaded.locked[0].position, 0.02);
    assert_eq!(loaded.locked[0].mimics.as_deref(), Some("hinge"));
}

#[test]
fn what_is_not_read_is_named_and_counted() {
    let rest = r#"<tendon><fixed/><spatial/><spatial/></tendon><equality><weld/></equality><actuator><motor tendon="t"/></actuator><option density="1.2"/>"#;
    let mesh = r#"<body><geom type="mesh" mesh="m"/></body>"#;
    let told: Vec<(String, usize)> = loaded(mesh, rest)
        .warnings
        .into_iter()
        .filter_map(|w| match w {
            RobotWarning::NotUnderstood { what, count } => Some((what, count)),
            _ => None,
        })
        .collect();
    let expected = [
        ("<fixed> of <tendon>", 1),
        ("<spatial> of <tendon>", 2),
        ("<weld> of <equality>", 1),
        ("actuator of something else than a joint", 1),
        ("density of <option>", 1),
        ("inertia of a mesh that stands for <inertial>", 1),
    ];
    assert_eq!(told, expected.map(|(what, count)| (what.to_owned(), count)));
    assert!(loaded("", "<asset/><visual/><sensor/><keyframe/>").warnings.is_empty());
}

#[test]
fn a_base_that_is_free_is_held() {
    let text = hinge("", "")
        .replace("<worldbody>", "<worldbody><body name=\"base\"><freejoint name=\"root\"/></body>");
    let loaded = load(&[("arm.xml", &text)]).unwrap();
    let held =
        |w: &RobotWarning| matches!(w, RobotWarning::BaseHeld { joint, .. } if joint == "root");
    assert!(loaded.warnings.iter().any(held), "{:?}", loaded.warnings);
}

#[test]
fn mistakes_are_told_with_their_line() {
    let broken = |from: &str, to: &str| refused(&hinge("", "").replace(from, to));
    for (message, expected) in [
        (broken("mass=\"1\"", "mass=\"-1\""), "line 1: <inertial>: its mass is -1 kg"),
        (broken("pos=\"0.1 0 0\"", "pos=\"0.1 x\""), "pos=\"0.1 x\" was found, up to 3 numbers"),
        (broken("pos=\"0.1 0 0\"", "pos=\"0.1 0\""), "pos has 2 numbers, 3 were expected"),
        (broken("name=\"hinge\"", "name=\"hinge\" type=\"ball\""), "its type is ball"),
        (broken("name=\"hinge\"", "name=\"hinge\" axis=\"0 0 0\""), "its axis is (0, 0, 0)"),
        (broken("name=\"hinge\"", "name=\"hinge\" range=\"1 -1\""), "above its upper limit"),
        (
            broken("name=\"arm\"", "name=\"arm\" childclass=\"x\""),
            "there is no class x in <default>",
        ),
        (
            refused(&hinge("", "<include file=\"not_there.xml\"/>")),
            "not_there.xml: there is no such",
        ),
        (refused(&hinge("", "<include file=\"arm.xml\"/>")), "arm.xml is included twice"),
        (refused("<mujoco/>"), "it has no moving joint"),
        (refused("<mujoco><worldbody>"), "the file ends inside <worldbody>"),
    ] {
        assert!(message.contains(expected), "{expected} is missing in {message}");
    }
}

/// No text may stop the program: every prefix and every file with a byte changed gives a robot or
/// a sentence.
#[test]
fn a_damaged_mjcf_is_a_robot_or_a_sentence() {
    let text = hinge("<geom size=\"0.1\"/>", "<actuator><position joint=\"hinge\"/></actuator>");
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("arm.xml");
    let mut refusals = 0;
    let mut check = |bytes: &[u8]| {
        std::fs::write(&file, bytes).unwrap();
        if let Err(error) = Robot::load(&file) {
            refusals += 1;
            assert!(!error.to_string().contains('\n'), "{error}");
        }
    };
    for at in 0..text.len() {
        check(&text.as_bytes()[..at]);
        for byte in *b"<>\"0- \xff" {
            let mut damaged = text.clone().into_bytes();
            damaged[at] = byte;
            check(&damaged);
        }
    }
    let deep = format!("<mujoco><worldbody>{}", "<body>".repeat(100_000));
    check(deep.as_bytes());
    assert!(refusals > 1000, "{refusals}");
}
