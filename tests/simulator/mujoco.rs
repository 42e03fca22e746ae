//! The same WAM, controller and motion in MuJoCo, another engine with another integrator.
//!
//! `tests/golden/mujoco_wam7.json` holds its trajectories; where MuJoCo is installed they are
//! computed again.

use std::process::Command;
use std::sync::OnceLock;

use checks::arms::{wam, workspace_root};
use nalgebra::{Matrix3, Vector3};
use robot::{Inertia, Machine, Reading, Robot};
use serde::Deserialize;
use simulator::{Plant, Sensors, Simulator, StepOrder, Stepping};

#[derive(Deserialize)]
struct Golden {
    program: String,
    version: String,
    kp_nm_per_rad: Vec<f64>,
    kd_nm_s_per_rad: Vec<f64>,
    control_period_s: f64,
    reference: Reference,
    sample_period_s: f64,
    cases: std::collections::BTreeMap<String, Case>,
}

#[derive(Deserialize)]
struct Reference {
    q0_rad: Vec<f64>,
    amplitude_rad: Vec<f64>,
    frequency_rad_per_s: Vec<f64>,
}

#[derive(Deserialize)]
struct Case {
    coulomb_nm: Vec<f64>,
    viscous_nm_s_per_rad: Vec<f64>,
    payload: Option<Body>,
    tau_ff_nm: Vec<f64>,
    q_rad: Vec<Vec<f64>>,
    qd_rad_per_s: Vec<Vec<f64>>,
}

#[derive(Deserialize)]
struct Body {
    mass_kg: f64,
    com_m: [f64; 3],
    /// xx xy yy xz yz zz
    inertia_about_com_kg_m2: [f64; 6],
}

/// MuJoCo's own trajectories where it is installed, those of the golden file otherwise.
fn golden() -> &'static Golden {
    static GOLDEN: OnceLock<Golden> = OnceLock::new();
    GOLDEN.get_or_init(|| {
        let folder = workspace_root().join("tests/golden");
        let python = |arguments: &[&str]| Command::new("python3").args(arguments).output();
        let installed = python(&["-c", "import mujoco, numpy"]).is_ok_and(|o| o.status.success());
        let text = if installed {
            let script = folder.join("make_mujoco.py");
            let output = python(&[script.to_str().unwrap(), "--stdout"]).unwrap();
            assert!(output.status.success(), "{}", String::from_utf8_lossy(&output.stderr));
            String::from_utf8(output.stdout).unwrap()
        } else {
            println!("MuJoCo is not installed (pip install mujoco numpy): the golden file is used");
            std::fs::read_to_string(folder.join("mujoco_wam7.json")).unwrap()
        };
        serde_json::from_str(&text).unwrap()
    })
}

fn robot_of(case: &Case) -> Robot {
    let mut plant = Plant::new(wam());
    if let Some(body) = &case.payload {
        let [xx, xy, yy, xz, yz, zz] = body.inertia_about_com_kg_m2;
        let inertia = Inertia {
            mass: body.mass_kg,
            com_in_link: Vector3::from(body.com_m),
            about_com: Matrix3::new(xx, xy, xz, xy, yy, yz, xz, yz, zz),
        };
        plant.attach(6, &inertia);
    }
    for i in 0..7 {
        let actuator = &mut plant.robot.link_mut(i).unwrap().actuator;
        actuator.coulomb_forward = case.coulomb_nm[i];
        actuator.coulomb_backward = case.coulomb_nm[i];
        actuator.viscous = case.viscous_nm_s_per_rad[i];
    }
    plant.robot
}

/// Largest differences of positions (rad) and velocities (rad/s) from MuJoCo's.
fn largest_difference(golden: &Golden, case: &Case, step_s: f64) -> (f64, f64) {
    let period_s = golden.control_period_s;
    let stepping = Stepping {
        step_s,
        steps_per_period: (period_s / step_s).round() as usize,
        stops: false,
        order: StepOrder::First,
    };
    let robot = robot_of(case);
    let mut arm = Simulator::new(&robot, Vec::new(), Sensors::perfect(7), stepping).unwrap();
    let reference = &golden.reference;
    arm.start(&reference.q0_rad);
    let every = (golden.sample_period_s / period_s).round() as usize;
    let mut reading = Reading::zero(7);
    let (mut position, mut velocity) = (0.0_f64, 0.0_f64);
    for tick in 0..=(case.q_rad.len() - 1) * every {
        arm.read(&mut reading).unwrap();
        if tick % every == 0 {
            for i in 0..7 {
                position = position.max((reading.q[i] - case.q_rad[tick / every][i]).abs());
                velocity = velocity.max((reading.qd[i] - case.qd_rad_per_s[tick / every][i]).abs());
            }
        }
        let t = tick as f64 * period_s;
        let tau = |i: usize| {
            let (a, w) = (reference.amplitude_rad[i], reference.frequency_rad_per_s[i]);
            let q_ref = reference.q0_rad[i] + a * (1.0 - (w * t).cos());
            let qd_ref = a * w * (w * t).sin();
            golden.kp_nm_per_rad[i] * (q_ref - reading.q[i])
                + golden.kd_nm_s_per_rad[i] * (qd_ref - reading.qd[i])
                + case.tau_ff_nm[i]
        };
        arm.actuate(&(0..7).map(tau).collect::<Vec<f64>>()).unwrap();
    }
    (position, velocity)
}

/// Bounds in rad over 5 s, joint by joint, at steps of 0.1 ms: what the half-step velocity
/// gives on smooth motion, and what reversals cost.
#[test]
fn oracle_the_wam_moves_as_in_mujoco() {
    let golden = golden();
    println!("{} {}", golden.program, golden.version);
    for (name, case) in &golden.cases {
        let bound = if name == "plain" || name == "viscous" { 1e-4 } else { 5e-4 };
        let (position, velocity) = largest_difference(golden, case, 1e-4);
        println!("{name}: {position:.1e} rad, {velocity:.1e} rad/s");
        assert!(position < bound, "{name}: {position:.2e} rad");
    }
}

/// A step ten times as long is about ten times as far off: the difference is the engine's step,
/// not its equations.
#[test]
fn oracle_the_difference_from_mujoco_falls_with_the_step() {
    let golden = golden();
    let case = &golden.cases["plain"];
    let coarse = largest_difference(golden, case, 1e-3).0;
    let fine = largest_difference(golden, case, 1e-4).0;
    println!("{coarse:.2e} rad at 1 ms, {fine:.2e} rad at 0.1 ms");
    assert!((5.0..20.0).contains(&(coarse / fine)), "{coarse:.2e} and {fine:.2e}");
}
