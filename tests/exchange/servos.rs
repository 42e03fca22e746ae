//! The servos of an arm for MuJoCo, Isaac Lab and BAM.

use std::path::Path;
use std::process::Command;

use exchange::{Export, Format, export};
use robot::{Loaded, Robot};
use serde_json::Value;

use crate::mujoco::mujoco;
use crate::python::{ask, has_mujoco};
use crate::rich::{State, torque};

const LINK: &str = r#"<inertial><origin xyz="0.1 0 0"/><mass value="1"/><inertia ixx="0.01" ixy="0" ixz="0" iyy="0.02" iyz="0" izz="0.02"/></inertial>"#;

/// Two joints in a row, called so.
fn urdf(names: [&str; 2]) -> String {
    let [a, b] = names.map(escaped);
    let joint = |name: &str, parent: &str, child: &str| {
        format!(
            r#"<joint name="{name}" type="revolute"><parent link="{parent}"/><child link="{child}"/><origin xyz="0.2 0 0"/><axis xyz="0 1 0"/><limit lower="-2" upper="2" effort="3" velocity="5"/></joint>"#
        )
    };
    format!(
        r#"<robot name="arm"><link name="base"/><link name="u">{LINK}</link><link name="f">{LINK}</link>{}{}</robot>"#,
        joint(&a, "base", "u"),
        joint(&b, "u", "f")
    )
}

/// Any text as the value of an attribute of XML.
fn escaped(text: &str) -> String {
    let of = |c: char| {
        if c.is_ascii_alphanumeric() { c.to_string() } else { format!("&#{};", u32::from(c)) }
    };
    text.chars().map(of).collect()
}

const LOOP: &str = "effort_source = { position_loop = { kp_nm_per_rad = [20.0, 8.0], kd_nm_s_per_rad = [1.6, 0.5], goal_hold_hz = 100.0 } }\n";

const DRIVES: &str = "
[joint.shoulder]
rotor_inertia_kg_m2 = 0.03
coulomb_nm = 0.2
viscous_nm_s_per_rad = 0.1
goal_delay_ms = 21.0
[joint.elbow]
rotor_inertia_kg_m2 = 0.01
coulomb_nm = 0.1
stribeck_excess_nm = 0.05
stribeck_velocity_rad_per_s = 0.3
load_friction = 0.08
goal_delay_ms = 21.0
";

fn arm_of(names: [&str; 2], keys: &str) -> (Loaded, String) {
    let folder = tempfile::tempdir().unwrap();
    let source = urdf(names);
    std::fs::write(folder.path().join("arm.urdf"), &source).unwrap();
    let path = folder.path().join("robot.toml");
    std::fs::write(&path, format!("urdf = \"arm.urdf\"\n{keys}")).unwrap();
    (Robot::load(&path).unwrap(), source)
}

fn written(keys: &str, format: Format) -> Export {
    let (loaded, source) = arm_of(["shoulder", "elbow"], keys);
    export(&loaded, &source, format).unwrap()
}

/// What is said of a quantity of a joint: the word of its fate and how or why.
fn told(export: &Export, at: &str, what: &str) -> (String, String) {
    let row = export.fates.iter().find(|f| f.at == at && f.what.starts_with(what));
    assert!(row.is_some(), "{what} of {at}: {:?}", export.fates);
    let fate = &row.unwrap().fate;
    (fate.word().to_owned(), fate.to_string())
}

fn read_again(text: &str) -> Loaded {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path().join("again.xml");
    std::fs::write(&path, text).unwrap();
    Robot::load(&path).unwrap()
}

#[test]
fn a_servo_is_a_position_actuator_and_is_read_again_as_one() {
    let written = written(&(LOOP.to_owned() + DRIVES), Format::Mjcf);
    assert!(!written.text.contains("<motor"), "{}", written.text);
    assert_eq!(told(&written, "shoulder", "position loop").0, "exact");
    assert_eq!(told(&written, "shoulder", "goals late by 21 ms").0, "exact");
    let again = read_again(&written.text);
    let gains: Vec<[f64; 2]> = again.control.gains.iter().flatten().map(|g| [g.kp, g.kd]).collect();
    assert_eq!(gains, [[20.0, 1.6], [8.0, 0.5]]);
    for link in again.robot.links() {
        assert_eq!([link.actuator.goal_delay_s, link.actuator.delay_s], [0.021, 0.0]);
        assert_eq!(link.joint.limits.effort, Some(3.0));
    }
}

/// A delay of goals in which half a hold may be is not called exact, and one of the torque has a size.
/// Robots without a position loop keep the integrator of their simulation.
#[test]
fn a_file_of_mujoco_with_servos_says_under_which_integrator_they_follow() {
    for format in [Format::Mjcf, Format::ActuatorMjcf] {
        let servos = written(&format!("{LOOP}{DRIVES}"), format);
        let (word, why) = told(&servos, "robot", "step of the position loops");
        assert!(word == "exact" && why.contains("Euler"), "{word}: {why}");
        let option = servos.text.lines().find(|line| line.contains("<option")).unwrap();
        assert!(
            option.contains("integrator=\"RK4\"") && option.contains("timestep=\"0.002\""),
            "{option}"
        );
    }
    let plain = written(DRIVES, Format::Mjcf);
    assert!(!plain.text.contains("integrator"), "{}", plain.text);
    assert!(plain.fates.iter().all(|f| f.at != "robot"), "{:?}", plain.fates);
}

#[test]
fn times_have_no_digits_below_a_hundredth_of_a_millisecond() {
    let late = DRIVES.replace("21.0", "11.111111");
    let servos = written(&format!("{LOOP}{late}"), Format::Mjcf);
    let of = |what: &str| servos.fates.iter().find(|f| f.at == "elbow" && f.what.starts_with(what));
    assert_eq!(of("goals late").map(|f| f.what.as_str()), Some("goals late by 11.11 ms"));
}

#[test]
fn what_a_delay_leaves_out_has_a_size() {
    let unheld = LOOP.replace(", goal_hold_hz = 100.0", "");
    let late = format!(
        "{unheld}[joint.elbow]\ngoal_delay_ms = 21.0\nactuator_delay_ms = 3.0\nactuator_lag_ms = 2.0\n"
    );
    for format in [Format::Mjcf, Format::ActuatorMjcf, Format::ActuatorBam] {
        let written = written(&late, format);
        assert_eq!(told(&written, "elbow", "goals late by").0, "approximated", "{format:?}");
        // kp times the delay: 8 N·m/rad over 3 ms, and over 2 ms.
        for (what, damping) in [("delay 3 ms", "0.024 N·m·s/rad"), ("lag 2 ms", "0.016 N·m·s/rad")]
        {
            let (word, how) = told(&written, "elbow", what);
            assert!(word == "approximated" && how.contains(damping), "{format:?}: {word}: {how}");
        }
    }
    let text = written(&late, Format::Mjcf).text;
    let delay = text.split("delay=\"").nth(1).and_then(|t| t.split('"').next()).unwrap();
    assert!((delay.parse::<f64>().unwrap() - 0.026).abs() < 1e-12, "{delay}");
    let isaac = written(&late, Format::ActuatorIsaac);
    let how = told(&isaac, "elbow", "goals late by").1;
    assert!(how.contains("5 of 5 ms are 25 ms, -1 ms off"), "{how}");
    let held = isaac.robot.links()[1].actuator.goal_delay_s;
    assert!((held - 0.020).abs() < 1e-12, "{held}: the goal as late as the file has it");
}

#[test]
fn an_arm_without_gains_has_no_servos_and_one_with_a_controller_has() {
    let (loaded, source) = arm_of(["shoulder", "elbow"], "");
    for format in Format::ACTUATORS {
        let error = export(&loaded, &source, format).unwrap_err().to_string();
        assert!(error.starts_with("no joint of arm has a position loop: effort_source"), "{error}");
    }
    let gains = "[joint.elbow]\nkp_nm_per_rad = 8.0\nkd_nm_s_per_rad = 0.5\n";
    for format in Format::ACTUATORS {
        let written = written(gains, format);
        assert!(
            written.text.contains("elbow") && !written.text.contains("shoulder"),
            "{}",
            written.text
        );
        assert_eq!(told(&written, "shoulder", "servo").1, "the joint has no position loop");
        let (word, how) = told(&written, "elbow", "position loop 8 N·m/rad");
        // kd / kp
        assert!(word == "approximated" && how.contains("62.5 ms late"), "{how}");
    }
    // The controller of an arm whose log has torques stays one of torques.
    assert!(written(gains, Format::Mjcf).text.contains("<motor name=\"elbow\""));
}

/// What `actuators(physics_dt)` of the module gives with a stand-in for Isaac Lab, whose limits have these names.
fn asked_of_isaac(module: &str, prefix: &str, physics_dt: f64, folder: &Path) -> Option<Value> {
    if !Command::new("python3").arg("--version").output().is_ok_and(|o| o.status.success()) {
        println!("skipped: there is no python3");
        return None;
    }
    const SCRIPT: &str = "
import dataclasses, json, os, sys, types
question = json.load(sys.stdin)
os.chdir(question['folder'])
names = ['joint_names_expr', 'stiffness', 'damping', 'armature', 'friction', 'dynamic_friction', 'viscous_friction']
names += [question['prefix'] + limit for limit in ('effort_limit', 'velocity_limit')]
ideal = dataclasses.make_dataclass('IdealPDActuatorCfg', names)
delayed = dataclasses.make_dataclass('DelayedPDActuatorCfg', names + ['min_delay', 'max_delay'])
stand_in = types.ModuleType('isaaclab.actuators')
stand_in.IdealPDActuatorCfg, stand_in.DelayedPDActuatorCfg = ideal, delayed
sys.modules['isaaclab'], sys.modules['isaaclab.actuators'] = types.ModuleType('isaaclab'), stand_in
space = {}
exec(compile(question['module'], 'extended_actuator.py', 'exec'), space)
actuators = space['actuators'](physics_dt=question['physics_dt'])
json.dump({k: [type(v).__name__, dataclasses.asdict(v)] for k, v in actuators.items()}, sys.stdout)
";
    let question = serde_json::json!({
        "module": module, "prefix": prefix, "physics_dt": physics_dt, "folder": folder,
    });
    let answer = ask(SCRIPT, &question, &format!("Python refuses\n{module}"));
    Some(serde_json::from_str(&answer).unwrap())
}

#[test]
fn isaac_lab_gets_its_own_names_and_whole_steps() {
    let folder = tempfile::tempdir().unwrap();
    let module = written(&(LOOP.to_owned() + DRIVES), Format::ActuatorIsaac).text;
    for (prefix, physics_dt, steps) in [("", 0.005, 4), ("actuator_", 0.002, 10)] {
        let Some(told) = asked_of_isaac(&module, prefix, physics_dt, folder.path()) else { return };
        let (kind, values) = (&told["servos_1"][0], &told["servos_1"][1]);
        assert_eq!(kind, "DelayedPDActuatorCfg");
        assert_eq!([&values["min_delay"], &values["max_delay"]], [steps, steps]);
        for (key, [shoulder, elbow]) in [
            ("stiffness", [20.0, 8.0]),
            ("damping", [1.6, 0.5]),
            ("armature", [0.03, 0.01]),
            ("friction", [0.2, 0.1 + 0.05]),
            ("dynamic_friction", [0.2, 0.1]),
            ("viscous_friction", [0.1, 0.0]),
            (&format!("{prefix}effort_limit"), [3.0, 3.0]),
            (&format!("{prefix}velocity_limit"), [5.0, 5.0]),
        ] {
            assert_eq!(
                values[key],
                serde_json::json!({ "shoulder": shoulder, "elbow": elbow }),
                "{key}"
            );
        }
    }
    let prompt = written(LOOP, Format::ActuatorIsaac).text;
    let Some(told) = asked_of_isaac(&prompt, "", 0.005, folder.path()) else { return };
    assert_eq!(told["servos_1"][0], "IdealPDActuatorCfg", "goals that are in time");
}

/// Names that close a string, a comment or a docstring, and patterns: no line of Python comes from them, XML and JSON
/// give them back.
#[test]
fn a_name_is_never_code() {
    let hostile =
        ["x\"]}]\nopen('pwned', 'w')\n#", "'''\"\"\"\\\"+open('pwned', 'w').name+\"\u{2028}.* -->"];
    let (loaded, source) = arm_of(hostile, LOOP);
    let names: Vec<&str> = loaded.robot.joint_names().collect();
    let folder = tempfile::tempdir().unwrap();
    let module = export(&loaded, &source, Format::ActuatorIsaac).unwrap().text;
    assert!(!module.contains("open("), "{module}");
    if let Some(told) = asked_of_isaac(&module, "", 0.005, folder.path()) {
        let joints = told["servos_1"][1]["joint_names_expr"].as_array().unwrap();
        let plain = |c: char| c.is_ascii_alphanumeric() || c == '_';
        assert!(joints.len() == 2 && joints.iter().all(|j| j.as_str().unwrap().chars().all(plain)));
        assert_eq!(std::fs::read_dir(folder.path()).unwrap().count(), 0, "something was written");
    }
    let json = export(&loaded, &source, Format::ActuatorBam).unwrap().text;
    let laws: Value = serde_json::from_str(&json).unwrap();
    assert!(names.iter().all(|name| laws[name].is_object()), "{json}");
    let again = read_again(&export(&loaded, &source, Format::Mjcf).unwrap().text);
    let held: Vec<&str> = again.robot.joint_names().collect();
    // XML reads a line break in an attribute as a blank, as it did in the URDF's own text where it is not escaped.
    assert_eq!(held.len(), 2);
    assert!(held.iter().all(|name| name.contains("pwned")), "{held:?}");
}

/// The torque of BAM's law is that of the loop up to the limit, and its friction that of the drive.
#[test]
fn a_law_of_bam_is_that_of_the_servo() {
    let written = written(&(LOOP.to_owned() + DRIVES), Format::ActuatorBam);
    let laws: Value = serde_json::from_str(&written.text).unwrap();
    let of = |joint: &str| {
        let law = laws[joint].clone();
        move |key: &str| law[key].as_f64().unwrap_or_else(|| panic!("{key} of {law}"))
    };
    assert_eq!([&laws["shoulder"]["model"], &laws["elbow"]["model"]], ["m1", "m4"]);
    for (joint, kp, kd) in [("shoulder", 20.0, 1.6), ("elbow", 8.0, 0.5)] {
        let p = of(joint);
        let tau = |error: f64, qd: f64| {
            let duty = (p("kp") * p("error_gain") * error).clamp(-p("max_pwm"), p("max_pwm"));
            p("kt") * p("vin") * duty / p("R") - p("kt").powi(2) * qd / p("R")
        };
        for (error, qd) in [(0.05, 0.0), (-0.1, 0.4), (0.12, -1.3)] {
            assert!((tau(error, qd) - (kp * error - kd * qd)).abs() < 1e-12, "{joint}");
        }
        assert!((tau(9.0, 0.0) - 3.0).abs() < 1e-12, "the limit at rest");
        assert_eq!(p("command_delay"), 0.021);
    }
    let elbow = of("elbow");
    // Sliding at .4 rad/s with a load of 1.5 N·m that the motor holds: 1.5 and -1.5 N·m at the gearbox.
    let near_rest = (-(0.4_f64 / elbow("dtheta_stribeck")).powf(elbow("alpha"))).exp();
    let budget = elbow("friction_base")
        + near_rest * (elbow("friction_stribeck") + elbow("load_friction_stribeck") * 3.0)
        + elbow("load_friction_base") * 3.0;
    let expected = 0.1 + 0.05 * (-(0.4_f64 / 0.3).powi(2)).exp() + 0.08 * 1.5;
    assert!((budget - expected).abs() < 1e-12, "{budget} N·m, not {expected}");
    assert!(told(&written, "elbow", "friction per load").1.contains("4 % of the level"));
}

#[test]
fn a_law_that_is_none_of_bams_is_refused_with_its_reason() {
    let of = |keys: &str| written(&format!("{LOOP}[joint.elbow]\n{keys}\n"), Format::ActuatorBam);
    for (keys, reason) in [
        (
            "coulomb_forward_nm = 0.3\ncoulomb_backward_nm = 0.2",
            "friction of BAM is the same in both directions",
        ),
        ("presliding_rad = 0.01", "it builds up over a way"),
        ("backlash_rad = 0.01", "rigid and without play"),
        ("viscous_nm_s_per_rad = -0.1", "no friction below 0"),
    ] {
        let written = of(keys);
        let (word, why) = told(&written, "elbow", "servo");
        assert!(word == "dropped" && why.contains(reason), "{keys}: {word}: {why}");
        let laws: Value = serde_json::from_str(&written.text).unwrap();
        assert!(laws["elbow"].is_null() && laws["shoulder"].is_object(), "{laws}");
    }
    let undamped = LOOP.replace("[1.6, 0.5]", "[0.0, 0.0]");
    let written = written(&undamped, Format::ActuatorBam);
    assert_eq!(written.text, "", "no servo has a law");
    assert!(told(&written, "elbow", "servo").1.contains("back EMF"));
}

/// An arm whose own MJCF includes the servos, its joints in their classes, needs the torque of the one that has all.
#[test]
fn oracle_mujoco_needs_the_same_torque_with_the_servos_included() {
    let keys = LOOP.to_owned() + DRIVES;
    let (loaded, source) = arm_of(["shoulder", "elbow"], LOOP);
    let mut own = export(&loaded, &source, Format::Mjcf).unwrap().text;
    let (start, end) = (own.find("<actuator>").unwrap(), own.find("</actuator>").unwrap());
    own.replace_range(start..end + "</actuator>".len(), "");
    let card = written(&keys, Format::ActuatorMjcf).text;
    let inner = |tag: &str| {
        let (from, to) = (card.find(&format!("<{tag}>")), card.find(&format!("</{tag}>")));
        let to = if tag == "default" { card.rfind("</default>") } else { to };
        &card[from.unwrap()..to.unwrap() + tag.len() + 3]
    };
    // As <include> does it.
    let parts = format!("{}{}</mujoco>", inner("default"), inner("actuator"));
    let mut included = own.replace("</mujoco>", &parts);
    for joint in ["shoulder", "elbow"] {
        let name = format!("<joint name=\"{joint}\"");
        assert!(included.contains(&name), "{included}");
        included = included.replace(&name, &format!("{name} class=\"{joint}_servo\""));
    }
    let whole = written(&keys, Format::Mjcf);
    let state: State = [vec![0.3, -0.4], vec![0.5, 0.8], vec![2.0, -3.0]];
    let joints = ["shoulder", "elbow"];
    let Some(theirs) = mujoco(&included, &joints, std::slice::from_ref(&state)) else { return };
    let ours = torque(&whole.robot, &state);
    for (a, b) in theirs[0].iter().zip(&ours) {
        assert!((a - b).abs() < 1e-9, "{theirs:?} with the servos included, {ours:?}");
    }
}

/// The force of MuJoCo's actuator is the torque of the loop, with gain, offset and ratio of the drive.
#[test]
fn oracle_an_actuator_of_mujoco_has_the_torque_of_the_loop() {
    let keys = format!(
        "{LOOP}[joint.elbow]\ntorque_gain = 1.2\ntorque_offset_nm = 0.1\ntransmission_ratio = 1.1\n"
    );
    let text = written(&keys, Format::Mjcf).text;
    assert!(text.contains("<general name=\"elbow\""), "{text}");
    if !has_mujoco() {
        return;
    }
    const SCRIPT: &str = "
import json, sys, mujoco
question = json.load(sys.stdin)
model = mujoco.MjModel.from_xml_string(question['model'])
data = mujoco.MjData(model)
data.qpos[:], data.qvel[:], data.ctrl[:] = question['q'], question['qd'], question['goal']
mujoco.mj_forward(model, data)
json.dump(list(data.actuator_force), sys.stdout)
";
    let ([q, qd], goal) = ([[0.2, 0.33], [0.4, -0.22]], [0.25, 0.31]);
    let question = serde_json::json!({ "model": text, "q": q, "qd": qd, "goal": goal });
    let forces: Vec<f64> = serde_json::from_str(&ask(SCRIPT, &question, &text)).unwrap();
    let shoulder = 20.0 * (goal[0] - q[0]) - 1.6 * qd[0];
    // effort = kp (goal - q_reported) - kd qd_reported = ratio gain tau + offset
    let elbow = (8.0 * (goal[1] - q[1] / 1.1) - 0.5 * qd[1] / 1.1 - 0.1) / (1.1 * 1.2);
    assert!((forces[0] - shoulder).abs() < 1e-12, "{forces:?}, {shoulder}");
    assert!((forces[1] - elbow).abs() < 1e-12, "{forces:?}, {elbow}");
}
