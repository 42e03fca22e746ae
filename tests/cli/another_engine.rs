//! `tests/benches/mujoco_panel.py` moves arms with MuJoCo: a pendulum needs the torque of its closed form.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;
use std::process::Command;

use checks::arms::workspace_root;
use logs::{Channels, ReadOptions, Run};
use robot::Robot;

use crate::program::PROGRAM;

/// A rod: mass (kg), distance of its centre (m), inertia about it (kg m²), rotor (kg m²), dry (N m) and viscous
/// friction (N m s/rad), gravity (m/s²).
const MASS: f64 = 1.3;
const CENTRE: f64 = 0.24;
const INERTIA: f64 = 0.011;
const ROTOR: f64 = 0.02;
const DRY: f64 = 0.35;
const VISCOUS: f64 = 0.12;
const GRAVITY: f64 = 9.81;
/// What a command reports of a torque: gain and offset (N m).
const GAIN: f64 = 1.1;
const OFFSET: f64 = 0.2;

/// Rate of controller and log (Hz), length (s), amplitude (rad) and frequency (rad/s) of the motion.
const RATE_HZ: f64 = 1000.0;
const LENGTH_S: f64 = 5.0;
const AMPLITUDE: f64 = 0.7;
const OMEGA: f64 = 3.0;

/// Largest error over the largest torque. Velocities of a semi-implicit step of 0.1 ms are half a step off:
/// 0.00005 s of the 1/3 s in which the torque turns; MuJoCo's dry friction is 0.1 % soft (`solimpfriction`).
const TOLERANCE: f64 = 2e-3;

const URDF: &str = r#"<robot name="pendulum"><link name="base"/><link name="rod"><inertial><origin xyz="0 0 -0.24"/><mass value="1.3"/><inertia ixx="0.011" ixy="0" ixz="0" iyy="0.011" iyz="0" izz="0.001"/></inertial></link><joint name="hinge" type="revolute"><parent link="base"/><child link="rod"/><axis xyz="0 1 0"/><limit lower="-3" upper="3" effort="60" velocity="10"/></joint></robot>"#;

const TOML: &str = "urdf = \"robot.urdf\"\ncontrol_rate_hz = 1000.0\ntorque_source = \"commanded\"\n\
    [joint.hinge]\nrotor_inertia_kg_m2 = 0.02\nkp_nm_per_rad = 300.0\nkd_nm_s_per_rad = 12.0\n";

const SCENARIO: &str = "robot = \"robot.toml\"\n[sensors]\nposition = \"link\"\neffort = \"commanded\"\n\
    velocity = \"ideal\"\nlog_rate_hz = 1000.0\n\
    [[effect]]\ncoulomb_friction = { joint = \"hinge\", level_nm = 0.35 }\n\
    [[effect]]\nviscous_friction = { joint = \"hinge\", viscous_nm_s_per_rad = 0.12 }\n\
    [[effect]]\ntorque_constant = { joint = \"hinge\", gain = 1.1 }\n\
    [[effect]]\ntorque_offset = { joint = \"hinge\", offset_nm = 0.2 }\n\
    [[run]]\nname = \"held_out\"\nlead_in_s = 0.5\n";

/// An entry of a store: a pendulum that is asked for `q = A (1 - cos(w t))`.
fn write_entry(entry: &Path, scenario: &str) {
    let time: Vec<f64> = (0..=(LENGTH_S * RATE_HZ) as usize).map(|k| k as f64 / RATE_HZ).collect();
    let of =
        |signal: &dyn Fn(f64) -> f64| time.iter().map(|t| signal(OMEGA * t)).collect::<Vec<_>>();
    let hinge = Channels {
        name: "hinge".to_owned(),
        position: of(&|_| 0.0),
        effort: of(&|_| 0.0),
        velocity: Some(of(&|_| 0.0)),
        link_position: Some(of(&|_| 0.0)),
        desired_position: Some(of(&|x| AMPLITUDE * (1.0 - x.cos()))),
        desired_velocity: Some(of(&|x| AMPLITUDE * OMEGA * x.sin())),
        desired_acceleration: Some(of(&|x| AMPLITUDE * OMEGA * OMEGA * x.cos())),
        ..Channels::default()
    };
    let run = Run {
        name: "held_out".to_owned(),
        source: Default::default(),
        sha256: String::new(),
        is_torn: false,
        mended: Vec::new(),
        time,
        joints: vec![hinge],
        extra: BTreeMap::new(),
    };
    for folder in ["truth", "nominal"] {
        fs::create_dir_all(entry.join(folder)).unwrap();
        fs::write(entry.join(folder).join("robot.urdf"), URDF).unwrap();
        fs::write(entry.join(folder).join("robot.toml"), TOML).unwrap();
    }
    fs::write(entry.join("truth/scenario.toml"), scenario).unwrap();
    for folder in ["logs", "held_out"] {
        fs::create_dir_all(entry.join(folder)).unwrap();
        logs::write_parquet(&entry.join(folder).join("held_out.parquet"), &run).unwrap();
    }
    let sheet = r#"{"seed": 5, "corner": {"origin": "simulated"}, "strangers": []}"#;
    fs::write(entry.join("sheet.json"), sheet).unwrap();
    fs::write(entry.join("entry.json"), r#"{"format": 1, "files": {}}"#).unwrap();
}

/// What the script prints for a store; `None` where Python lacks what it needs.
fn remade(store: &Path, out: &Path) -> Option<String> {
    let python = |arguments: &[&str]| Command::new("python3").args(arguments).output();
    let found = python(&["-c", "import mujoco, numpy, pyarrow"]);
    if !found.is_ok_and(|output| output.status.success()) {
        println!("skipped: python3 lacks one of mujoco, numpy, pyarrow; pip install brings them");
        return None;
    }
    let script = workspace_root().join("tests/benches/mujoco_panel.py");
    let paths = [script.as_path(), store, out].map(|path| path.display().to_string());
    let [script, store, out] = paths.each_ref().map(String::as_str);
    let output = python(&[script, store, out, "--plumbline", PROGRAM]).unwrap();
    println!("{}", String::from_utf8_lossy(&output.stderr));
    Some(String::from_utf8(output.stdout).unwrap())
}

#[test]
fn oracle_a_pendulum_of_mujoco_needs_the_torque_of_its_closed_form() {
    let folder = tempfile::tempdir().unwrap();
    let [store, out] = ["store", "out"].map(|name| folder.path().join(name));
    write_entry(&store.join("ab/abcd"), SCENARIO);
    let Some(said) = remade(&store, &out) else { return };
    assert!(said.contains("1 trials made by MuJoCo"), "{said}");
    let robot = Robot::load(&out.join("ab/abcd/nominal/robot.toml")).unwrap().robot;
    let log = out.join("ab/abcd/held_out/held_out.parquet");
    let run = logs::read_run(&log, &robot, &ReadOptions::default()).unwrap();
    let (q, effort) = (&run.joints[0].position, &run.joints[0].effort);
    let qd = run.joints[0].velocity.as_ref().unwrap();
    let inertia = INERTIA + MASS * CENTRE * CENTRE + ROTOR;
    let (mut worst, mut largest, mut counted) = (0.0_f64, 0.0_f64, 0);
    for k in 1..q.len() - 1 {
        // Between two rows the torque is constant, and what it does is the mean of both.
        let [speed, angle] = [qd, q].map(|signal| 0.5 * (signal[k] + signal[k + 1]));
        let fall = MASS * GRAVITY * CENTRE * angle.sin();
        let acceleration = (qd[k + 1] - qd[k]) * RATE_HZ;
        let torque = inertia * acceleration + fall + DRY * speed.signum() + VISCOUS * speed;
        largest = largest.max(torque.abs());
        if speed.abs() > 0.05 {
            worst = worst.max((effort[k] - OFFSET - GAIN * torque).abs());
            counted += 1;
        }
    }
    println!("largest error over largest torque: {:.1e} in {counted} rows", worst / largest);
    assert!(counted > 4000 && largest > 3.0, "{counted} rows, {largest} N m");
    assert!(worst < TOLERANCE * largest, "{worst} of {largest} N m");
    let sheet = fs::read_to_string(out.join("ab/abcd/sheet.json")).unwrap();
    assert!(sheet.contains("\"another_engine\""), "{sheet}");
    // The list of files is that of the store: one that is damaged is seen.
    let listed = fs::read_to_string(out.join("ab/abcd/entry.json")).unwrap();
    let files =
        ["held_out/held_out.parquet", "logs/held_out.parquet", "sheet.json", "truth/scenario.toml"];
    assert!(files.iter().all(|file| listed.contains(file)), "{listed}");
}

/// The log of the pendulum with more causes; `None` where Python lacks what it needs.
fn remade_with(scenario: &str) -> Option<Channels> {
    let folder = tempfile::tempdir().unwrap();
    let [store, out] = ["store", "out"].map(|name| folder.path().join(name));
    write_entry(&store.join("ab/abcd"), scenario);
    let said = remade(&store, &out)?;
    assert!(said.contains("1 trials made by MuJoCo"), "{said}");
    let robot = Robot::load(&out.join("ab/abcd/nominal/robot.toml")).unwrap().robot;
    let log = out.join("ab/abcd/held_out/held_out.parquet");
    logs::read_run(&log, &robot, &ReadOptions::default()).unwrap().joints.pop()
}

/// Torque (N m) that the rod alone asks for in row `k`, by the second difference of its angle.
fn torque_of_rod(angle: &[f64], k: usize) -> f64 {
    let acceleration = (angle[k + 1] - 2.0 * angle[k] + angle[k - 1]) * RATE_HZ * RATE_HZ;
    (INERTIA + MASS * CENTRE * CENTRE) * acceleration + MASS * GRAVITY * CENTRE * angle[k].sin()
}

/// `k (theta - q)` is what the rod asks for: a spring of 150 N m/rad twists by up to 20 mrad.
#[test]
fn oracle_an_elastic_drive_of_mujoco_twists_under_what_it_carries() {
    let spring = "[[effect]]\njoint_elasticity = { joint = \"hinge\", stiffness_nm_per_rad = 150.0, \
        damping_nm_s_per_rad = 0.2 }\n";
    let scenario = SCENARIO.replace("position = \"link\"", "position = \"motor\"");
    let Some(hinge) = remade_with(&format!("{scenario}{spring}")) else { return };
    let (motor, link) = (&hinge.position, hinge.link_position.as_ref().unwrap());
    let (mut worst, mut largest) = (0.0_f64, 0.0_f64);
    for k in 1..motor.len() - 1 {
        let [after, before] = [k + 1, k - 1].map(|k| motor[k] - link[k]);
        let carried = 150.0 * (motor[k] - link[k]) + 0.2 * 0.5 * RATE_HZ * (after - before);
        worst = worst.max((carried - torque_of_rod(link, k)).abs());
        largest = largest.max(carried.abs());
    }
    assert!(largest > 2.0 && worst < 1e-3 * largest, "{worst} of {largest} N m");
}

/// The rod lies at one end of the play or at the other, and goes from one to the other.
#[test]
fn oracle_a_backlash_of_mujoco_is_as_wide_as_it_is() {
    let play = "[[effect]]\nbacklash = { joint = \"hinge\", gap_rad = 0.02 }\n";
    let balance = "[[effect]]\ncounterbalance = { joint = \"hinge\", amplitude_nm = 3.0, phase_rad = -0.7 }\n";
    let scenario = SCENARIO.replace("position = \"link\"", "position = \"motor\"");
    let Some(hinge) = remade_with(&format!("{scenario}{play}{balance}")) else { return };
    let link = hinge.link_position.as_ref().unwrap();
    let twist: Vec<f64> =
        hinge.position.iter().zip(link).map(|(motor, link)| motor - link).collect();
    let [least, most] = [f64::min, f64::max].map(|of| twist.iter().copied().fold(0.0, of));
    assert!((least + 0.01).abs() < 2e-4 && (most - 0.01).abs() < 2e-4, "{least} to {most}");
}

/// `tau(t) = command(t - 0.01)`, with a ripple on top.
#[test]
fn oracle_a_late_drive_with_ripple_gives_a_command_of_before() {
    let late = "[[effect]]\nactuator_delay = { joint = \"hinge\", delay_ms = 10.0 }\n";
    let ripple = "[[effect]]\ntorque_ripple = { joint = \"hinge\", amplitude_nm = 0.4, \
        periods_per_turn = 40.0, phase_rad = 0.5 }\n";
    let Some(hinge) = remade_with(&format!("{SCENARIO}{late}{ripple}")) else { return };
    let (q, qd) = (&hinge.position, hinge.velocity.as_ref().unwrap());
    let (mut worst, mut largest) = (0.0_f64, 0.0_f64);
    for k in 11..q.len() - 1 {
        let [speed, angle] = [qd, q].map(|signal| 0.5 * (signal[k] + signal[k + 1]));
        if speed.abs() > 0.05 {
            let acceleration = (qd[k + 1] - qd[k]) * RATE_HZ;
            let rod = (INERTIA + MASS * CENTRE * CENTRE + ROTOR) * acceleration
                + MASS * GRAVITY * CENTRE * angle.sin();
            let friction = DRY * speed.signum() + VISCOUS * speed;
            let torque = rod + friction + 0.4 * (40.0 * angle + 0.5).sin();
            largest = largest.max(torque.abs());
            worst = worst.max((hinge.effort[k - 10] - OFFSET - GAIN * torque).abs());
        }
    }
    assert!(largest > 3.0 && worst < 5e-3 * largest, "{worst} of {largest} N m");
}

#[test]
fn what_is_not_made_is_left_out_and_told() {
    let folder = tempfile::tempdir().unwrap();
    let [store, out] = ["store", "out"].map(|name| folder.path().join(name));
    write_entry(
        &store.join("ab/abcd"),
        &format!("{SCENARIO}[control.servo]\ngoal_rate_hz = 50.0\n"),
    );
    let Some(said) = remade(&store, &out) else { return };
    assert!(said.contains("left out  abcd  its joints are servos"), "{said}");
    assert!(said.contains("0 trials made") && !out.join("ab/abcd").exists(), "{said}");
}
