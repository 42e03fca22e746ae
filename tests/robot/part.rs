//! A part of a robot: joints that are locked, and what their links weigh on the others.

use std::collections::BTreeMap;

use dynamics::Dynamics;
use robot::{Coupling, LoadOptions, Loaded, Robot};
use serde::Deserialize;

use super::{arm_with, in_workspace, load, message};

/// Torques of up to 200 N m, a few hundred operations.
const ROUNDING: f64 = 1e-11;

#[derive(Deserialize)]
struct Golden {
    cases: Vec<Case>,
}

#[derive(Deserialize)]
struct Case {
    locked: BTreeMap<String, f64>,
    states: Vec<State>,
}

/// What the joints that move do, and the torque that takes, by the names of the joints.
#[derive(Deserialize)]
struct State {
    q: BTreeMap<String, f64>,
    qd: BTreeMap<String, f64>,
    qdd: BTreeMap<String, f64>,
    tau: BTreeMap<String, f64>,
}

fn urdf() -> String {
    std::fs::read_to_string(in_workspace("tests/golden/part.urdf")).unwrap()
}

fn with(toml: &str) -> Result<Loaded, String> {
    let toml = format!("urdf = \"arm.urdf\"\n{toml}");
    load(&[("robot.toml", &toml), ("arm.urdf", &urdf())])
}

fn refused(toml: &str) -> String {
    match with(toml) {
        Ok(loaded) => panic!("it was accepted: {:?}", loaded.robot),
        Err(message) => message,
    }
}

/// The file `arm.urdf` or a `robot.toml` beside it, of which `joints` move.
fn narrowed(toml: Option<&str>, joints: &[&str]) -> Result<Loaded, String> {
    let folder = tempfile::tempdir().unwrap();
    let mut path = folder.path().join("arm.urdf");
    std::fs::write(&path, urdf()).unwrap();
    if let Some(toml) = toml {
        path = folder.path().join("robot.toml");
        std::fs::write(&path, format!("urdf = \"arm.urdf\"\n{toml}")).unwrap();
    }
    let joints = Some(joints.iter().map(|j| (*j).to_owned()).collect());
    let options = LoadOptions { joints, ..LoadOptions::default() };
    Robot::load_with(&path, &options).map_err(|e| message(&e, folder.path()))
}

/// Inverse dynamics by the names of the joints; a joint that is not named does not move.
fn torques(robot: &Robot, state: [&BTreeMap<String, f64>; 3]) -> BTreeMap<String, f64> {
    let of = |values: &BTreeMap<String, f64>| -> Vec<f64> {
        robot.joint_names().map(|name| values.get(name).copied().unwrap_or(0.0)).collect()
    };
    let [q, qd, qdd] = state.map(of);
    let tau = Dynamics::new(robot).inverse_dynamics(&q, &qd, &qdd).unwrap();
    robot.joint_names().map(str::to_owned).zip(tau.iter().copied()).collect()
}

fn assert_close(found: &BTreeMap<String, f64>, expected: &BTreeMap<String, f64>) {
    assert_eq!(found.keys().collect::<Vec<_>>(), expected.keys().collect::<Vec<_>>());
    for (name, expected) in expected {
        let error = found[name] - expected;
        assert!(error.abs() < ROUNDING, "{name}: {} is not {expected}", found[name]);
    }
}

#[test]
fn oracle_a_locked_arm_needs_the_torque_that_pinocchio_gives_the_whole_one_with_joints_held() {
    let golden = std::fs::read_to_string(in_workspace("tests/golden/part.json")).unwrap();
    let golden: Golden = serde_json::from_str(&golden).unwrap();
    assert_eq!(golden.cases.len(), 5);
    for Case { locked, states } in golden.cases {
        let keys: Vec<String> = locked.iter().map(|(name, q)| format!("{name} = {q:?}")).collect();
        let robot = with(&format!("locked = {{ {} }}", keys.join(", "))).unwrap().robot;
        for state in &states {
            assert_close(&torques(&robot, [&state.q, &state.qd, &state.qdd]), &state.tau);
        }
    }
}

/// A robot that is locked anew, and one that is read with these positions, are the ones that Pinocchio holds there.
#[test]
fn oracle_joints_are_locked_elsewhere_as_pinocchio_holds_them() {
    let golden = std::fs::read_to_string(in_workspace("tests/golden/part.json")).unwrap();
    let golden: Golden = serde_json::from_str(&golden).unwrap();
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("arm.urdf");
    std::fs::write(&path, urdf()).unwrap();
    for Case { locked, states } in golden.cases {
        let zeros = locked.keys().map(|name| (name.clone(), 0.0)).collect();
        let load = |locked: BTreeMap<String, f64>| {
            let options = LoadOptions { locked, ..LoadOptions::default() };
            Robot::load_with(&path, &options).unwrap().robot
        };
        let (read, anew) = (load(locked.clone()), load(zeros).locked_at(&locked).unwrap());
        assert_eq!(anew.locks().len(), locked.len());
        for (robot, state) in
            [&read, &anew].into_iter().flat_map(|r| states.iter().map(move |s| (r, s)))
        {
            assert_close(&torques(robot, [&state.q, &state.qd, &state.qdd]), &state.tau);
        }
        assert_eq!(anew.locked_at(&BTreeMap::from([("nothing".to_owned(), 0.0)])), None);
    }
}

#[test]
fn locked_joints_that_cannot_be_are_refused_by_name() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("arm.urdf");
    std::fs::write(&path, urdf()).unwrap();
    let refused = |joints: Option<&str>, name: &str, at: f64| {
        let joints = joints.map(|name| vec![name.to_owned()]);
        let locked = BTreeMap::from([(name.to_owned(), at)]);
        let options = LoadOptions { joints, locked, ..LoadOptions::default() };
        let error = Robot::load_with(&path, &options).unwrap_err();
        message(&error, folder.path())
    };
    assert!(refused(None, "elbw", 0.1).contains("elbow"), "{}", refused(None, "elbw", 0.1));
    let both = refused(Some("elbow"), "elbow", 0.1);
    assert!(both.contains("elbow") && both.contains("among those that are locked"), "{both}");
    assert!(refused(None, "elbow", f64::NAN).contains("locked position"));
}

#[test]
fn joints_that_are_left_out_are_locked_at_zero_as_the_whole_arm_held_there_shows() {
    let whole = Robot::from_urdf(&urdf()).unwrap();
    let kept = ["shoulder", "elbow"];
    let part = with("joints = [\"shoulder\", \"elbow\"]").unwrap();
    assert_eq!(part.robot.joint_names().collect::<Vec<_>>(), kept);
    assert_eq!(part.robot, narrowed(None, &kept).unwrap().robot);
    let of = |values: [f64; 2]| kept.iter().map(|k| (*k).to_owned()).zip(values).collect();
    let [q, qd, qdd]: [BTreeMap<String, f64>; 3] =
        [of([0.4, -1.2]), of([1.0, 3.0]), of([-4.0, 2.0])];
    let mut expected = torques(&whole, [&q, &qd, &qdd]);
    expected.retain(|name, _| kept.contains(&name.as_str()));
    assert_close(&torques(&part.robot, [&q, &qd, &qdd]), &expected);
}

#[test]
fn a_part_says_what_is_fixed_to_what_and_what_is_odd() {
    let part = with("joints = [\"shoulder\", \"elbow\"]\nlocked = { grip = 0.02 }").unwrap();
    assert_eq!(part.fixed_to_base, ["carriage", "head"]);
    let [upper, lower] = part.robot.links() else { panic!() };
    assert_eq!((upper.parent, lower.parent), (None, Some(0)));
    assert_eq!(
        (&upper.merged[..], &lower.merged[..]),
        (&["bracket".to_owned()][..], &["hand".to_owned(), "finger".to_owned()][..])
    );
    let locked: Vec<_> = part.locked.iter().map(|l| (l.joint.as_str(), l.position)).collect();
    assert_eq!(locked, [("lift", 0.0), ("wrist", 0.0), ("grip", 0.02), ("pan", 0.0)]);
    let said: Vec<String> = part.warnings.iter().map(ToString::to_string).collect();
    assert_eq!(
        said,
        [
            "joint wrist: it is locked at 0, outside its limits 0.2 to 3; locked = { wrist = ... } in \
          a robot.toml gives another position"
        ]
    );
}

#[test]
fn keys_that_name_no_joint_or_say_two_things_are_refused() {
    for (toml, expected) in [
        (
            "joints = [\"sholder\"]",
            "joints.0: unknown moving joint `sholder`, did you mean `shoulder`?",
        ),
        ("locked = { bolt = 0 }", "locked.bolt: unknown moving joint `bolt`"),
        (
            "joints = [\"lift\"]\nlocked = { lift = 0 }",
            "joints.0: joint lift is in joints and in locked, one of the two was expected",
        ),
        (
            "locked = { lift = inf }",
            "locked.lift: the position is inf, a finite number was expected",
        ),
        ("joints = []", "robot lifted_arm: it has no moving joint, at least one was expected"),
        (
            "joints = [\"lift\"]\n[link.hand]\nmass_kg = 1\ncom_m = [0, 0, 0]\ninertia_kg_m2 = { xx = 1, xy = 0, xz = 0, yy = 1, yz = 0, zz = 1 }",
            "link.hand: link hand is fixed to carriage, name that one",
        ),
    ] {
        let told = refused(toml);
        assert!(
            told.starts_with("robot.toml:") && told.ends_with(&format!(": {expected}")),
            "{told}"
        );
    }
    assert_eq!(
        narrowed(Some("locked = { grip = 0.01 }"), &["elbow", "grip"]).unwrap_err(),
        "joints to keep: there is no moving joint grip, it is locked at 0.01"
    );
}

#[test]
fn what_a_file_says_of_the_whole_robot_holds_for_its_part() {
    let toml = "control_rate_hz = 500\ndifferentials = [[\"elbow\", \"wrist\"], [\"lift\", \"pan\"]]
[joint.elbow]\nviscous_nm_s_per_rad = 0.5\nkp_nm_per_rad = 10\nkd_nm_s_per_rad = 1\ntorque_limit_nm = 33
[joint.grip]\ncoulomb_nm = 4
[gains.soft]\nkp_nm_per_rad = [1, 2, 3, 4, 5, 6]\nkd_nm_s_per_rad = [1, 2, 3, 4, 5, 6]
[link.hand]\nmass_kg = 2\ncom_m = [0.01, 0, 0.1]\ninertia_kg_m2 = { xx = 0.1, xy = 0, xz = 0, yy = 0.1, yz = 0, zz = 0.1 }";
    let whole = with(toml).unwrap();
    let kept = ["lift", "elbow", "pan"];
    let part = narrowed(Some(toml), &kept).unwrap();
    let elbow = &part.robot.links()[1];
    assert_eq!((elbow.actuator.viscous, elbow.joint.limits.effort), (0.5, Some(33.0)));
    // The hand weighs 2 kg now, the links before and behind it what the URDF says.
    assert!((elbow.inertia.mass - (2.0 + 2.0 + 0.2)).abs() < 1e-14, "{}", elbow.inertia.mass);
    assert_eq!(part.control.gains[1].map(|g| g.kp), Some(10.0));
    assert_eq!(
        part.control.gain_sets["soft"].iter().map(|g| g.kp).collect::<Vec<_>>(),
        [1.0, 3.0, 6.0]
    );
    assert_eq!(part.control.differentials, [[0, 2]]);
    let of = |values: [f64; 3]| kept.iter().map(|k| (*k).to_owned()).zip(values).collect();
    let [q, qd, qdd]: [BTreeMap<String, f64>; 3] =
        [of([0.2, -1.2, 0.3]), of([0.1, 3.0, 1.0]), of([0.5, 2.0, -1.0])];
    let mut expected = torques(&whole.robot, [&q, &qd, &qdd]);
    expected.retain(|name, _| kept.contains(&name.as_str()));
    assert_close(&torques(&part.robot, [&q, &qd, &qdd]), &expected);
}

#[test]
fn motors_that_a_locked_joint_shared_rub_at_the_other_joint_alone() {
    let toml = "[joint.elbow]\ncoupling = { with = \"wrist\", ratio = 2, coulomb_sum_nm = 1, \
                coulomb_difference_nm = 3, viscous_sum_nm_s_per_rad = 0.1, \
                viscous_difference_nm_s_per_rad = 0.3 }";
    let friction = |joints: &[&str]| {
        let part = narrowed(Some(toml), joints).unwrap();
        let a = part.robot.links()[0].actuator.clone();
        (a.viscous, a.coulomb_forward, a.coulomb_backward, a.coupling)
    };
    // With the wrist at rest w = qd at both motors; with the elbow at rest |w| = 2 qd, and the
    // wrist feels twice their torque.
    assert_eq!(friction(&["elbow"]), (0.4, 4.0, 4.0, None));
    assert_eq!(friction(&["wrist"]), (1.6, 8.0, 8.0, None));
    let coupling = friction(&["elbow", "wrist"]).3;
    let expected = Coupling { other: 1, ratio: 2.0, level: [1.0, 3.0], viscous: [0.1, 0.3] };
    assert_eq!(coupling, Some(expected));
}

#[test]
fn a_part_with_findings_is_written_and_loads_as_the_same_part() {
    let toml = "locked = { wrist = 1.1 }\n[joint.grip]\ncoulomb_nm = 4\n[gains.soft]
kp_nm_per_rad = [1, 2, 3, 4, 5]\nkd_nm_s_per_rad = [1, 2, 3, 4, 5]
[link.lower]\nmass_kg = 7\ncom_m = [0.01, 0, 0.1]\ninertia_kg_m2 = { xx = 0.1, xy = 0, xz = 0, yy = 0.1, yz = 0, zz = 0.1 }";
    for loaded in [
        narrowed(None, &["shoulder", "elbow"]).unwrap(),
        narrowed(Some(toml), &["pan", "shoulder", "elbow"]).unwrap(),
        narrowed(
            Some("joints = [\"shoulder\", \"elbow\", \"grip\"]\nlocked = { pan = 0.1, wrist = 2 }"),
            &["elbow"],
        )
        .unwrap(),
        with("locked = { lift = 0.3 }").unwrap(),
    ] {
        let mut robot = loaded.robot.clone();
        let link = robot.link_mut(0).unwrap();
        link.actuator.viscous = 1.25;
        let text = loaded.to_toml(&robot, "arm.urdf").unwrap();
        let again = load(&[("extended.toml", &text), ("arm.urdf", &urdf())]).unwrap();
        assert_eq!(again.robot, robot, "{text}");
        assert_eq!(again.robot_in_urdf, loaded.robot_in_urdf);
        assert_eq!((again.control, again.locked), (loaded.control, loaded.locked));
        assert_eq!((again.looks, again.fixed_to_base), (loaded.looks, loaded.fixed_to_base));
    }
    let part = narrowed(None, &["shoulder", "elbow"]).unwrap();
    let text = part.to_toml(&part.robot, "arm.urdf").unwrap();
    assert_eq!(text, "urdf = \"arm.urdf\"\njoints = [\"shoulder\", \"elbow\"]\n");
}

#[test]
fn shapes_of_locked_links_are_drawn_where_they_are() {
    let shape =
        r#"<visual><origin xyz="0 0 0.5"/><geometry><sphere radius="0.1"/></geometry></visual>"#;
    let urdf =
        arm_with("").replace(r#"<link name="lower">"#, &format!(r#"<link name="lower">{shape}"#));
    let part = |toml: &str| {
        let toml = format!("urdf = \"arm.urdf\"\n{toml}");
        load(&[("robot.toml", &toml), ("arm.urdf", &urdf)]).unwrap().looks
    };
    // A quarter turn about y brings the shape from (0, 0, 0.5) to (0.5, 0, 0) of the elbow, which
    // is 0.3 along the upper arm.
    let quarter = std::f64::consts::FRAC_PI_2;
    let drawn = &part(&format!("locked = {{ elbow = {quarter} }}")).links[0][0];
    let at = drawn.link_from_shape.translation.vector;
    assert!((at - nalgebra::Vector3::new(0.8, 0.0, 0.0)).amax() < 1e-15, "{at}");
    let looks = part("joints = [\"elbow\"]");
    assert_eq!((looks.links.len(), looks.links[0].len(), looks.base.len()), (1, 1, 0));
}
