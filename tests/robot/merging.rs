use nalgebra::{Matrix3, Rotation3, Vector3};
use robot::Robot;

use super::arm_with;

/// Terms of a few units, a handful of operations.
const ROUNDING: f64 = 1e-14;

const BOX: &str = r#"<inertia ixx="0.3" ixy="0" ixz="0" iyy="0.2" iyz="0" izz="0.1"/>"#;

#[test]
fn a_fixed_link_is_merged_as_computed_by_hand() {
    // A 1 kg link with its mass at its own origin and a 3 kg box 0.4 m along y, turned by a
    // quarter about z: masses 1 and 3 kg, 0.4 m apart, reduced mass 0.75 kg.
    let extra = format!(
        r#"<link name="tool"><inertial><mass value="3"/>{BOX}</inertial></link>
  <joint name="mount" type="fixed"><parent link="lower"/><child link="tool"/><origin xyz="0 0.4 0" rpy="0 0 1.5707963267948966"/></joint>"#
    );
    let robot = Robot::from_urdf(&arm_with(&extra)).unwrap();
    assert_eq!(robot.joint_count(), 2);
    let lower = &robot.links()[1];
    assert_eq!(lower.merged, ["tool"]);
    assert_eq!(lower.inertia.mass, 4.0);
    assert!((lower.inertia.com_in_link - Vector3::new(0.0, 0.3, 0.0)).amax() < ROUNDING);
    let parallel = 0.75 * 0.4 * 0.4;
    let by_hand = Matrix3::from_diagonal(&Vector3::new(
        1.0 + 0.2 + parallel,
        1.0 + 0.3,
        1.0 + 0.1 + parallel,
    ));
    assert!((lower.inertia.about_com - by_hand).amax() < ROUNDING, "{}", lower.inertia.about_com);
}

#[test]
fn a_chain_of_fixed_links_carries_its_poses_and_its_joints() {
    // Bracket and tool are fixed; the finger moves on the tool and hangs on the moving link.
    let extra = format!(
        r#"<link name="bracket"/>
  <joint name="one" type="fixed"><parent link="lower"/><child link="bracket"/><origin xyz="0.1 0 0" rpy="0.3 -0.2 0.7"/></joint>
  <link name="tool"><inertial><origin xyz="0 0 0.05" rpy="0 0.4 0"/><mass value="2"/>{BOX}</inertial></link>
  <joint name="two" type="fixed"><parent link="bracket"/><child link="tool"/><origin xyz="0 0.2 0" rpy="-0.5 0 0"/></joint>
  <link name="finger"/>
  <joint name="grip" type="prismatic"><parent link="tool"/><child link="finger"/><origin xyz="0 0 0.3"/></joint>"#
    );
    let robot = Robot::from_urdf(&arm_with(&extra)).unwrap();
    let (lower, finger) = (&robot.links()[1], &robot.links()[2]);
    assert_eq!((finger.parent, lower.merged.len()), (Some(1), 2));

    // The same poses with rotation matrices, and the sum taken with ten parameters about the link.
    let one = Rotation3::from_euler_angles(0.3, -0.2, 0.7);
    let two = Rotation3::from_euler_angles(-0.5, 0.0, 0.0);
    let turn = one * two;
    let tool_origin = Vector3::new(0.1, 0.0, 0.0) + one * Vector3::new(0.0, 0.2, 0.0);
    let grip = tool_origin + turn * Vector3::new(0.0, 0.0, 0.3);
    let found = finger.joint.parent_from_joint.translation.vector;
    assert!((found - grip).amax() < ROUNDING, "{found}");

    let c = tool_origin + turn * Vector3::new(0.0, 0.0, 0.05);
    let axes = (turn * Rotation3::from_euler_angles(0.0, 0.4, 0.0)).into_inner();
    let about_com = axes * Matrix3::from_diagonal(&Vector3::new(0.3, 0.2, 0.1)) * axes.transpose();
    let tool = about_com + 2.0 * (Matrix3::identity() * c.dot(&c) - c * c.transpose());
    let sum = tool + Matrix3::identity();
    let expected = [
        3.0,
        2.0 * c.x,
        2.0 * c.y,
        2.0 * c.z,
        sum.m11,
        sum.m12,
        sum.m22,
        sum.m13,
        sum.m23,
        sum.m33,
    ];
    for (found, expected) in lower.inertia.parameters().iter().zip(expected) {
        assert!((found - expected).abs() < ROUNDING, "{found} is not {expected}");
    }
}

#[test]
fn links_fixed_to_the_base_have_no_part_in_the_dynamics() {
    let heavy = format!("<inertial><mass value=\"50\"/>{BOX}</inertial>");
    let extra = format!(
        r#"<link name="table">{heavy}</link>
  <joint name="bolt" type="fixed"><parent link="base"/><child link="table"/></joint>"#
    );
    let loaded = super::load(&[("a.urdf", &arm_with(&extra))]).unwrap();
    assert_eq!(
        (loaded.base_link.as_str(), &loaded.fixed_to_base[..]),
        ("base", &["table".to_owned()][..])
    );
    assert_eq!(loaded.robot, Robot::from_urdf(&arm_with("")).unwrap());
}

#[test]
fn joints_come_depth_first_in_the_order_of_the_file() {
    let joint = |name: &str, parent: &str, child: &str| {
        format!(
            r#"<link name="{child}"/><joint name="{name}" type="revolute"><parent link="{parent}"/><child link="{child}"/></joint>"#
        )
    };
    // Children are listed before their parents, and the two branches are interleaved.
    let urdf = format!(
        "<robot name=\"tree\">{}{}{}{}{}<link name=\"base\"/></robot>",
        joint("l2", "left", "left_tip"),
        joint("r2", "right", "right_tip"),
        joint("r1", "trunk", "right"),
        joint("l1", "trunk", "left"),
        joint("t", "base", "trunk"),
    );
    let robot = Robot::from_urdf(&urdf).unwrap();
    assert_eq!(robot.joint_names().collect::<Vec<_>>(), ["t", "r1", "r2", "l1", "l2"]);
    let parents: Vec<_> = robot.links().iter().map(|l| l.parent).collect();
    assert_eq!(parents, [None, Some(0), Some(1), Some(0), Some(3)]);
}
