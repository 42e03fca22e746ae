use crate::arm::{self, Gap};
use crate::program::run;

#[test]
fn a_robot_is_written_in_every_format_with_what_each_leaves_out() {
    let folder = arm::folder(Gap::None);
    let toml = "urdf = \"arm.urdf\"\n[joint.elbow]\ncoulomb_nm = 0.8\nrotor_inertia_kg_m2 = 0.01\n";
    std::fs::create_dir(folder.path().join("out")).unwrap();
    std::fs::copy(folder.path().join("arm.urdf"), folder.path().join("out/arm.urdf")).unwrap();
    std::fs::write(folder.path().join("out/extended.toml"), toml).unwrap();
    let answer = run(folder.path(), &["export", "out"]);
    assert_eq!((answer.code, answer.err.as_str()), (0, ""), "{answer:?}");
    for expected in [
        "extended.urdf: 1 exact, 0 approximated, 1 dropped",
        "extended.xml: 2 exact",
        "extended.sdf: ",
        "extended.usda: 2 exact, 0 approximated, 0 dropped",
    ] {
        assert!(answer.out.contains(expected), "{expected} is missing in\n{}", answer.out);
    }
    let check = run(folder.path(), &["robot", "check", "out/extended.urdf", "--json"]);
    assert!(check.out.contains("\"coulomb_forward\": 0.8"), "{}", check.out);
    let json = run(folder.path(), &["export", "out", "--to", "mjcf", "--out", "models", "--json"]);
    assert!(json.out.contains("\"schema\": \"plumbline.export/1\""), "{}", json.out);
    assert!(json.out.contains("\"fate\": \"exact\""), "{}", json.out);
    assert!(folder.path().join("models/extended.xml").exists());
    assert!(!folder.path().join("models/extended.urdf").exists());
}

#[test]
fn what_cannot_be_exported_is_told() {
    let folder = arm::folder(Gap::None);
    std::fs::create_dir(folder.path().join("empty")).unwrap();
    let answer = run(folder.path(), &["export", "empty"]);
    assert_eq!(answer.code, 3);
    assert!(answer.err.contains("empty: an extended.toml was expected"), "{}", answer.err);
    std::fs::rename(folder.path().join("arm.urdf"), folder.path().join("extended.urdf")).unwrap();
    let answer = run(folder.path(), &["export", "extended.urdf", "--to", "urdf"]);
    assert_eq!(answer.code, 2);
    assert!(answer.err.contains("extended.urdf: it is read and would be"), "{}", answer.err);
}
