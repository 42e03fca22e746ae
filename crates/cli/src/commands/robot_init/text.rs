//! The files: every key with a word about what it is and where the number comes from.

use std::fmt::Write;
use std::path::Path;

use robot::{Link, Loaded, Robot};

use super::excitation::{Excitation, SEEDS};
use super::guess::DriveGuess;
use super::quote::{key, quote};
use crate::escape::escape_line;

/// Files that hold the schemas, beside the files that they are of.
pub const ROBOT_SCHEMA: &str = "robot.schema.json";
pub const SCENARIO_SCHEMA: &str = "scenario.schema.json";

const OTHERS: &str = "\
# More that a joint may say, each at its own place below ([joint.NAME]):
#   viscous_nm_s_per_rad, coulomb_nm       friction, where a data sheet has it
#   elasticity_nm_per_rad, backlash_rad    the transmission
#   torque_gain, torque_offset_nm          effort in the log over torque, effort at no torque
#   actuator_delay_ms, actuator_lag_ms     from command to torque
# At a prismatic joint nm stands for N, rad for m and kg_m2 for kg.
";

/// The text of `robot.toml`.
pub fn robot_toml(loaded: &Loaded, model: &Path, drives: &[DriveGuess], rate_hz: f64) -> String {
    let robot = &loaded.robot;
    let mut text = format!(
        "#:schema ./{ROBOT_SCHEMA}\n# {}: what its description cannot say. Replace what is called a guess.\nurdf = {}\n",
        escape_line(robot.name()),
        quote(&model.to_string_lossy())
    );
    if let Some(joints) = &loaded.part.joints {
        let names: Vec<String> = joints.iter().map(|name| quote(name)).collect();
        let _ = writeln!(text, "# The joints that move; the others are locked at zero.");
        let _ = writeln!(text, "joints = [{}]", names.join(", "));
    }
    let _ = write!(
        text,
        "\n# Rate of the joint controller (Hz); a guess.\ncontrol_rate_hz = {rate_hz:?}\n\
         # Where positions are measured, \"motor\" or \"link\"; unknown counts as the motor.\nsensing = \"unknown\"\n\
         # What a log's effort is: \"measured\", \"commanded\" or \"current\".\ntorque_source = \"unknown\"\n\
         # Free fall in the base frame, for an arm that is mounted otherwise.\n"
    );
    let [x, y, z]: [f64; 3] = robot.gravity_in_base().into();
    let _ = writeln!(text, "# gravity_m_per_s2 = [{x:?}, {y:?}, {z:?}]\n");
    text.push_str(OTHERS);
    for (link, drive) in robot.links().iter().zip(drives) {
        joint(&mut text, link, drive);
    }
    text.push_str(
        "\n# The gains above weakened at the same damping ratio, as run and track take them.\n",
    );
    let list = |values: Vec<String>| values.join(", ");
    let kp = list(drives.iter().map(|drive| format!("{:?}", 0.25 * drive.gain.kp)).collect());
    let kd = list(drives.iter().map(|drive| format!("{:?}", 0.5 * drive.gain.kd)).collect());
    let _ = write!(text, "[gains.low-quarter]\nkp_nm_per_rad = [{kp}]\nkd_nm_s_per_rad = [{kd}]\n");
    text
}

fn joint(text: &mut String, link: &Link, drive: &DriveGuess) {
    let limits = &link.joint.limits;
    let _ = writeln!(text, "\n[joint.{}]", key(&link.joint.name));
    if drive.rotor_guessed {
        let _ = writeln!(
            text,
            "# Rotor and gear seen at the joint; a guess from effort limit and inertia.\nrotor_inertia_kg_m2 = {:?}",
            drive.rotor
        );
    }
    match limits.effort {
        Some(limit) => {
            let _ = writeln!(text, "# torque_limit_nm = {limit:?} is that of the description.");
        }
        None => {
            let _ = writeln!(text, "# torque_limit_nm = ... is not in the description.");
        }
    }
    let origin = if drive.gain_guessed {
        "a guess from inertia, weight and rate"
    } else {
        "those of the description"
    };
    let _ = writeln!(
        text,
        "# Gains of the controller; {origin}.\nkp_nm_per_rad = {:?}\nkd_nm_s_per_rad = {:?}",
        drive.gain.kp, drive.gain.kd
    );
}

/// The text of `scenario.toml`.
pub fn scenario_toml(robot: &Robot, excitation: &Excitation) -> String {
    let mut text = format!(
        "#:schema ./{SCENARIO_SCHEMA}\n# {} as described, three runs of sinusoids at all joints, within the limits.\nrobot = \"robot.toml\"\n\n",
        escape_line(robot.name())
    );
    text.push_str(
        "# plumbline explain lists what can be put in; this is dry friction.\n# [[effect]]\n",
    );
    if let Some(name) = robot.joint_names().next() {
        let name = quote(name);
        let _ = writeln!(text, "# coulomb_friction = {{ joint = {name}, level_nm = 1.0 }}\n");
    }
    text.push_str("[sensors]\nlog_rate_hz = 250.0\n# position_resolution_rad = { JOINT = 1e-4 }    step of the encoder\n# effort_noise_nm = { JOINT = 0.1 }\n");
    for (index, seed) in SEEDS.iter().enumerate() {
        let motion = excitation.motion(*seed);
        let _ =
            write!(text, "\n[[run]]\nname = \"run_{}\"\nmotion.sinusoids = {motion}\n", index + 1);
    }
    text
}
