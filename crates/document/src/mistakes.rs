//! The mistakes of a typical file as a user sees them, and that each has its exact place.

use std::collections::BTreeMap;

use serde::Deserialize;

use crate::document::Document;
use crate::error::{Coloring, DocumentError};
use crate::key_path::KeyPath;

#[derive(Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
struct Scenario {
    duration_s: f64,
    #[serde(default)]
    seed: u32,
    #[serde(default)]
    effect: Vec<Effect>,
    #[serde(default)]
    start_rad: BTreeMap<String, [f64; 2]>,
    clock: Option<Clock>,
}

#[derive(Debug, Deserialize, PartialEq)]
#[serde(rename_all = "snake_case", deny_unknown_fields)]
enum Effect {
    CoulombFriction(CoulombFriction),
    Payload { mass_kg: f64 },
}

#[derive(Debug, Deserialize, PartialEq)]
#[serde(deny_unknown_fields)]
struct CoulombFriction {
    joint: String,
    level_nm: f64,
}

#[derive(Debug, Deserialize, PartialEq)]
#[serde(rename_all = "snake_case")]
enum Clock {
    Steady,
    Jittered { sd_s: f64 },
    Range(f64, f64),
}

/// The mistake in `text` below two lines that are right.
fn mistake(text: &str) -> DocumentError {
    let text = format!("# A scenario.\nduration_s = 5.0\n{text}\n");
    let document = Document::from_text("friction.toml", &text);
    document.and_then(|document| document.parse::<Scenario>()).unwrap_err()
}

fn render_mistake(text: &str) -> String {
    mistake(text).render(Coloring::Plain)
}

#[test]
fn a_value_of_the_wrong_type_is_underlined_in_an_enumeration_in_an_array() {
    let text = "[[effect]]\npayload = { mass_kg = 1 }\n\n[[effect]]\n\
                coulomb_friction = { joint = \"elbow\", level_nm = \"0.6\" }";
    insta::assert_snapshot!(render_mistake(text), @r#"
    error: expected a number, found the string "0.6"
     --> friction.toml:7:50
      |
    7 | coulomb_friction = { joint = "elbow", level_nm = "0.6" }
      |                                                  ^^^^^ effect.1.coulomb_friction.level_nm
    "#);
}

#[test]
fn an_unknown_key_is_underlined_and_the_known_ones_are_told() {
    let text = "[[effect]]\ncoulomb_friction = { joint = \"elbow\", level = 0.6 }";
    insta::assert_snapshot!(render_mistake(text), @r#"
    error: unknown key `level`, did you mean `level_nm`?
     --> friction.toml:4:39
      |
    4 | coulomb_friction = { joint = "elbow", level = 0.6 }
      |                                       ^^^^^ effect.0.coulomb_friction.level
      |
      = help: expected `joint` or `level_nm`
    "#);
}

#[test]
fn an_unknown_variant_is_underlined_and_the_known_ones_are_told() {
    let text = "[[effect]]\ncolumb_friction = { joint = \"elbow\", level_nm = 0.6 }";
    insta::assert_snapshot!(render_mistake(text), @r#"
    error: unknown name `columb_friction`, did you mean `coulomb_friction`?
     --> friction.toml:4:1
      |
    4 | columb_friction = { joint = "elbow", level_nm = 0.6 }
      | ^^^^^^^^^^^^^^^ effect.0.columb_friction
      |
      = help: expected `coulomb_friction` or `payload`
    "#);
}

#[test]
fn a_missing_key_is_told_at_the_header_of_its_table() {
    let text = "[[effect]]\n[effect.coulomb_friction]\nlevel_nm = 0.6";
    insta::assert_snapshot!(render_mistake(text), @r"
    error: `joint` is missing
     --> friction.toml:4:1
      |
    4 | [effect.coulomb_friction]
      | ^^^^^^^^^^^^^^^^^^^^^^^^^ effect.0.coulomb_friction
    ");
}

#[test]
fn a_key_given_twice_is_underlined() {
    insta::assert_snapshot!(render_mistake("seed = 1\nseed = 2"), @r"
    error: duplicate key
     --> friction.toml:4:1
      |
    4 | seed = 2
      | ^^^^
    ");
}

#[test]
fn two_effects_in_one_table_are_told_with_their_places() {
    let text = "[[effect]]\npayload = { mass_kg = 1 }\n\
                coulomb_friction = { joint = \"elbow\", level_nm = 0.6 }";
    insta::assert_snapshot!(render_mistake(text), @r"
    error: expected a single key, found 2
     --> friction.toml:3:1
      |
    3 | [[effect]]
      | ^^^^^^^^^^ effect.0
      |
      = help: found `coulomb_friction` at friction.toml:5:1, `payload` at friction.toml:4:1
    ");
}

#[test]
fn a_mistake_on_the_command_line_is_underlined_there() {
    let mut document = Document::from_text("friction.toml", "duration_s = 5.0").unwrap();
    document.set("seed = many").unwrap();
    let error = document.parse::<Scenario>().unwrap_err();
    assert_eq!(error.to_string().split(": ").next(), Some("--set seed = many"));
    insta::assert_snapshot!(error.render(Coloring::Plain), @r#"
    error: expected a whole number from 0 to 4294967295, found the string "many"
      |
    1 | --set seed = many
      |              ^^^^ seed
    "#);
}

#[test]
fn a_mistake_within_a_value_of_the_command_line_has_its_exact_place() {
    let mut document = Document::from_text("friction.toml", "duration_s = 5.0").unwrap();
    for (text, underlined) in [("mas_kg = 1", "mas_kg"), ("mass_kg = true", "true")] {
        document.set(&format!("effect=[{{ payload = {{ {text} }} }}]")).unwrap();
        let error = document.parse::<Scenario>().unwrap_err();
        assert_eq!(error.place().unwrap().text(), underlined, "{error}");
    }
}

#[test]
fn a_mistake_of_meaning_is_rendered_like_one_of_type() {
    let text = "[[effect]]\ncoulomb_friction = { joint = \"elbwo\", level_nm = -1 }";
    let document = Document::from_text("friction.toml", text).unwrap();
    let friction = KeyPath::root().key("effect").index(0).key("coulomb_friction");
    let joint =
        document.unknown_name(&friction.key("joint"), "joint", "elbwo", &["shoulder", "elbow"]);
    insta::assert_snapshot!(joint.render(Coloring::Plain), @r#"
    error: unknown joint `elbwo`, did you mean `elbow`?
     --> friction.toml:2:30
      |
    2 | coulomb_friction = { joint = "elbwo", level_nm = -1 }
      |                              ^^^^^^^ effect.0.coulomb_friction.joint
      |
      = help: expected `shoulder` or `elbow`
    "#);
    let level = document.mistake(&friction.key("level_nm"), "a positive level was expected", None);
    assert_eq!(level.place().unwrap().text(), "-1");
    assert!(level.to_string().ends_with("level_nm: a positive level was expected"), "{level}");
    let absent = document.mistake(&friction.key("speed").key("low"), "none", None);
    assert!(absent.place().unwrap().text().starts_with("{ joint"), "{absent}");
}

#[test]
fn a_name_that_is_a_key_is_underlined_as_the_key() {
    let text = "[start_rad]\n\"arm.elbwo\" = [0, 1]\nelbow = \"elbow\"";
    let document = Document::from_text("friction.toml", text).unwrap();
    let start = KeyPath::root().key("start_rad");
    let shown = |key: &str| {
        let error = document.unknown_name(&start.key(key), "joint", key, &[]);
        error.place().unwrap().text().to_owned()
    };
    assert_eq!(shown("arm.elbwo"), "\"arm.elbwo\"");
    assert_eq!(shown("elbow"), "\"elbow\"");
}

#[test]
fn every_mistake_has_its_exact_place() {
    // What is underlined, and the sentence.
    let expected = [
        ("seed = -1", "-1", "expected a whole number from 0 to 4294967295, found -1"),
        ("seed = 1.0", "1.0", "expected a whole number from 0 to 4294967295, found 1.0"),
        ("seed = 0xFFFFFFFFFF", "0xFFFFFFFFFF", "4294967295, found 1099511627775"),
        ("seed = 9223372036854775808", "9223372036854775808", "expected a whole number of 64 bits"),
        ("seed = 1e400", "1e400", "expected a number below 1.8e308, found 1e400"),
        ("seed = 2020-01-01", "2020-01-01", "found the date 2020-01-01"),
        ("seed = tru", "tru", "invalid boolean"),
        ("sed = 1", "sed", "unknown key `sed`, did you mean `seed`?"),
        ("duration_s.x = 1", "duration_s", "cannot extend value of type float"),
        ("start_rad = [1]", "[1]", "expected a table, found an array"),
        ("start_rad.elbow = [1, 2, 3]", "[1, 2, 3]", "an array of 2, found an array of 3"),
        ("[start_rad]\nelbow = [1]", "[1]", "expected an array of 2, found an array of 1"),
        ("start_rad = { elbow = [1, true] }", "true", "expected a number, found true"),
        ("effect = \"payload\"", "\"payload\"", "expected an array, found the string \"payload\""),
        ("effect = [\"payload\"]", "\"payload\"", "expected `payload = ...`"),
        ("effect = [\n 7,\n]", "7", "expected `coulomb_friction` or `payload`, found 7"),
        ("[[effect]]", "[[effect]]", "found an empty table"),
        ("[[effect]]\npayload = 3", "3", "expected a table, found 3"),
        ("[[effect]]\npayload.mass = 3", "mass", "unknown key `mass`, did you mean `mass_kg`?"),
        ("clock = \"fast\"", "\"fast\"", "unknown name `fast`"),
        ("clock = { steady = 1 }", "1", "expected \"steady\", found 1"),
        ("clock.range = [1]", "[1]", "expected an array of 2, found an array of 1"),
        ("clock.jittered = {}", "{}", "`sd_s` is missing"),
    ];
    for (text, underlined, message) in expected {
        let error = mistake(text);
        assert_eq!(error.place().unwrap().text(), underlined, "{error}");
        assert!(error.to_string().contains(message), "{error}");
    }
}

#[test]
fn what_is_right_is_read() {
    let text = "duration_s = 5\nclock = \"steady\"\nstart_rad.\"a.b\" = [0, 1.5]\n\
                [[effect]]\npayload.mass_kg = 2\n[[effect]]\n[effect.coulomb_friction]\n\
                joint = \"elbow\"\nlevel_nm = 0.6\n";
    let scenario: Scenario = Document::from_text("a", text).unwrap().parse().unwrap();
    let friction = CoulombFriction { joint: "elbow".to_owned(), level_nm: 0.6 };
    let expected = Scenario {
        duration_s: 5.0,
        seed: 0,
        effect: vec![Effect::Payload { mass_kg: 2.0 }, Effect::CoulombFriction(friction)],
        start_rad: BTreeMap::from([("a.b".to_owned(), [0.0, 1.5])]),
        clock: Some(Clock::Steady),
    };
    assert_eq!(scenario, expected);
    let clock = |text: &str| {
        let document = Document::from_text("a", &format!("duration_s = 5\n{text}")).unwrap();
        document.parse::<Scenario>().unwrap().clock.unwrap()
    };
    assert_eq!(clock("clock.range = [1, 2]"), Clock::Range(1.0, 2.0));
    assert_eq!(clock("clock.jittered.sd_s = 1e-4"), Clock::Jittered { sd_s: 1e-4 });
}

#[test]
fn control_characters_of_a_file_do_not_reach_the_terminal() {
    for text in ["\"\\u001b[31m\" = 1", "seed = \"\\u001b[31m\"", "[[effect]]\n\"\\u001b\" = 1"] {
        let error = mistake(text);
        let shown = error.to_string() + &error.render(Coloring::Plain);
        assert!(!shown.contains('\u{1b}'), "{shown:?}");
        assert!(error.render(Coloring::Ansi).contains('\u{1b}'));
    }
    let mut document = Document::from_text("a", "").unwrap();
    document.set("seed='\u{9b}'").unwrap();
    let escape = "\u{1b}[31m\u{9b}".to_owned();
    let error = document.mistake(&KeyPath::root().key("seed"), &escape, Some(escape.clone()));
    for shown in [error.to_string(), error.render(Coloring::Plain)] {
        assert!(!shown.contains(['\u{1b}', '\u{9b}']), "{shown:?}");
    }
}
