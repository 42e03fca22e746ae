use crate::arm::{self, Gap};
use crate::program::{Answer, plumbline, run};

#[test]
fn help_names_every_command_and_every_exit_code() {
    let folder = tempfile::tempdir().unwrap();
    let help = run(folder.path(), &["--help"]);
    assert_eq!(help.code, 0);
    for expected in
        ["diagnose", "robot", "log", "explain", "Examples:", "Exit codes:", "  3  unusable data"]
    {
        assert!(help.out.contains(expected), "{expected} is missing in\n{}", help.out);
    }
    let help = run(folder.path(), &["diagnose", "--help"]);
    for expected in [
        "--robot",
        "--log",
        "--out",
        "--map",
        "--effort",
        "--cutoff-hz",
        "figure.svg",
        "Examples:",
        "Exit codes:",
    ] {
        assert!(help.out.contains(expected), "{expected} is missing in\n{}", help.out);
    }
}

#[test]
fn wrong_usage_exits_with_two() {
    let folder = arm::folder(Gap::None);
    let base = ["diagnose", "--robot", "arm.urdf", "--log", "run_0.csv", "--out", "out"];
    let with = |more: &[&str]| run(folder.path(), &[&base, more].concat());
    let cases: [(Answer, &str); 7] = [
        (run(folder.path(), &[]), "Usage"),
        (run(folder.path(), &["diagnoze"]), "diagnose"),
        (run(folder.path(), &["diagnose", "--robot", "arm.urdf"]), "--log"),
        (with(&["--cutoff-hz", "-3"]), "--cutoff-hz"),
        (with(&["--cutoff-hz", "abc"]), "a positive number was expected"),
        (with(&["--cutoff-hz", "5000"]), "half the sampling rate"),
        (run(folder.path(), &["explain", "frictoin"]), "did you mean FR01 viscous_friction"),
    ];
    for (answer, expected) in cases {
        assert_eq!(answer.code, 2, "{answer:?}");
        assert!(answer.err.contains(expected), "{expected} is missing in\n{}", answer.err);
    }
    assert!(!folder.path().join("out").exists());
}

#[test]
fn explain_prints_the_catalogue() {
    let folder = tempfile::tempdir().unwrap();
    let list = run(folder.path(), &["explain"]);
    assert_eq!((list.code, list.err.as_str()), (0, ""));
    for kind in catalogue::EffectKind::ALL {
        assert!(list.out.contains(kind.name()), "{}", list.out);
        let one = run(folder.path(), &["explain", kind.name()]);
        assert_eq!(one.code, 0);
        assert!(one.out.starts_with(&format!("{} ({kind})\n", kind.label())), "{}", one.out);
        assert_eq!(run(folder.path(), &["explain", &kind.code().to_lowercase()]).out, one.out);
        for expected in [kind.entry().equation, kind.entry().told_apart_by, kind.entry().source] {
            assert!(one.out.contains(expected), "{expected} is missing in\n{}", one.out);
        }
    }
}

#[test]
fn explain_prints_for_programs_what_can_be_done_about_each_effect() {
    let folder = tempfile::tempdir().unwrap();
    let answer = run(folder.path(), &["explain", "--json"]);
    let list: serde_json::Value = serde_json::from_str(&answer.out).unwrap();
    assert_eq!(list["schema"], "plumbline.effects/1");
    let effects = list["effects"].as_array().unwrap();
    let ripple = effects.iter().find(|e| e["name"] == "torque_ripple");
    let expected = serde_json::json!({
        "code": "DR01", "name": "torque_ripple", "family": "drive",
        "summary": "torque that varies with the motor angle",
        "diagnosed": true, "simulated": true, "compensated": true,
    });
    assert_eq!((effects.len(), ripple), (28, Some(&expected)));
    let answer = run(folder.path(), &["explain", "FR02", "--json"]);
    let one: serde_json::Value = serde_json::from_str(&answer.out).unwrap();
    assert_eq!(
        (&one["schema"], &one["name"]),
        (&"plumbline.effect/1".into(), &"coulomb_friction".into())
    );
    assert!(one["parameters"]["level"].as_str().unwrap().contains("N·m"), "{one}");
    assert!(one["confused_with"].as_array().unwrap().contains(&"viscous_friction".into()), "{one}");
}

#[test]
fn robot_check_names_an_impossible_inertia_and_exits_with_one() {
    let folder = arm::folder(Gap::None);
    let good = run(folder.path(), &["robot", "check", "arm.urdf"]);
    assert_eq!((good.code, good.err.as_str()), (0, ""));
    for expected in ["shoulder", "revolute", "-2.90 to 2.90", "consistent", "base parameters:"] {
        assert!(good.out.contains(expected), "{expected} is missing in\n{}", good.out);
    }
    arm::write(folder.path(), "bad.urdf", &arm::URDF.replace("iyy=\"0.03\"", "iyy=\"0.3\""));
    let bad = run(folder.path(), &["robot", "check", "bad.urdf", "--json"]);
    assert_eq!(bad.code, 1);
    let value: serde_json::Value = serde_json::from_str(&bad.out).unwrap();
    assert_eq!(value["joints"][0]["link_defects"].as_array().unwrap().len(), 0);
    let defect = value["joints"][1]["link_defects"][0].as_str().unwrap();
    assert!(defect.contains("exceeds the sum of the other two"), "{defect}");
}

#[test]
fn locked_joints_stand_where_the_option_says() {
    let folder = arm::folder(Gap::None);
    let check =
        |option: &str| run(folder.path(), &["robot", "check", "arm.urdf", "--locked", option]);
    let good = check("elbow=-0.5");
    assert_eq!((good.code, good.err.as_str()), (0, ""));
    assert!(good.out.contains("locked: elbow at -0.5"), "{}", good.out);
    for (option, code, expected) in [
        ("elbow", 2, "a joint and its position were expected, such as joint_3=1.2"),
        ("elbow=inf", 2, "a joint and its position were expected"),
        ("elbw=1", 3, "did you mean elbow?"),
    ] {
        let bad = check(option);
        assert_eq!(bad.code, code, "{option}: {}", bad.err);
        assert!(bad.err.contains(expected), "{option}: {}", bad.err);
    }
}

#[test]
fn robot_check_judges_moving_bodies() {
    let folder = arm::folder(Gap::None);
    let camera = r#"<link name="camera"><inertial><mass value="0.01"/>
      <inertia ixx="1e-5" ixy="0" ixz="0" iyy="1e-5" iyz="0" izz="9e-5"/></inertial></link>
      <joint name="mount" type="fixed"><parent link="PARENT"/><child link="camera"/></joint></robot>"#;
    for parent in ["upper", "base"] {
        let extra = camera.replace("PARENT", parent);
        arm::write(folder.path(), "camera.urdf", &arm::URDF.replace("</robot>", &extra));
        let answer = run(folder.path(), &["robot", "check", "camera.urdf"]);
        assert_eq!((answer.code, answer.out.contains("warning")), (0, false), "{answer:?}");
    }
}

#[test]
fn log_info_reads_a_log_with_and_without_a_robot() {
    let folder = arm::folder(Gap::None);
    let alone = run(folder.path(), &["log", "info", "run_0.csv"]);
    assert_eq!(alone.code, 0, "{}", alone.err);
    for expected in ["6000 rows", "200 Hz", "no gaps", "shoulder", "no acceleration"] {
        assert!(alone.out.contains(expected), "{expected} is missing in\n{}", alone.out);
    }
    std::fs::copy(folder.path().join("run_0.csv"), folder.path().join("copy.csv")).unwrap();
    let with = ["log", "info", "run_0.csv", "copy.csv", "--robot", "arm.urdf", "--json"];
    let answer = run(folder.path(), &with);
    let value: serde_json::Value = serde_json::from_str(&answer.out).unwrap();
    assert_eq!(value["files"][0]["joints"][1]["limits"][1], 2.9);
    assert!(value["files"][0]["repeats"].is_null());
    assert_eq!(value["files"][1]["repeats"], "run_0.csv");
}

/// The natural first look: a file whose columns name no joint, and nothing said of it.
#[test]
fn log_info_lists_the_columns_of_any_file() {
    let folder = arm::folder(Gap::None);
    let log = arm::log(0, Gap::None);
    let numbered = log.replace("shoulder.", "a1.").replace("elbow.", "a2.");
    let names = [("position", "q[K]"), ("velocity", "qd[K]"), ("effort", "tau[K]")];
    let mut vectors = numbered.clone();
    for (joint, place) in [("a1", "0"), ("a2", "1")] {
        for (channel, column) in names {
            vectors = vectors.replace(&format!("{joint}.{channel}"), &column.replace('K', place));
        }
    }
    arm::write(folder.path(), "vectors.csv", &vectors);
    let odd = vectors.replace("time", "stamp").replace("tau[", "load[");
    arm::write(folder.path(), "odd.csv", &odd);
    let told = run(folder.path(), &["log", "info", "vectors.csv", "odd.csv", "run_0.csv"]);
    assert_eq!((told.code, told.err.as_str()), (0, ""));
    for expected in [
        "vectors.csv\n 6000 rows, 7 columns",
        "--map numpy (arrays q, qd and tau over time), of 2 joints: --robot FILE reads them",
        "odd.csv\n 6000 rows, 7 columns",
        "load[1]",
        "rises by 0.00500 a row",
        "a column map says which column is what",
        "run_0.csv\n 6000 rows, 30.0 s",
    ] {
        assert!(told.out.contains(expected), "{expected} is missing in\n{}", told.out);
    }
    let answer = run(folder.path(), &["log", "info", "vectors.csv", "--json"]);
    let value: serde_json::Value = serde_json::from_str(&answer.out).unwrap();
    let own = &value["by_columns"][0];
    assert_eq!((own["map"].as_str(), own["joints"].as_u64()), (Some("numpy"), Some(2)));
    assert_eq!(own["columns"].as_array().map(Vec::len), Some(7));
    // With a robot it is refused, and the columns are listed as well.
    let refused = run(folder.path(), &["log", "info", "odd.csv", "--robot", "arm.urdf"]);
    assert_eq!(refused.code, 3);
    assert!(refused.err.contains("its columns are stamp, q[0], "), "{}", refused.err);
}

#[test]
fn log_info_tells_a_clock_in_other_units() {
    let folder = arm::folder(Gap::None);
    let log = arm::log(0, Gap::None);
    let rows = log.lines().enumerate().map(|(k, line)| {
        let (time, rest) = line.split_once(',').unwrap();
        let time = time.parse::<f64>().map_or(time.to_owned(), |t| format!("{:.0}", 1e9 * t));
        if k == 0 { format!("{line}\n") } else { format!("{time},{rest}\n") }
    });
    arm::write(folder.path(), "ns.csv", &rows.collect::<String>());
    let told = run(folder.path(), &["log", "info", "ns.csv"]);
    assert!(told.out.contains("warning: time looks like ns"), "{}", told.out);
    let told = run(folder.path(), &["log", "info", "run_0.csv"]);
    assert!(!told.out.contains("time looks like"), "{}", told.out);
}

#[test]
fn a_reader_that_has_gone_is_no_error() {
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    let output = plumbline().arg("explain").stdout(writer).output().unwrap();
    assert_eq!(output.status.code(), Some(0));
    assert_eq!(String::from_utf8(output.stderr).unwrap(), "");
}

#[test]
fn the_exit_code_is_that_of_the_verdict_also_when_the_reader_has_gone() {
    let folder = arm::folder(Gap::Ripple(1.5));
    let (reader, writer) = std::io::pipe().unwrap();
    drop(reader);
    let arguments = ["diagnose", "--robot", "arm.urdf", "--log", "run_0.csv", "--out", "out"];
    let mut command = plumbline();
    command.current_dir(folder.path()).args(arguments).stdout(writer);
    assert_eq!(command.output().unwrap().status.code(), Some(1));
    assert!(folder.path().join("out/report.html").exists());
}

#[test]
fn colours_are_left_out_of_a_pipe_and_where_they_are_not_wanted() {
    let coloured = |name: Option<&str>| {
        let mut command = plumbline();
        command.args(["explain", "payload"]).env("CLICOLOR_FORCE", "1");
        name.map(|name| command.env(name, "1"));
        let answer: Answer = command.output().unwrap().into();
        answer.out.contains('\u{1b}')
    };
    assert!(coloured(None), "colours can be forced");
    assert!(!coloured(Some("NO_COLOR")));
    let piped: Answer = plumbline().args(["explain", "payload"]).output().unwrap().into();
    assert!(!piped.out.contains('\u{1b}'));
}
