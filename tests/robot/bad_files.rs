use super::{arm_with, load, load_in, refused};

#[test]
fn a_missing_file_is_named() {
    let folder = tempfile::tempdir().unwrap();
    assert_eq!(
        load_in(folder.path(), "none.urdf").unwrap_err(),
        "none.urdf: there is no such file, a URDF or a robot.toml was expected"
    );
}

#[test]
fn a_directory_is_refused() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("robot.urdf")).unwrap();
    assert_eq!(
        load_in(folder.path(), "robot.urdf").unwrap_err(),
        "robot.urdf: it is a directory, a URDF or a robot.toml was expected"
    );
}

#[test]
fn a_directory_with_a_robot_in_it_names_its_file() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("wam")).unwrap();
    std::fs::write(folder.path().join("wam/robot.toml"), "").unwrap();
    assert_eq!(
        load_in(folder.path(), "wam").unwrap_err(),
        "wam: it is a directory, give wam/robot.toml"
    );
}

#[test]
fn an_empty_file_is_refused() {
    for name in ["robot.urdf", "robot.toml", "robot"] {
        assert_eq!(
            load(&[(name, " \n")]).unwrap_err(),
            format!("{name}: the file is empty, a URDF or a robot.toml was expected")
        );
    }
}

#[test]
fn bytes_that_are_not_text_are_refused() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::write(folder.path().join("robot.urdf"), b"<robot name=\"\xff\"/>").unwrap();
    assert_eq!(
        load_in(folder.path(), "robot.urdf").unwrap_err(),
        "robot.urdf: byte 13 is not UTF-8, a text file was expected"
    );
}

#[test]
fn a_huge_file_is_refused_before_it_is_parsed() {
    let folder = tempfile::tempdir().unwrap();
    let file = std::fs::File::create(folder.path().join("robot.urdf")).unwrap();
    file.set_len((64 << 20) + 1).unwrap();
    assert_eq!(
        load_in(folder.path(), "robot.urdf").unwrap_err(),
        "robot.urdf: the file has more than 67108864 bytes, a URDF or a robot.toml was expected"
    );
}

#[test]
fn malformed_xml_is_refused_with_its_line() {
    assert_eq!(
        refused("<robot name=\"a\">\n<link name=\"b\">\n</joint>\n</robot>"),
        "robot.urdf: line 3: ill-formed document: expected `</link>`, but `</joint>` was found"
    );
    assert_eq!(
        refused("<robot name=\"a\">\n  <link name=\"b\">\n"),
        "robot.urdf: line 3: the file ends inside <link>"
    );
    assert_eq!(
        refused("time,j1.position\n0,1\n"),
        "robot.urdf: line 3: no element was found, <robot> was expected"
    );
    assert_eq!(refused("<sdf/>"), "robot.urdf: line 1: the root is <sdf>, <robot> was expected");
    assert_eq!(
        refused("<robot name=\"a\"/><robot name=\"b\"/>"),
        "robot.urdf: line 1: a second root <robot>, one was expected"
    );
}

#[test]
fn a_xacro_file_is_sent_to_xacro() {
    assert_eq!(
        refused(&arm_with("<xacro:tool/>")),
        "robot.urdf: line 7: <xacro:tool> was found, expand the file with xacro first: \
         xacro FILE > robot.urdf"
    );
}

#[test]
fn deep_nesting_is_refused() {
    let deep = format!("<robot name=\"a\">{}", "<a>".repeat(1_000_000));
    assert_eq!(refused(&deep), "robot.urdf: line 1: elements are nested more than 64 deep");
}

#[test]
fn an_endless_tag_is_refused() {
    let urdf = format!("<robot name=\"a\" {}/>", "b=\"1\" ".repeat(10_000));
    assert_eq!(refused(&urdf), "robot.urdf: line 1: a tag has more than 16384 bytes");
}

#[test]
fn the_content_decides_when_the_extension_says_nothing() {
    let urdf = arm_with("");
    assert_eq!(load(&[("robot.txt", &urdf)]).unwrap().robot.joint_count(), 2);
    let toml = "urdf = \"arm.urdf\"";
    let loaded = load(&[("robot.txt", toml), ("arm.urdf", &urdf)]).unwrap();
    assert_eq!(loaded.robot.joint_count(), 2);
    assert_eq!(
        load(&[("robot.csv", "time,q\n0,1\n")]).unwrap_err(),
        "robot.csv: it is neither XML nor TOML, a URDF or a robot.toml was expected"
    );
}

#[test]
fn a_robot_toml_beside_the_urdf_is_not_read_silently() {
    let files = [("robot.urdf", arm_with("")), ("robot.toml", "not even toml".to_owned())];
    let files = files.each_ref().map(|(name, text)| (*name, text.as_str()));
    assert!(load(&files).is_ok());
}
