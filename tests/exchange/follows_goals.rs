//! MuJoCo's position actuators follow the goals of a held-out log as the extended robot does; where MuJoCo is not
//! installed this test says so.

use std::path::Path;

use checks::arms::workspace_root;
use diagnosis::{Settings, Silent, diagnose};
use document::Document;
use exchange::{Format, export};
use logs::{Channel, ReadOptions, Run, read_run, write_parquet};
use robot::{Loaded, PdGain, Robot, TorqueSource};
use simulator::scenario::Scenario;

use crate::python::{ask, has_mujoco};

/// Gains of robots/so101/robot.toml, with which the arm is simulated.
const KP: [f64; 6] = [20.0, 43.0, 22.0, 10.0, 10.0, 10.0];
const KD: [f64; 6] = [1.7, 2.4, 1.4, 0.88, 0.85, 0.85];

/// Period of the servos' loop (s).
const PERIOD_S: f64 = 0.002;

/// Largest error of MuJoCo over that of the extended robot; it was 1.004.
const AS_GOOD: f64 = 1.1;

/// Positions at each row of goals that are held from row to row, from rest at the first ones.
///
/// A step is a period of the servos, whose torque is held as long, as the file says. RK4, as the file says: the velocity of
/// MuJoCo's Euler is half a step late, which takes kd dt / 2 off the inertia (with it the error is 1.18 times that of the
/// extended robot).
const SCRIPT: &str = "
import json, sys, mujoco, numpy
question = json.load(sys.stdin)
model = mujoco.MjModel.from_xml_string(question['model'])
assert model.opt.timestep == question['period_s'], model.opt.timestep
data = mujoco.MjData(model)
names, goals = question['joints'], numpy.array(question['goals'])
q = [model.joint(name).qposadr[0] for name in names]
qd = [model.joint(name).dofadr[0] for name in names]
actuators = [model.actuator(name).id for name in names]
data.qpos[q], data.qvel[qd] = question['q'], question['qd']
for actuator, goal in zip(actuators, goals[0]):
    samples = model.actuator_history[actuator][0]
    if samples:
        mujoco.mj_initCtrlHistory(model, data, actuator, None, numpy.full(samples, goal))
answer = []
for goal in goals:
    answer.append(list(data.qpos[q]))
    data.ctrl[actuators] = goal
    for _ in range(round(question['steps'])):
        mujoco.mj_step(model, data)
json.dump(answer, sys.stdout)
";

/// Four runs of the SO-101, whose servos get a goal 100 times a second and follow it late.
fn simulated(delay_s: f64, level_nm: f64, more: &[&str]) -> Vec<Run> {
    let mut document = Document::read(workspace_root().join("scenarios/arms/so101.toml")).unwrap();
    let motion = |k: u32| {
        format!(
            "{{ name=\"run_{k}\", motion={{ sinusoids={{ seed={k}, terms=4, lowest_hz=0.1, highest_hz=0.6, duration_s=12.0 }} }} }}"
        )
    };
    let effects = format!(
        "effect=[{{ coulomb_friction={{ joint='elbow_flex', level_nm={level_nm:?} }} }}, {{ goal_delay={{ delay_ms={:?} }} }}]",
        1e3 * delay_s
    );
    let runs: Vec<String> = (11..15).map(motion).collect();
    for setting in [
        "seed=1",
        "control.servo={ goal_rate_hz=100.0 }",
        "sensors.log_rate_hz=100.0",
        "sensors.velocity=\"ideal\"",
        &effects,
        &format!("run=[{}]", runs.join(", ")),
    ]
    .iter()
    .chain(more)
    {
        document.set(setting).unwrap();
    }
    let scenario = Scenario::from_document(&document).unwrap();
    simulator::simulate(&scenario, &|| {}).unwrap().runs
}

/// The SO-101 with its position loops.
fn servos() -> Loaded {
    let mut loaded = Robot::load(&workspace_root().join("robots/so101/robot.toml")).unwrap();
    for (j, (kp, kd)) in KP.into_iter().zip(KD).enumerate() {
        let drive = &mut loaded.robot.link_mut(j).unwrap().actuator;
        drive.position_loop = Some(PdGain { kp, kd });
        (drive.torque_source, drive.goal_hold_s) = (TorqueSource::Commanded, Some(0.01));
    }
    loaded
}

/// The run as a logger of goals and positions writes it.
fn through_file(folder: &Path, robot: &Robot, mut run: Run) -> Run {
    for joint in std::mem::take(&mut run.joints) {
        for channel in [Channel::Position, Channel::DesiredPosition] {
            let column = format!("{}.{}", joint.name, channel.suffix());
            run.extra.insert(column, joint.get(channel).unwrap().to_vec());
        }
    }
    let path = folder.join(format!("{}.parquet", run.name));
    write_parquet(&path, &run).unwrap();
    read_run(&path, robot, &ReadOptions::default()).unwrap()
}

/// A channel of all joints, a row a sample.
fn rows(run: &Run, channel: Channel) -> Vec<Vec<f64>> {
    let of = |k: usize| run.joints.iter().map(|joint| joint.get(channel).unwrap()[k]).collect();
    (0..run.time.len()).map(of).collect()
}

/// Root of the mean over rows of the squared distance over all joints (rad).
fn apart(a: &[Vec<f64>], b: &[Vec<f64>]) -> f64 {
    let pairs = a.iter().flatten().zip(b.iter().flatten());
    (pairs.map(|(a, b)| (a - b).powi(2)).sum::<f64>() / a.len() as f64).sqrt()
}

/// Positions that MuJoCo has at each row of goals, of the MJCF of a robot that starts with this position and velocity.
fn followed(robot: &Loaded, goals: &[Vec<f64>], [q, qd]: &[Vec<f64>; 2]) -> Vec<Vec<f64>> {
    let source = std::fs::read_to_string(&robot.urdf_path).unwrap();
    let model = export(robot, &source, Format::Mjcf).unwrap().text;
    let question = serde_json::json!({
        "model": model,
        "period_s": PERIOD_S,
        "steps": 0.01 / PERIOD_S,
        "joints": robot.robot.joint_names().collect::<Vec<_>>(),
        "goals": goals,
        "q": q,
        "qd": qd,
    });
    let answer = ask(SCRIPT, &question, &format!("MuJoCo refuses\n{model}"));
    serde_json::from_str(&answer).unwrap()
}

#[test]
fn oracle_position_actuators_of_mujoco_follow_the_goals_of_a_held_out_log() {
    if !has_mujoco() {
        return;
    }
    let folder = tempfile::tempdir().unwrap();
    let loaded = servos();
    let truth = simulated(0.02, 0.3, &[]);
    let read = |run: &Run| through_file(folder.path(), &loaded.robot, run.clone());
    let settings = Settings { control_rate_hz: Some(1.0 / PERIOD_S), ..Settings::default() };
    let seen: Vec<Run> = truth[..3].iter().map(read).collect();
    let extended = diagnose(&loaded.robot, &seen, &settings, &Silent).unwrap().extended;
    let elbow = &extended.links()[2].actuator;
    let (delay_s, level_nm) = (elbow.goal_delay_s, elbow.coulomb_forward);
    println!("found: {:.3} ms, {level_nm:.4} N m", 1e3 * delay_s);

    // The extended robot in the simulator of the log, which has ideal encoders here and begins goals with a period.
    let ideal: Vec<String> =
        loaded.robot.joint_names().map(|name| format!("{name}=1e-9")).collect();
    let ideal = format!("sensors.position_resolution_rad={{ {} }}", ideal.join(", "));
    let in_periods_s = (delay_s / PERIOD_S).round() * PERIOD_S;
    let own = &simulated(in_periods_s, level_nm, &[&ideal])[3];
    let measured = rows(&truth[3], Channel::Position);
    let own_error = apart(&rows(own, Channel::Position), &measured);

    let mut robot = Loaded { robot: extended, ..loaded };
    let goals = rows(&truth[3], Channel::DesiredPosition);
    let start = [Channel::Position, Channel::Velocity].map(|channel| rows(own, channel).remove(0));
    let error = apart(&followed(&robot, &goals, &start), &measured);
    println!("MuJoCo {:.4} mrad, extended robot {:.4} mrad", 1e3 * error, 1e3 * own_error);
    assert!(error < AS_GOOD * own_error, "{error} rad, the extended robot {own_error} rad");

    // What the test can tell: goals that are not late are followed much worse.
    for j in 0..robot.robot.joint_count() {
        robot.robot.link_mut(j).unwrap().actuator.goal_delay_s = 0.0;
    }
    let without = apart(&followed(&robot, &goals, &start), &measured);
    println!("without the delay {:.4} mrad", 1e3 * without);
    assert!(without > 10.0 * own_error, "{without} rad");
}
