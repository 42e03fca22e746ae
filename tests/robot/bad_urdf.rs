use proptest::prelude::*;
use robot::{Robot, RobotWarning};

use super::{arm_with, in_workspace, load, refused};

#[test]
fn numbers_that_are_text_are_refused() {
    let urdf = arm_with("").replace("xyz=\"0.3 0 0\"", "xyz=\"0.3 0,0\"");
    assert_eq!(
        refused(&urdf),
        "robot.urdf: line 6: joint elbow: <origin xyz=\"0.3 0,0\"> was found, a number was expected"
    );
    let urdf = arm_with("").replace("mass value=\"2\"", "mass value=\"two\"");
    assert_eq!(
        refused(&urdf),
        "robot.urdf: line 3: link upper: <mass value=\"two\"> was found, a number was expected"
    );
    let urdf = arm_with("").replace("xyz=\"0.3 0 0\"", "xyz=\"0.3 0\"");
    assert!(refused(&urdf).starts_with("robot.urdf: line 6: joint elbow: "), "{}", refused(&urdf));
}

#[test]
fn missing_parts_are_named() {
    let urdf = arm_with("").replace("<mass value=\"2\"/>", "");
    assert!(
        refused(&urdf).contains("line 3: link upper: ") && refused(&urdf).contains("mass"),
        "{}",
        refused(&urdf)
    );
    let urdf = arm_with("").replace("<child link=\"lower\"/>", "");
    assert!(
        refused(&urdf).contains("line 6: joint elbow: ") && refused(&urdf).contains("child"),
        "{}",
        refused(&urdf)
    );
}

#[test]
fn numbers_that_are_not_finite_are_refused() {
    for (old, new, message) in [
        ("mass value=\"2\"", "mass value=\"inf\"", "link upper: mass is inf"),
        ("ixx=\"1\"", "ixx=\"nan\"", "link upper: inertia is NaN"),
        ("xyz=\"0.3 0 0\"", "xyz=\"1e999 0 0\"", "joint elbow: origin is inf"),
        ("axis xyz=\"0 1 0\"", "axis xyz=\"0 nan 0\"", "joint shoulder: axis is NaN"),
    ] {
        let urdf = arm_with("").replacen(old, new, 1);
        let expected = format!("robot.urdf: {message}, a finite number was expected");
        assert_eq!(refused(&urdf), expected);
    }
}

#[test]
fn a_mass_that_is_not_positive_is_refused() {
    for (value, shown) in [("0", "0"), ("-1.5", "-1.5"), ("nan", "NaN")] {
        let urdf = arm_with("").replace("mass value=\"2\"", &format!("mass value=\"{value}\""));
        assert_eq!(
            refused(&urdf),
            format!("robot.urdf: link upper: mass is {shown} kg, a positive number was expected")
        );
    }
}

#[test]
fn joints_that_are_not_modelled_are_refused() {
    for kind in ["floating", "planar", "spherical"] {
        let urdf = arm_with("").replace("continuous", kind);
        assert_eq!(
            refused(&urdf),
            format!(
                "robot.urdf: joint elbow: its type is {kind}, revolute, continuous, prismatic or \
                 fixed was expected{}",
                if kind == "spherical" {
                    String::new()
                } else {
                    format!("; only a base may be {kind}, which is then held fixed")
                }
            )
        );
    }
    let urdf = arm_with("").replace("type=\"continuous\">", "type=\"hinge\">");
    assert!(refused(&urdf).contains("line 6: joint elbow: "), "{}", refused(&urdf));
}

#[test]
fn mimics_of_nothing_and_in_rings_are_refused() {
    let mimic = |attributes: &str| {
        arm_with("").replace("<origin", &format!("<mimic {attributes}/><origin"))
    };
    assert_eq!(
        refused(&mimic("joint=\"sholder\"")),
        "robot.urdf: joint elbow: <mimic>: there is no joint sholder, did you mean shoulder?"
    );
    assert_eq!(
        refused(&mimic("joint=\"elbow\"")),
        "robot.urdf: joint elbow: it mimics itself, directly or through others, a joint that moves \
         by itself was expected in the end"
    );
    assert_eq!(
        refused(&mimic("joint=\"shoulder\" offset=\"inf\"")),
        "robot.urdf: joint elbow: mimic offset is inf, a finite number was expected"
    );
}

#[test]
fn an_axis_without_a_direction_is_refused_and_others_are_normalised() {
    let urdf = arm_with("").replacen("axis xyz=\"0 1 0\"", "axis xyz=\"0 0 0\"", 1);
    assert_eq!(
        refused(&urdf),
        "robot.urdf: joint shoulder: its axis is (0, 0, 0), a direction was expected"
    );
    for length in ["2", "1e-200", "1e200"] {
        let urdf = arm_with("").replacen("xyz=\"0 1 0\"", &format!("xyz=\"0 {length} 0\""), 1);
        let robot = load(&[("robot.urdf", &urdf)]).unwrap().robot;
        assert_eq!(robot.links()[0].joint.axis_in_joint.as_slice(), [0.0, 1.0, 0.0]);
    }
}

#[test]
fn limits_are_read_and_checked() {
    let with = |limit: &str| {
        arm_with("").replacen("<axis", &format!("<limit {limit} velocity=\"2\"/><axis"), 1)
    };
    let limits = |urdf: &str| load(&[("a.urdf", urdf)]).unwrap().robot.links()[0].joint.limits;
    let known = limits(&with("lower=\"-1\" upper=\"2\" effort=\"30\""));
    assert_eq!(
        (known.position, known.velocity, known.effort),
        (Some((-1.0, 2.0)), Some(2.0), Some(30.0))
    );
    let unknown = limits(&with("effort=\"0\""));
    assert_eq!((unknown.position, unknown.effort), (None, None));
    assert_eq!(
        refused(&with("lower=\"2\" upper=\"1\"")),
        "robot.urdf: joint shoulder: its lower limit 2 is above its upper limit 1"
    );
    assert_eq!(
        refused(&with("effort=\"-3\"")),
        "robot.urdf: joint shoulder: effort limit is -3, a number not below 0 was expected"
    );
}

#[test]
fn a_loop_is_refused_by_the_name_of_its_link() {
    let closing =
        r#"<joint name="rod" type="revolute"><parent link="base"/><child link="lower"/></joint>"#;
    assert_eq!(
        refused(&arm_with(closing)),
        "robot.urdf: link lower: it is the child of joints elbow and rod, one was expected: remove one of \
         the two to cut the closed chain open; the force that joint carries is then left out"
    );
    let ring = r#"<link name="a"/><link name="b"/><link name="c"/>
  <joint name="ab" type="fixed"><parent link="a"/><child link="b"/></joint>
  <joint name="ba" type="fixed"><parent link="b"/><child link="a"/></joint>
  <joint name="bc" type="fixed"><parent link="b"/><child link="c"/></joint>"#;
    let looped =
        "it is its own ancestor, a tree without loops was expected: remove a joint of the loop";
    assert_eq!(refused(&arm_with(ring)), format!("robot.urdf: link a: {looped}"));
    // No root at all, and the file starts with a link that only hangs on the ring.
    let only = format!(
        "<robot name=\"r\"><link name=\"d\"/>{ring}<joint name=\"cd\" type=\"fixed\"><parent link=\"c\"/><child link=\"d\"/></joint></robot>"
    );
    assert_eq!(refused(&only), format!("robot.urdf: link a: {looped}"));
}

#[test]
fn the_first_of_several_origins_counts_with_a_warning() {
    let twice = "<origin xyz=\"0.3 0 0\"/>\n<origin xyz=\"9 9 9\"/>";
    let urdf = arm_with("").replace("<origin xyz=\"0.3 0 0\"/>", twice);
    let loaded = load(&[("a.urdf", &urdf)]).unwrap();
    assert_eq!(loaded.robot, Robot::from_urdf(&arm_with("")).unwrap());
    let messages: Vec<String> = loaded.warnings.iter().map(ToString::to_string).collect();
    assert_eq!(messages, ["joint elbow: line 7 holds a second <origin>, the first counts"]);
}

#[test]
fn links_that_do_not_make_one_tree_are_refused() {
    assert_eq!(
        refused(&arm_with("<link name=\"stray\"/>")),
        "robot.urdf: links base and stray both have no parent, one root was expected"
    );
    assert_eq!(
        refused(&arm_with("").replace("parent link=\"upper\"", "parent link=\"uper\"")),
        "robot.urdf: joint elbow: there is no link uper, did you mean upper?"
    );
    assert_eq!(
        refused(&arm_with("").replace("parent link=\"upper\"", "parent link=\"gripper_7\"")),
        "robot.urdf: joint elbow: there is no link gripper_7, one of base, upper, lower was expected"
    );
    assert_eq!(
        refused("<robot name=\"r\"/>"),
        "robot.urdf: line 1: no <link> was found, at least one was expected"
    );
    assert_eq!(
        refused("<robot name=\"r\"><link name=\"base\"/></robot>"),
        "robot.urdf: robot r: it has no moving joint, at least one was expected"
    );
    assert_eq!(
        refused(&arm_with("<link name=\"upper\"/>")),
        "robot.urdf: the name upper is used by two links, names must be unique"
    );
    let twice = r#"<link name="tip"/><joint name="elbow" type="fixed"><parent link="lower"/><child link="tip"/></joint>"#;
    assert_eq!(
        refused(&arm_with(twice)),
        "robot.urdf: the name elbow is used by two joints, names must be unique"
    );
}

#[test]
fn meshes_are_not_looked_for() {
    let mesh = "<visual><geometry><mesh filename=\"package://nowhere/a.stl\"/></geometry></visual>";
    let urdf =
        arm_with("").replace("<link name=\"upper\">", &format!("<link name=\"upper\">{mesh}"));
    assert_eq!(
        load(&[("a.urdf", &urdf)]).unwrap().robot,
        load(&[("a.urdf", &arm_with(""))]).unwrap().robot
    );
}

#[test]
fn weak_inertias_are_warnings_by_link_name() {
    let urdf = arm_with("").replacen("izz=\"1\"", "izz=\"3\"", 1);
    let warnings = load(&[("a.urdf", &urdf)]).unwrap().warnings;
    let [RobotWarning::Inertia { link, .. }] = &warnings[..] else { panic!("{warnings:?}") };
    assert_eq!(link, "upper");
    assert_eq!(
        warnings[0].to_string(),
        "link upper: largest principal moment of inertia exceeds the sum of the other two by \
         1.000e0 kg m², no body has such an inertia"
    );
    let flipped = arm_with("").replacen("izz=\"1\"", "izz=\"-1\"", 1);
    let warnings = load(&[("a.urdf", &flipped)]).unwrap().warnings;
    assert!(warnings[0].to_string().contains("-1.000e0 kg m²"), "{warnings:?}");
    assert_eq!(load(&[("a.urdf", &arm_with(""))]).unwrap().warnings, []);
}

/// A link with an inertia (diagonal, kg m²), fixed to another.
fn fixed(name: &str, parent: &str, mass: f64, [xx, yy, zz]: [f64; 3]) -> String {
    format!(
        r#"<link name="{name}"><inertial><mass value="{mass}"/><inertia ixx="{xx}" ixy="0" ixz="0" iyy="{yy}" iyz="0" izz="{zz}"/></inertial></link>
  <joint name="{name}_mount" type="fixed"><parent link="{parent}"/><child link="{name}"/></joint>"#
    )
}

#[test]
fn what_is_fixed_to_a_sound_body_or_to_the_base_is_judged_with_it() {
    let impossible = [1e-3, 1e-3, 3e-3];
    for (parent, mass, moments) in [
        ("upper", 0.1, impossible),
        ("upper", 0.0, [1e-9, 0.0, 0.0]),
        ("upper", 1e-6, [0.0, 0.0, 0.0]),
        ("base", 2.0, [1.0, 1.0, 5.0]),
        ("base", 0.0, [1.0, -1.0, 1.0]),
    ] {
        let loaded = load(&[("a.urdf", &arm_with(&fixed("part", parent, mass, moments)))]).unwrap();
        assert_eq!(loaded.warnings, [], "{parent} {mass} {moments:?}");
    }
    let heavy = fixed("part", "upper", 2.0, [1.0, 1.0, 5.0]);
    let loaded = load(&[("a.urdf", &arm_with(&heavy))]).unwrap();
    let told: Vec<String> = loaded.warnings.iter().map(ToString::to_string).collect();
    assert_eq!(
        told,
        ["link upper: largest principal moment of inertia exceeds the sum of the other two by \
          2.000e0 kg m², no body has such an inertia"]
    );
}

#[test]
fn rounding_a_rod_and_a_point_mass_are_sound() {
    for moments in [
        [-2e-22, 0.5, 0.5],
        [0.0, 0.5, 0.5],
        [0.25, 0.25, 0.5 + 1e-9],
        [0.0, 0.0, 0.0],
        [-5e-20, 0.0, 1e-19],
    ] {
        let [xx, yy, zz] = moments;
        let of_file = r#"ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1""#;
        let own = format!(r#"ixx="{xx}" ixy="0" ixz="0" iyy="{yy}" iyz="0" izz="{zz}""#);
        let urdf = arm_with("").replacen(of_file, &own, 1);
        assert_ne!(urdf, arm_with(""));
        assert_eq!(load(&[("a.urdf", &urdf)]).unwrap().warnings, [], "{moments:?}");
    }
}

/// Two axes at one place need a frame between them; a link between two places that has no inertia lacks one.
#[test]
fn a_frame_between_two_axes_at_one_place_needs_no_inertia() {
    let between = |xyz: &str| {
        arm_with(&format!(
            r#"<link name="frame"/><joint name="yaw" type="revolute"><parent link="lower"/><child link="frame"/></joint>
  <link name="hand"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link>
  <joint name="pitch" type="revolute"><parent link="frame"/><child link="hand"/><origin xyz="{xyz}"/><axis xyz="0 1 0"/></joint>"#
        ))
    };
    let warnings = |xyz: &str| load(&[("a.urdf", &between(xyz))]).unwrap().warnings;
    assert_eq!(warnings("0 0 0"), []);
    assert_eq!(warnings("0.2 0 0"), [RobotWarning::Massless { link: "frame".to_owned() }]);
}

#[test]
fn a_moving_link_without_inertia_is_massless_with_a_warning() {
    let extra = r#"<link name="hand"/><joint name="wrist" type="prismatic"><parent link="lower"/><child link="hand"/></joint>"#;
    let loaded = load(&[("a.urdf", &arm_with(extra))]).unwrap();
    assert_eq!(loaded.robot.links()[2].inertia, robot::Inertia::zero());
    assert_eq!(loaded.warnings, [RobotWarning::Massless { link: "hand".to_owned() }]);
}

/// The upper link reaches .3 m to the elbow, and its body of 2 kg has a radius of gyration of .1 m: 1e6 times that moment are kg mm².
#[test]
fn an_inertia_that_is_wider_than_its_link_is_told_with_its_unit() {
    let with = |moment: &str| arm_with("").replacen("\"1\"", &format!("\"{moment}\""), 3);
    assert_eq!(load(&[("a.urdf", &with("0.02"))]).unwrap().warnings, []);
    let loaded = load(&[("a.urdf", &with("2e4"))]).unwrap();
    let [RobotWarning::WideInertia(wide)] = &loaded.warnings[..] else { panic!("{loaded:?}") };
    assert!(
        (wide.radius_m - 100.0).abs() < 1e-9 && (wide.extent_m - 0.3).abs() < 1e-12,
        "{wide:?}"
    );
    assert_eq!(
        wide.to_string(),
        "link upper: a moment of inertia of 2.000e4 kg m² has a radius of gyration of 100.00 m, but the link reaches \
         0.30 m; the value may be in kg mm², kg m² were expected"
    );
    let toml = "urdf = \"a.urdf\"\n[link.upper]\nmass_kg = 2.0\ncom_m = [0.0, 0.0, 0.0]\n\
                inertia_kg_m2 = { xx = 0.02, xy = 0.0, xz = 0.0, yy = 0.02, yz = 0.0, zz = 0.02 }\n";
    let mended = load(&[("robot.toml", toml), ("a.urdf", &with("2e4"))]).unwrap();
    assert_eq!(mended.warnings, []);
}

#[test]
fn damping_and_friction_of_the_urdf_become_nominal_friction() {
    let urdf =
        arm_with("").replacen("<axis", "<dynamics damping=\"0.7\" friction=\"0.2\"/><axis", 1);
    let robot = load(&[("a.urdf", &urdf)]).unwrap().robot;
    let a = &robot.links()[0].actuator;
    assert_eq!((a.viscous, a.coulomb_forward, a.coulomb_backward), (0.7, 0.2, 0.2));
    assert_eq!(robot.links()[1].actuator.viscous, 0.0);
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(2000))]

    /// Ten bytes of a real URDF overwritten, or its end cut off: an answer, never a panic.
    #[test]
    fn damaged_files_never_panic(
        edits in prop::collection::vec((0usize..9000, any::<u8>()), 0..10),
        keep in 0usize..12000,
    ) {
        let path = in_workspace("robots/wam7/robot.urdf");
        let mut bytes = std::fs::read(path).unwrap();
        bytes.truncate(keep.max(20));
        for (at, byte) in edits {
            if let Some(b) = bytes.get_mut(at) {
                *b = byte % 128;
            }
        }
        if let Ok(robot) = Robot::from_urdf(&String::from_utf8_lossy(&bytes)) {
            prop_assert!(robot.joint_count() > 0);
        }
    }

    /// Valid fragments in any order and number.
    #[test]
    fn shuffled_elements_never_panic(picks in prop::collection::vec(0usize..22, 0..40)) {
        let pieces = [
            "<link name=\"a\">", "<link name=\"b\"/>", "</link>", "<inertial>", "</inertial>",
            "<mass value=\"1\"/>", "<inertia ixx=\"1\"/>", "<joint name=\"j\" type=\"fixed\">",
            "<joint name=\"k\" type=\"revolute\">", "</joint>", "<parent link=\"a\"/>",
            "<child link=\"b\"/>", "<axis xyz=\"0 0 1\"/>", "<limit/>", "<![CDATA[x]]>", "text",
            "<!-- c -->", "<?pi?>", "&amp;", "&bogus;", "<mimic joint=\"j\"/>", "<a:b/>",
        ];
        let inside: String = picks.iter().map(|&i| pieces[i]).collect();
        let _ = Robot::from_urdf(&format!("<robot name=\"r\">{inside}</robot>"));
    }
}
