//! Schemas: what is shipped, what is read and what is written follows the schema of its kind, and a wrong key does not.

use std::fs;
use std::path::Path;

use jsonschema::Validator;
use serde_json::{Value, json};

use crate::arm::{self, Gap};
use crate::files::workspace;
use crate::program::run;

/// A map with every form of an entry.
const MAP: &str = r#"
time = { column = "t_ns", unit = "ns" }
joints = ["shoulder", "elbow"]
position = "q_{i}"
velocity = ["dq_a", "dq_b"]
effort = { column = "i[0:2]", unit = "raw", scale = [0.12, 0.08], offset = 0 }
link_position = { column = ["a", "b"], scale = -1 }

[joint.shoulder]
position = { column = "q0", unit = "deg", offset = 0.5 }
effort = "tau"
"#;

/// Two logs against one of more friction.
const COMPARE: [&str; 10] = [
    "compare",
    "--robot",
    "arm.urdf",
    "--before",
    "run_0.csv",
    "run_1.csv",
    "--after",
    "more.csv",
    "--json",
    "--quiet",
];

/// A motion for a pair of causes that it tells apart, and for one that no motion does.
const DESIGN: [&str; 6] = ["design", "--robot", "arm.urdf", "--duration-s", "10", "--json"];
const TOLD_APART: [&str; 4] = ["--separate", "FR01@elbow", "--from", "FR02@elbow"];
const ALIKE: [&str; 4] = ["--separate", "payload@fore", "--from", "IN02@fore"];

fn schema(name: &str) -> Value {
    let answer = run(&workspace(), &["schema", name]);
    assert_eq!((answer.code, answer.err.as_str()), (0, ""), "{name}");
    serde_json::from_str(&answer.out).unwrap()
}

fn validator(schema: &Value) -> Validator {
    jsonschema::validator_for(schema).unwrap()
}

/// A schema that holds what is written to its keys as well, which for others are open to keys of later versions.
fn closed(mut schema: Value) -> Value {
    let close = |object: &mut Value| {
        if object.get("properties").is_some() && object.get("additionalProperties").is_none() {
            object["unevaluatedProperties"] = json!(false);
        }
    };
    close(&mut schema);
    if let Some(all) = schema.get_mut("$defs").and_then(Value::as_object_mut) {
        all.values_mut().for_each(close);
    }
    schema
}

/// What is wrong with a value, each with its place.
fn wrong(validator: &Validator, value: &Value) -> Vec<String> {
    validator.iter_errors(value).map(|e| format!("{}: {e}", e.instance_path())).collect()
}

/// A value under another name, without keys, and with a key more: its own, or of an object in it or in a list of it.
fn with_wrong_keys(good: &Value) -> Vec<Value> {
    let mut other = good.clone();
    other["schema"] = json!("plumbline.other/1");
    let mut bad = vec![json!({}), other];
    let inside = good.as_object().unwrap().keys();
    let inside = inside.flat_map(|key| [format!("/{key}"), format!("/{key}/0")]);
    for place in inside.chain([String::new()]) {
        let mut more = good.clone();
        if let Some(object) = more.pointer_mut(&place).and_then(Value::as_object_mut) {
            object.insert("mistyped".to_owned(), json!(1));
            bad.push(more);
        }
    }
    bad
}

fn toml(text: &str) -> Value {
    toml::from_str(text).unwrap()
}

fn read_toml(path: &Path) -> Value {
    toml(&fs::read_to_string(path).unwrap())
}

#[test]
fn the_list_names_every_schema_and_each_is_one() {
    let list = run(&workspace(), &["schema"]).out;
    let names: Vec<&str> =
        list.lines().skip(1).map_while(|line| line.split_whitespace().next()).collect();
    assert_eq!(names.len(), 20, "{list}");
    let told = run(&workspace(), &["schema", "--json"]).out;
    let told: Value = serde_json::from_str(&told).unwrap();
    let entries = told["schemas"].as_array().unwrap().iter();
    assert!(
        entries.map(|entry| entry["name"].as_str().unwrap()).eq(names.iter().copied()),
        "{told}"
    );
    for name in names {
        let schema = schema(name);
        assert!(jsonschema::meta::is_valid(&schema), "{name}");
        assert!(schema["title"].as_str().unwrap().starts_with("Plumbline"), "{name}");
    }
}

#[test]
fn robots_follow_their_schema_and_a_wrong_key_does_not() {
    let of_robot = validator(&schema("robot"));
    for robot in ["panda", "so101", "ur5e", "wam7"] {
        let good = read_toml(&workspace().join("robots").join(robot).join("robot.toml"));
        assert_eq!(wrong(&of_robot, &good), [""; 0], "{robot}");
        for (key, value) in
            [("grav_m_per_s2", json!([0, 0, 1])), ("gravity_m_per_s2", json!("down"))]
        {
            let mut bad = good.clone();
            bad[key] = value;
            assert_ne!(wrong(&of_robot, &bad), [""; 0], "{robot} with {key}");
        }
    }
    for bad in [
        "urdf = \"a\"\n[joint.elbow]\nviscous = 1",
        "urdf = \"a\"\nsensing = \"both\"",
        "urdf = \"a\"\n[joint.elbow.torque_ripple]\namplitude_nm = 1",
        "control_rate_hz = 1",
    ] {
        assert_ne!(wrong(&of_robot, &toml(bad)), [""; 0], "{bad}");
    }
}

#[test]
fn maps_follow_their_schema_and_a_wrong_key_does_not() {
    let of_map = validator(&schema("map"));
    assert_eq!(wrong(&of_map, &toml(MAP)), [""; 0]);
    let folder = tempfile::tempdir().unwrap();
    arm::write(folder.path(), "map.toml", MAP);
    assert!(logs::ColumnMap::load(&folder.path().join("map.toml")).is_ok());
    for (old, new) in
        [("\"ns\"", "\"min\""), ("offset", "ofset"), ("effort =", "torque ="), ("\"tau\"", "1")]
    {
        let bad = MAP.replace(old, new);
        assert_ne!(wrong(&of_map, &toml(&bad)), [""; 0], "{new}");
        arm::write(folder.path(), "map.toml", &bad);
        assert!(logs::ColumnMap::load(&folder.path().join("map.toml")).is_err(), "{new}");
    }
}

#[test]
fn described_robots_name_the_schemas_beside_them() {
    let folder = arm::folder(Gap::None);
    let answer = run(folder.path(), &["robot", "init", "arm.urdf", "--out", "mine"]);
    assert_eq!(answer.code, 0, "{answer:?}");
    for name in ["robot", "scenario"] {
        let text = fs::read_to_string(folder.path().join(format!("mine/{name}.toml"))).unwrap();
        let file = text.lines().next().unwrap().strip_prefix("#:schema ./").unwrap();
        let beside = fs::read_to_string(folder.path().join("mine").join(file)).unwrap();
        let beside: Value = serde_json::from_str(&beside).unwrap();
        assert_eq!(beside, schema(name));
        assert_eq!(wrong(&validator(&beside), &toml(&text)), [""; 0], "{text}");
    }
}

#[test]
fn what_is_written_follows_its_schema() {
    let folder = arm::folder(Gap::Friction(1.0));
    arm::write(folder.path(), "more.csv", &arm::log(3, Gap::Friction(2.0)));
    let diagnose =
        ["diagnose", "--robot", "arm.urdf", "--log", "run_0.csv", "run_1.csv", "--out", "out"];
    assert!(run(folder.path(), &diagnose).code < 2);
    let extended = read_toml(&folder.path().join("out/extended.toml"));
    assert_eq!(wrong(&validator(&schema("robot")), &extended), [""; 0]);
    let of_diagnosis = validator(&closed(schema("diagnosis")));
    let text = fs::read_to_string(folder.path().join("out/diagnosis.json")).unwrap();
    let diagnosis: Value = serde_json::from_str(&text).unwrap();
    assert_ne!(diagnosis["findings"], json!([]), "a diagnosis with nothing shows little");
    assert_eq!(wrong(&of_diagnosis, &diagnosis), [""; 0]);
    let mut bad = diagnosis.clone();
    bad["verdict"] = json!("fine");
    assert_ne!(wrong(&of_diagnosis, &bad), [""; 0]);
    let mut bad = diagnosis;
    bad.as_object_mut().unwrap().remove("findings");
    assert_ne!(wrong(&of_diagnosis, &bad), [""; 0]);
    for (name, arguments) in [
        ("robot-check", &["robot", "check", "arm.urdf", "--json"][..]),
        ("log-info", &["log", "info", "run_0.csv", "--robot", "arm.urdf", "--json"]),
        ("effects", &["effects", "--json"]),
        ("effect", &["explain", "FR02", "--json"]),
        ("schemas", &["schema", "--json"]),
        ("export", &["export", "out", "--to", "mjcf,urdf", "--log", "run_1.csv", "--json"]),
        ("robot-init", &["robot", "init", "arm.urdf", "--out", "mine", "--json"]),
        ("simulation", &["simulate", "mine/scenario.toml", "--json"]),
        ("comparison", &COMPARE),
        ("design", &[&DESIGN[..], &TOLD_APART].concat()),
        ("design", &[&DESIGN[..], &ALIKE].concat()),
    ] {
        let answer = run(folder.path(), arguments);
        let printed: Value = serde_json::from_str(&answer.out).unwrap();
        let of_printed = validator(&closed(schema(name)));
        assert_eq!(wrong(&of_printed, &printed), [""; 0], "{name}");
        for bad in with_wrong_keys(&printed) {
            assert_ne!(wrong(&of_printed, &bad), [""; 0], "{name}: {bad}");
        }
    }
}

#[test]
fn the_pages_of_keys_and_commands_are_those_of_the_program() {
    for (page, arguments) in [
        ("robot-toml.md", &["schema", "robot", "--markdown"][..]),
        ("column-maps.md", &["schema", "map", "--markdown"]),
        ("command-line.md", &["man", "--markdown"]),
    ] {
        let made = run(&workspace(), arguments).out;
        let kept = fs::read_to_string(checks::book::folder().join(page)).unwrap_or_default();
        assert!(made.lines().count() > 30, "{made}");
        assert!(made == kept, "plumbline {} > docs/src/{page} makes it anew", arguments.join(" "));
    }
}

/// The robots that come with the program are checked by editors against the schema beside them.
#[test]
fn the_robots_name_the_schema_that_they_are_checked_with() {
    let robots = workspace().join("robots");
    let kept = fs::read_to_string(robots.join("robot.schema.json")).unwrap();
    let made = run(&workspace(), &["schema", "robot"]).out;
    assert!(made == kept, "plumbline schema robot > robots/robot.schema.json makes it anew");
    let mut named = 0;
    for folder in fs::read_dir(&robots).unwrap().map(|entry| entry.unwrap().path()) {
        let Ok(text) = fs::read_to_string(folder.join("robot.toml")) else { continue };
        assert_eq!(text.lines().next(), Some("#:schema ../robot.schema.json"), "{folder:?}");
        named += 1;
    }
    assert_eq!(named, 4);
}
