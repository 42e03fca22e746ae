//! Names that mean something to a format, in every file that is written, and read back by another parser.

use checks::hostile_names::{HOSTILE_NAMES, held_by_xml};
use exchange::{Format, export};
use proptest::prelude::*;
use quick_xml::Reader;
use quick_xml::events::Event;
use robot::{Loaded, Robot};

use crate::rich::{DRIVES, wam_with};

/// The formats that are XML.
const XML: [Format; 3] = [Format::Urdf, Format::Mjcf, Format::Sdf];
/// Anything of which a name may be made.
const ANY: &str = "[\u{0}-\u{ff}\u{2028}\u{202e}\u{feff}\u{ffff}<>&\"'/\\\\\\]a-c-]{1,20}";

/// The arm with this name for its first joint and its link.
fn named(name: &str) -> Loaded {
    let folder = tempfile::tempdir().unwrap();
    let mut loaded = wam_with(folder.path(), DRIVES);
    let link = loaded.robot.link_mut(0).unwrap();
    (link.name, link.joint.name) = (name.to_owned(), name.to_owned());
    loaded
}

fn written(loaded: &Loaded, format: Format) -> String {
    export(loaded, "", format).unwrap().text
}

/// The elements of a document, and the names that they have.
fn elements(text: &str) -> (usize, Vec<String>) {
    let (mut reader, mut count, mut names) = (Reader::from_str(text), 0, Vec::new());
    loop {
        match reader.read_event().unwrap() {
            Event::Start(tag) | Event::Empty(tag) => {
                count += 1;
                let name = tag.try_get_attribute("name").unwrap();
                names.extend(name.map(|name| name.unescape_value().unwrap().into_owned()));
            }
            Event::Eof => return (count, names),
            _ => {}
        }
    }
}

/// A string of a USD layer in double quotes: its bytes.
fn usd_string(quoted: &str) -> Vec<u8> {
    let mut rest = quoted.strip_prefix('"').unwrap().strip_suffix('"').unwrap().bytes();
    let mut bytes = Vec::new();
    while let Some(byte) = rest.next() {
        assert!(byte != b'"' && !byte.is_ascii_control(), "{quoted}");
        bytes.push(match byte {
            b'\\' => match rest.next().unwrap() {
                b'x' => {
                    let digits = [rest.next().unwrap(), rest.next().unwrap()];
                    u8::from_str_radix(std::str::from_utf8(&digits).unwrap(), 16).unwrap()
                }
                c => c,
            },
            c => c,
        });
    }
    bytes
}

fn assert_held(name: &str) {
    let (plain, hostile) = (named("plain"), named(name));
    for format in XML {
        let text = written(&hostile, format);
        let (count, names) = elements(&text);
        assert_eq!(count, elements(&written(&plain, format)).0, "{name:?}\n{text}");
        assert!(names.contains(&held_by_xml(name)), "{name:?}\n{text}");
        assert!(!text.contains(|c: char| c < ' ' && c != '\n'), "{name:?}");
    }
    let text = written(&hostile, Format::Isaac);
    assert_eq!(text.lines().count(), written(&plain, Format::Isaac).lines().count(), "{text}");
    let original =
        |line: &str| line.trim().strip_prefix("custom string plumbline:name = ").map(usd_string);
    assert!(text.lines().filter_map(original).any(|held| held == name.as_bytes()), "{text}");
}

#[test]
fn every_format_holds_every_name_in_its_place() {
    HOSTILE_NAMES.iter().for_each(|name| assert_held(name));
}

#[test]
fn a_robot_in_a_file_has_the_names_again() {
    let folder = tempfile::tempdir().unwrap();
    for (name, format) in HOSTILE_NAMES.iter().flat_map(|name| [(name, XML[0]), (name, XML[1])]) {
        let path = folder.path().join("robot.xml");
        std::fs::write(&path, written(&named(name), format)).unwrap();
        let read = Robot::load(&path).unwrap().robot;
        assert_eq!(read.joint_names().next(), Some(held_by_xml(name).as_str()), "{format:?}");
    }
}

/// MuJoCo takes an empty name as no name, and an actuator cannot refer to such a joint.
#[test]
fn a_joint_without_a_name_has_one_in_an_mjcf() {
    let (_, names) = elements(&written(&named(""), Format::Mjcf));
    assert!(names.iter().filter(|name| *name == "joint").count() == 2, "{names:?}");
    let text = written(&named(""), Format::Mjcf);
    assert!(text.contains("joint=\"joint\"") && !text.contains("joint=\"\""), "{text}");
}

proptest! {
    #![proptest_config(ProptestConfig::with_cases(48))]
    #[test]
    fn every_format_holds_any_name(name in ANY) {
        assert_held(&name);
    }
}
