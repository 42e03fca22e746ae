//! The user's own URDF with what was found.

use exchange::{Format, export};
use robot::Robot;

use crate::rich::{DRIVES, State, states, torque, urdf, wam_with};

/// What a URDF can hold of the drives.
fn held(robot: &Robot) -> Robot {
    let mut robot = robot.clone();
    for index in 0..robot.joint_count() {
        let drive = &mut robot.link_mut(index).unwrap().actuator;
        let mean = 0.5 * (drive.coulomb_forward + drive.coulomb_backward);
        let kept = robot::Actuator {
            viscous: drive.viscous,
            coulomb_forward: mean,
            coulomb_backward: mean,
            encoder_offset: drive.encoder_offset,
            ..Default::default()
        };
        *drive = kept;
    }
    robot
}

#[test]
fn the_urdf_read_again_needs_the_torque_that_it_can_hold() {
    let folder = tempfile::tempdir().unwrap();
    let loaded = wam_with(folder.path(), DRIVES);
    let text = export(&loaded, &urdf(), Format::Urdf).unwrap().text;
    let gravity = loaded.robot.gravity_in_base();
    let again = Robot::from_urdf(&text).unwrap().with_gravity(gravity);
    let expected = held(&loaded.robot);
    for state in states(7, 20) {
        let (new, old) = (torque(&again, &state), torque(&expected, &state));
        let nominal = torque(&loaded.robot_in_urdf, &state);
        let apart =
            |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        assert!(apart(&new, &old) < 1e-9, "{new:?} {old:?}");
        assert!(apart(&nominal, &old) > 1e-2, "the nominal robot does as well");
    }
    let limits = again.links()[0].joint.limits;
    assert_eq!(limits.effort, Some(50.0));
    let (low, high) = limits.position.unwrap();
    assert!((low + 2.5).abs() < 1e-12 && (high - 2.7).abs() < 1e-12, "{low} {high}");
}

#[test]
fn nothing_but_what_differs_is_written() {
    let folder = tempfile::tempdir().unwrap();
    let unchanged = export(&wam_with(folder.path(), ""), &urdf(), Format::Urdf).unwrap();
    assert_eq!(unchanged.text, urdf());
    assert!(unchanged.fates.is_empty(), "{:?}", unchanged.fates);
    let keys = "[joint.j4_elbow_pitch]\ncoulomb_nm = 0.8\n";
    let text = export(&wam_with(folder.path(), keys), &urdf(), Format::Urdf).unwrap().text;
    let original = urdf();
    let pairs = original.lines().zip(text.lines());
    let differing: Vec<_> = pairs.filter(|(old, new)| old != new).collect();
    assert_eq!(differing.len(), 1, "{differing:?}");
    assert!(differing[0].1.contains("<dynamics damping=\"0\" friction=\"0.8\"/>"), "{differing:?}");
}

#[test]
fn a_payload_is_added_to_a_link_whose_fixed_parts_keep_theirs() {
    let text = r#"<robot name="arm">
  <!-- a comment that stays -->
  <link name="base"/>
  <link name="arm"/>
  <link name="tool"><inertial><origin xyz="0 0 0.1"/><mass value="2"/><inertia ixx="0.1" ixy="0" ixz="0" iyy="0.1" iyz="0" izz="0.1"/></inertial></link>
  <joint name="hinge" type="continuous"><parent link="base"/><child link="arm"/><axis xyz="0 1 0"/></joint>
  <joint name="mount" type="fixed"><parent link="arm"/><child link="tool"/><origin xyz="0.3 0 0"/></joint>
</robot>"#;
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("arm.urdf"), text).unwrap();
    let toml = "urdf = \"arm.urdf\"\n[joint.hinge]\nviscous_nm_s_per_rad = 0.5\n[link.arm]\nmass_kg = 3.0\ncom_m = [0.35, 0.0, 0.1]\ninertia_kg_m2 = { xx = 0.2, xy = 0.0, xz = 0.01, yy = 0.25, yz = 0.0, zz = 0.2 }\n";
    std::fs::write(folder.path().join("robot.toml"), toml).unwrap();
    let loaded = Robot::load(&folder.path().join("robot.toml")).unwrap();
    let written = export(&loaded, text, Format::Urdf).unwrap().text;
    assert!(written.contains("<!-- a comment that stays -->"));
    assert!(written.contains(r#"<mass value="2"/>"#) && written.contains(r#"<mass value="1"/>"#));
    let again = Robot::from_urdf(&written).unwrap();
    let state: State = [vec![0.4], vec![0.7], vec![1.1]];
    let (new, old) = (torque(&again, &state)[0], torque(&loaded.robot, &state)[0]);
    assert!((new - old).abs() < 1e-12, "{new} {old}");
}

#[test]
fn a_text_that_is_another_urdf_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    let loaded = wam_with(folder.path(), DRIVES);
    let other = "<robot name=\"r\"><link name=\"base\"/></robot>";
    let error = export(&loaded, other, Format::Urdf).unwrap_err().to_string();
    assert_eq!(error, "the URDF has no joint j1_base_yaw, which the robot has");
    let broken = export(&loaded, "<robot><link></robot>", Format::Urdf).unwrap_err().to_string();
    assert!(broken.starts_with("byte "), "{broken}");
}

/// An MJCF of one format is read into a robot that needs the same torque, and so is the URDF made of it.
#[test]
fn an_mjcf_read_again_needs_the_same_torque() {
    let folder = tempfile::tempdir().unwrap();
    let keys: String =
        DRIVES.lines().filter(|l| !l.starts_with("coupling")).map(|l| format!("{l}\n")).collect();
    let loaded = wam_with(folder.path(), &keys);
    let text = export(&loaded, &urdf(), Format::Mjcf).unwrap().text;
    std::fs::write(folder.path().join("arm.xml"), &text).unwrap();
    let again = Robot::load(&folder.path().join("arm.xml")).unwrap();
    let fresh = export(&again, &text, Format::Urdf).unwrap().text;
    let from_urdf = Robot::from_urdf(&fresh).unwrap().with_gravity(again.robot.gravity_in_base());
    for state in states(7, 20) {
        let of = |robot: &Robot| torque(robot, &state);
        let apart =
            |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max);
        // A constant torque is a spring of 0.0001 /rad there.
        assert!(apart(&of(&again.robot), &of(&loaded.robot)) < 3e-4);
        assert!(apart(&of(&from_urdf), &of(&held(&again.robot))) < 1e-9);
    }
    assert_eq!(again.robot.links()[2].actuator.lag_s, 0.004);
    assert_eq!(again.robot.links()[0].joint.limits.effort, Some(50.0));
}
