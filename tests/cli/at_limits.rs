//! The limits of SECURITY.md on robots: what is at one is read, what is just beyond it is refused.

use std::fs::File;
use std::io::Write as _;
use std::path::Path;

use crate::arm::{self, URDF};
use crate::program::{Answer, run};

/// Largest URDF and largest mesh (bytes).
const LARGEST: u64 = 64 << 20;

fn check(folder: &Path, file: &str, text: &str) -> Answer {
    arm::write(folder, file, text);
    run(folder, &["robot", "check", file])
}

/// The arm with one text in place of another.
fn with(old: &str, new: &str) -> String {
    assert!(URDF.contains(old));
    URDF.replace(old, new)
}

#[test]
fn masses_and_lengths_up_to_their_limits_are_read() {
    let folder = tempfile::tempdir().unwrap();
    let mass = |value: &str| with("<mass value=\"2\"/>", &format!("<mass value=\"{value}\"/>"));
    let length =
        |value: &str| with("<origin xyz=\"0.4 0 0\"/>", &format!("<origin xyz=\"{value} 0 0\"/>"));
    for text in [mass("1e6"), length("10000"), length("-1e4")] {
        let answer = check(folder.path(), "arm.urdf", &text);
        assert_eq!(answer.code, 0, "{answer:?}");
    }
    for (text, told) in [
        (mass("1000001"), "link fore: mass is 1000001, a mass of up to 1e6 kg was expected"),
        (length("10001"), "joint elbow: origin is 10001, a length of up to 1e4 m was expected"),
        (length("-10001"), "a length of up to 1e4 m was expected"),
    ] {
        let answer = check(folder.path(), "arm.urdf", &text);
        assert_eq!(answer.code, 3, "{answer:?}");
        assert!(answer.err.contains(told), "{answer:?}");
    }
}

#[test]
fn a_urdf_of_64_mib_is_read_and_one_of_a_byte_more_is_not() {
    let folder = tempfile::tempdir().unwrap();
    let of = |bytes: u64| {
        let comment = " ".repeat(bytes as usize - URDF.len() - "<!---->".len());
        check(folder.path(), "arm.urdf", &format!("{URDF}<!--{comment}-->"))
    };
    assert_eq!(of(LARGEST).code, 0);
    let answer = of(LARGEST + 1);
    assert_eq!(answer.code, 3, "{answer:?}");
    assert!(answer.err.contains("the file has more than 67108864 bytes"), "{answer:?}");
}

#[test]
fn a_mesh_of_64_mib_is_taken_and_one_of_a_byte_more_is_left_out() {
    let folder = tempfile::tempdir().unwrap();
    let visual = "<visual><geometry><mesh filename=\"a.glb\"/></geometry></visual>";
    let urdf = with("<link name=\"base\"/>", &format!("<link name=\"base\">{visual}</link>"));
    for (bytes, is_left_out) in [(LARGEST, false), (LARGEST + 1, true)] {
        // Its own length stands behind the version; the rest takes no room on the disk.
        let mut file = File::create(folder.path().join("a.glb")).unwrap();
        file.write_all(b"glTF\x02\0\0\0").unwrap();
        file.write_all(&u32::try_from(bytes).unwrap().to_le_bytes()).unwrap();
        file.set_len(bytes).unwrap();
        let answer = check(folder.path(), "arm.urdf", &urdf);
        assert_eq!(answer.code, 0, "{answer:?}");
        assert_eq!(answer.out.contains("mesh files are not there or too large"), is_left_out);
    }
}

#[test]
fn what_an_mjcf_includes_lies_below_its_folder_unless_that_is_allowed() {
    let folder = tempfile::tempdir().unwrap();
    std::fs::create_dir(folder.path().join("inside")).unwrap();
    let body = "<mujoco><worldbody><body name=\"b\"><joint name=\"j\" type=\"hinge\"/>\
                <inertial pos=\"0 0 .1\" mass=\"1\" diaginertia=\"1 1 1\"/></body></worldbody></mujoco>";
    arm::write(folder.path(), "outside.xml", body);
    let including = "<mujoco model=\"a\"><include file=\"../outside.xml\"/></mujoco>";
    let refused = check(folder.path(), "inside/arm.xml", including);
    assert_eq!(refused.code, 3, "{refused:?}");
    assert!(refused.err.contains("it lies outside of inside"), "{refused:?}");
    let read = run(folder.path(), &["robot", "check", "inside/arm.xml", "--allow-outside"]);
    assert_eq!(read.code, 0, "{read:?}");
}
