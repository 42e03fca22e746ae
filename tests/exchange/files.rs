//! What the files say, and what is said of them.

use exchange::{Export, Format, export};

use crate::rich::{DRIVES, urdf, wam_with};

fn written(format: Format) -> Export {
    let folder = tempfile::tempdir().unwrap();
    export(&wam_with(folder.path(), DRIVES), &urdf(), format).unwrap()
}

/// The fates of a joint, as `what fate`.
fn fates(format: Format, at: &str) -> Vec<String> {
    let fates = written(format).fates;
    let of = fates.iter().filter(|f| f.at == at);
    of.map(|f| format!("{}: {}", f.what, f.fate.word())).collect()
}

#[test]
fn every_quantity_has_a_fate_in_every_format() {
    let counts = Format::ALL.map(|format| written(format).fates.len());
    assert_eq!(counts, [counts[0]; 4]);
    let elbow = [
        "rotor inertia 0.0346 kg·m²",
        "Coulomb friction 0.7 N·m",
        "difference of its directions, half 0.1 N·m",
        "spring 2 N·m/rad",
    ];
    let expected = |words: [&str; 4]| -> Vec<String> {
        elbow.iter().zip(words).map(|(what, word)| format!("{what}: {word}")).collect()
    };
    let of = |format| fates(format, "j4_elbow_pitch");
    assert_eq!(of(Format::Urdf), expected(["dropped", "exact", "dropped", "dropped"]));
    assert_eq!(of(Format::Mjcf), expected(["exact", "exact", "exact", "exact"]));
    assert_eq!(of(Format::Sdf), expected(["dropped", "exact", "dropped", "exact"]));
    assert_eq!(of(Format::Isaac), expected(["exact", "exact", "dropped", "approximated"]));
}

#[test]
fn the_sdf_holds_bodies_axes_and_friction() {
    let text = written(Format::Sdf).text;
    for expected in [
        "<sdf version=\"1.9\">",
        "<pose rotation_format=\"quat_xyzw\" relative_to=\"forearm\">-0.045 0 0 ",
        "<mass>1.5</mass>",
        "<ixy>0.0001</ixy>",
        "<lower>-2.5</lower>",
        "<effort>50</effort>",
        "<friction>1.75</friction>",
        "<damping>0.7</damping>",
        "<spring_stiffness>2</spring_stiffness>",
        "<parent>world</parent>",
    ] {
        assert!(text.contains(expected), "{expected} is missing in\n{text}");
    }
    assert_eq!(text.matches("<link ").count(), 7, "{text}");
}

/// A name may hold anything.
#[test]
fn names_are_escaped() {
    let name = "a&lt;b &quot;c&quot;";
    let urdf = format!(
        r#"<robot name="{name}"><link name="base"/><link name="{name}"><inertial><mass value="1"/><inertia ixx="1" ixy="0" ixz="0" iyy="1" iyz="0" izz="1"/></inertial></link><joint name="{name}" type="continuous"><parent link="base"/><child link="{name}"/><axis xyz="0 1 0"/></joint></robot>"#
    );
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("arm.urdf"), &urdf).unwrap();
    let loaded = robot::Robot::load(&folder.path().join("arm.urdf")).unwrap();
    for format in [Format::Urdf, Format::Mjcf, Format::Sdf] {
        let text = export(&loaded, &urdf, format).unwrap().text;
        assert!(text.contains("a&lt;b &quot;c&quot;"), "{text}");
        assert!(!text.contains("a<b"), "{text}");
    }
    let text = export(&loaded, &urdf, Format::Isaac).unwrap().text;
    assert!(text.contains(r#"plumbline:name = "a<b \"c\"""#), "{text}");
    assert!(text.contains("def PhysicsRevoluteJoint \"a_b__c__2\""), "{text}");
}

/// Angles are in degrees in USD, and so are speeds of the viscous friction: 1 rad = 57.29578 deg.
#[test]
fn a_usd_layer_has_bodies_and_joints_with_friction_per_degree() {
    let text = written(Format::Isaac).text;
    assert!(text.starts_with("#usda 1.0\n(\n    defaultPrim = "), "{text}");
    let opened = text.matches('{').count();
    assert_eq!(
        (opened, text.matches("def PhysicsRevoluteJoint").count()),
        (text.matches('}').count(), 7)
    );
    assert_eq!(text.matches("\"PhysicsRigidBodyAPI\", \"PhysicsMassAPI\"").count(), 7);
    let number = |key: &str| -> Vec<f64> {
        let lines = text.lines().filter(|line| line.contains(key));
        lines.map(|line| line.rsplit(" = ").next().unwrap().parse().unwrap()).collect()
    };
    let folder = tempfile::tempdir().unwrap();
    let loaded = wam_with(folder.path(), DRIVES);
    for (k, link) in loaded.robot.links().iter().enumerate() {
        let a = &link.actuator;
        let mean = 0.5 * (a.coulomb_forward + a.coulomb_backward);
        assert!((number(":dynamicFrictionEffort")[k] - mean.max(0.0)).abs() < 1e-12);
        assert!((number("newton:friction")[k] - mean.max(0.0)).abs() < 1e-12);
        for armature in ["physxJointAxis:angular:armature", "newton:armature"] {
            assert!((number(armature)[k] - a.rotor_inertia).abs() < 1e-12);
        }
        for key in [":viscousFrictionCoefficient", "newton:damping"] {
            let viscous = number(key)[k] * 57.29577951308232;
            assert!((viscous - a.viscous.max(0.0)).abs() < 1e-12, "{key} {viscous}");
        }
        assert!((number("physics:mass")[k] - link.inertia.mass).abs() < 1e-12);
        let (low, _) = link.joint.limits.position.unwrap();
        let offset = a.encoder_offset;
        assert!((number("physics:lowerLimit")[k] - (low + offset).to_degrees()).abs() < 1e-9);
    }
}
