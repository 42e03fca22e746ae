//! URDFs as they are published: frames without mass, mimics, free bases, packages of meshes.

use std::path::PathBuf;

use robot::{LoadOptions, LockedJoint, Packages, Robot, RobotWarning, Shape};

use super::{arm_with, load, refused};

const NO_MASS: &str = r#"<inertial><mass value="0"/><inertia ixx="0" ixy="0" ixz="0" iyy="0" iyz="0" izz="0"/></inertial>"#;

#[test]
fn a_link_of_mass_zero_that_is_fixed_or_is_the_base_is_a_frame() {
    let bare = r#"<link name="tool"/>
  <joint name="mount" type="fixed"><parent link="lower"/><child link="tool"/></joint>"#
        .to_owned();
    let heavy =
        bare.replace(r#"<link name="tool"/>"#, &format!(r#"<link name="tool">{NO_MASS}</link>"#));
    let [bare, heavy] = [bare, heavy].map(|extra| {
        let urdf = arm_with(&extra);
        assert!(load(&[("a.urdf", &urdf)]).unwrap().warnings.is_empty());
        Robot::from_urdf(&urdf).unwrap()
    });
    assert_eq!(heavy, bare);
    let base = arm_with("")
        .replace(r#"<link name="base"/>"#, &format!(r#"<link name="base">{NO_MASS}</link>"#));
    assert_eq!(Robot::from_urdf(&base).unwrap(), Robot::from_urdf(&arm_with("")).unwrap());
}

#[test]
fn a_moving_link_of_mass_zero_takes_its_mass_from_what_is_fixed_to_it() {
    let hand = |inside: &str| {
        arm_with(&format!(
            r#"<link name="hand">{NO_MASS}</link>
  <joint name="wrist" type="revolute"><parent link="lower"/><child link="hand"/></joint>{inside}"#
        ))
    };
    assert_eq!(
        refused(&hand("")),
        "robot.urdf: link hand: mass is 0 kg, a positive number was expected"
    );
    let tool = r#"<link name="tool"><inertial><mass value="0.5"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <joint name="mount" type="fixed"><parent link="hand"/><child link="tool"/></joint>"#;
    let loaded = load(&[("a.urdf", &hand(tool))]).unwrap();
    assert_eq!(loaded.robot.links()[2].inertia.mass, 0.5);
    assert_eq!(loaded.warnings, []);
    // What robot.toml says of the body counts as well, and so does its joint being locked.
    let says = |toml: &str| {
        let toml = format!("urdf = \"a.urdf\"\n{toml}");
        load(&[("robot.toml", &toml), ("a.urdf", &hand(""))]).unwrap().robot
    };
    let inertia = "inertia_kg_m2 = { xx = 1, xy = 0, xz = 0, yy = 1, yz = 0, zz = 1 }";
    let robot = says(&format!("[link.hand]\nmass_kg = 3\ncom_m = [0, 0, 0]\n{inertia}"));
    assert_eq!(robot.links()[2].inertia.mass, 3.0);
    assert_eq!(says("locked = { wrist = 0.1 }").joint_count(), 2);
}

#[test]
fn inertia_without_mass_on_a_fixed_link_counts_with_the_body_that_it_is_fixed_to() {
    let inertia = r#"<inertia ixx="0.25" ixy="0" ixz="0" iyy="0.25" iyz="0" izz="0.25"/>"#;
    let extra = format!(
        r#"<link name="foot"><inertial><mass value="0"/>{inertia}</inertial></link>
  <joint name="mount" type="fixed"><parent link="lower"/><child link="foot"/><origin xyz="1 0 0"/></joint>"#
    );
    let loaded = load(&[("a.urdf", &arm_with(&extra))]).unwrap();
    assert_eq!(loaded.robot.links()[1].inertia.about_com.m11, 1.25);
    assert_eq!(loaded.robot.links()[1].inertia.mass, 1.0);
    assert_eq!(loaded.warnings, []);
}

/// A gripper on `lower`: a finger that moves and one that mimics it.
fn gripper(mimic: &str) -> String {
    let finger = |name: &str, y: f64, mimic: &str| {
        format!(
            r#"<link name="{name}"><inertial><origin xyz="0 0.01 0.03"/><mass value="0.2"/><inertia ixx="0.001" ixy="0" ixz="0" iyy="0.001" iyz="0" izz="0.001"/></inertial></link>
  <joint name="{name}_joint" type="prismatic"><parent link="lower"/><child link="{name}"/><origin xyz="0.3 0 0"/><axis xyz="0 {y} 0"/><limit lower="0" upper="0.04" effort="20" velocity="1"/>{mimic}</joint>"#
        )
    };
    finger("left", 1.0, "") + &finger("right", -1.0, mimic)
}

#[test]
fn a_mimic_joint_is_held_at_the_zero_of_its_moving_master_with_a_warning() {
    let urdf = arm_with(&gripper(r#"<mimic joint="left_joint" multiplier="2" offset="0.01"/>"#));
    let loaded = load(&[("a.urdf", &urdf)]).unwrap();
    let names: Vec<&str> = loaded.robot.joint_names().collect();
    assert_eq!(names, ["shoulder", "elbow", "left_joint"]);
    assert_eq!(loaded.robot.links()[1].merged, ["right"]);
    let mimics = Some("left_joint".to_owned());
    let joint = "right_joint".to_owned();
    assert_eq!(loaded.locked, [LockedJoint { joint, position: 0.01, mimics }]);
    let said: Vec<String> = loaded.warnings.iter().map(ToString::to_string).collect();
    assert_eq!(
        said,
        ["joint right_joint: it mimics left_joint, which moves, but is held at 0.01: what its \
          motion adds to the torque of left_joint is left out"]
    );
}

#[test]
fn a_mimic_joint_is_held_where_its_locked_master_has_it() {
    let chained = r#"<link name="tip"><inertial><mass value="0.1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <joint name="tip_joint" type="revolute"><parent link="left"/><child link="tip"/><mimic joint="right_joint" multiplier="-3" offset="0.5"/></joint>"#;
    let mimic = r#"<mimic joint="left_joint" multiplier="2" offset="0.01"/>"#;
    let urdf = arm_with(&(gripper(mimic) + chained));
    let locks = |toml: &str| {
        let toml = format!("urdf = \"a.urdf\"\n{toml}");
        let loaded = load(&[("robot.toml", &toml), ("a.urdf", &urdf)]).unwrap();
        let at = loaded.locked.iter().map(|lock| (lock.joint.clone(), lock.position));
        (at.collect::<Vec<_>>(), loaded.warnings)
    };
    let assert_at = |found: Vec<(String, f64)>, expected: [f64; 3]| {
        let names: Vec<&str> = found.iter().map(|(name, _)| name.as_str()).collect();
        assert_eq!(names, ["left_joint", "tip_joint", "right_joint"]);
        let close = |((_, q), e): (&(String, f64), f64)| (q - e).abs() < 1e-12;
        assert!(found.iter().zip(expected).all(close), "{found:?}");
    };
    let (found, warnings) = locks("locked = { left_joint = 0.01 }");
    assert_at(found, [0.01, -3.0 * 0.03 + 0.5, 2.0 * 0.01 + 0.01]);
    assert_eq!(warnings, []);
    let (found, warnings) = locks("joints = [\"shoulder\", \"elbow\"]");
    assert_at(found, [0.0, -3.0 * 0.01 + 0.5, 0.01]);
    assert_eq!(warnings, []);
    // A position of its own counts, for what follows it as well.
    let (found, _) = locks("locked = { left_joint = 0.01, right_joint = 0.04 }");
    assert_at(found, [0.01, -3.0 * 0.04 + 0.5, 0.04]);
}

#[test]
fn a_free_base_is_held_and_said_to_be() {
    for kind in ["floating", "planar"] {
        let urdf = arm_with(&format!(
            r#"<link name="world"/>
  <joint name="free" type="{kind}"><parent link="world"/><child link="base"/><origin xyz="0 0 1"/></joint>"#
        ));
        let loaded = load(&[("a.urdf", &urdf)]).unwrap();
        assert_eq!((loaded.base_link.as_str(), loaded.robot.joint_count()), ("world", 2));
        let origin = loaded.robot.links()[0].joint.parent_from_joint.translation;
        assert_eq!(origin.vector.z, 1.0);
        let said = format!(
            "joint free: its type is {kind} and logs do not tell it: the base is held fixed"
        );
        assert_eq!(loaded.warnings[0].to_string(), said);
    }
}

#[test]
fn limbs_on_a_base_with_mass_are_said_to_be_on_a_fixed_one() {
    let limb = r#"<link name="leg"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <joint name="hip" type="revolute"><parent link="base"/><child link="leg"/></joint>"#;
    let light = arm_with(limb);
    assert_eq!(load(&[("a.urdf", &light)]).unwrap().warnings, []);
    let body = r#"<link name="base"><inertial><mass value="9"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>"#;
    let heavy = light.replace(r#"<link name="base"/>"#, body);
    let warnings = load(&[("a.urdf", &heavy)]).unwrap().warnings;
    assert_eq!(warnings, [RobotWarning::LimbsOnBase { link: "base".to_owned(), limbs: 2 }]);
    let part = "urdf = \"a.urdf\"\njoints = [\"shoulder\", \"elbow\"]";
    assert_eq!(load(&[("robot.toml", part), ("a.urdf", &heavy)]).unwrap().warnings, []);
}

#[test]
fn a_closed_chain_is_told_how_to_open_it() {
    let extra =
        r#"<joint name="rod" type="revolute"><parent link="base"/><child link="lower"/></joint>"#;
    assert_eq!(
        refused(&arm_with(extra)),
        "robot.urdf: link lower: it is the child of joints elbow and rod, one was expected: remove \
         one of the two to cut the closed chain open; the force that joint carries is then left out"
    );
}

#[test]
fn meshes_are_found_in_packages_that_are_named_or_on_the_paths_of_ros() {
    let visual = r#"<visual><geometry><mesh filename="package://arm_looks/meshes/a.stl"/></geometry></visual>"#;
    let urdf = arm_with("").replacen("<inertial>", &format!("{visual}<inertial>"), 1);
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("a.urdf");
    std::fs::write(&path, urdf).unwrap();
    let place = |parent: &str| -> (PathBuf, PathBuf) {
        let (root, package) = (folder.path().join(parent), folder.path().join(parent));
        let package = if parent == "prefix" { package.join("share") } else { package };
        let meshes = package.join("arm_looks/meshes");
        std::fs::create_dir_all(&meshes).unwrap();
        std::fs::write(meshes.join("a.stl"), "solid a\nendsolid a\n").unwrap();
        (root, meshes.join("a.stl"))
    };
    let found = |packages: Packages| {
        let options = LoadOptions { packages, ..LoadOptions::default() };
        let loaded = Robot::load_with(&path, &options).unwrap();
        match loaded.looks.links[0].first().map(|v| v.shape.clone()) {
            Some(Shape::Mesh { file, .. }) => Ok(file),
            _ => {
                Err(loaded.warnings.iter().map(ToString::to_string).collect::<Vec<_>>().join("\n"))
            }
        }
    };
    assert_eq!(
        found(Packages::default()),
        Err("1 mesh files are not there or too large, package://arm_looks/meshes/a.stl is one: \
             pictures do without; --package NAME=DIR says where one is"
            .to_owned())
    );
    let ((prefix, in_share), (workspace, in_workspace)) = (place("prefix"), place("src"));
    let ament = Packages::from_paths(None, Some(prefix.as_os_str()));
    assert_eq!(found(ament.clone()), Ok(in_share.clone()));
    let ros = Packages::from_paths(Some(workspace.as_os_str()), Some(prefix.as_os_str()));
    assert_eq!(found(ros), Ok(in_workspace.clone()));
    let itself = workspace.join("arm_looks");
    let ros = Packages::from_paths(Some(itself.as_os_str()), None);
    assert_eq!(found(ros), Ok(in_workspace.clone()));
    let named = Packages { named: [("arm_looks".to_owned(), itself)].into(), ..ament };
    assert_eq!(found(named), Ok(in_workspace));
}
