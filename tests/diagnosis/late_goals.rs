//! Servos that log goals and positions alone, and follow their goals late.

use std::path::Path;

use catalogue::EffectKind;
use checks::arms::workspace_root;
use diagnosis::{Diagnosis, Settings, Silent, diagnose};
use document::Document;
use logs::{Channel, ReadOptions, Run, read_run, write_parquet};
use robot::{PdGain, Robot, TorqueSource};
use simulator::scenario::Scenario;

use crate::world::named;

/// Gains of robots/so101/robot.toml, with which the arm is simulated.
const KP: [f64; 6] = [20.0, 43.0, 22.0, 10.0, 10.0, 10.0];
const KD: [f64; 6] = [1.7, 2.4, 1.4, 0.88, 0.85, 0.85];

/// Three runs of the simulated SO-101, whose servos get a goal so many times a second.
fn simulated(goal_hz: f64, log_hz: f64, effects: &[&str]) -> Vec<Run> {
    let mut document = Document::read(workspace_root().join("scenarios/arms/so101.toml")).unwrap();
    let motion = |k: u32| {
        format!(
            "{{ name=\"run_{k}\", motion={{ sinusoids={{ seed={k}, terms=4, lowest_hz=0.1, highest_hz=0.6, duration_s=12.0 }} }} }}"
        )
    };
    for setting in [
        "seed=1".to_owned(),
        format!("control.servo={{ goal_rate_hz={goal_hz:?} }}"),
        format!("sensors.log_rate_hz={log_hz:?}"),
        "sensors.velocity=\"ideal\"".to_owned(),
        format!("effect=[{}]", effects.join(", ")),
        format!("run=[{}, {}, {}]", motion(1), motion(2), motion(3)),
    ] {
        document.set(&setting).unwrap();
    }
    let scenario = Scenario::from_document(&document).unwrap();
    simulator::simulate(&scenario, &|| {}).unwrap().runs
}

/// The SO-101 with the gains of its servos, which hold goals for so long.
fn servos(goal_hold_s: Option<f64>) -> Robot {
    let path = workspace_root().join("robots/so101/robot.toml");
    let mut robot = Robot::load(&path).unwrap().robot;
    for (j, (kp, kd)) in KP.into_iter().zip(KD).enumerate() {
        let drive = &mut robot.link_mut(j).unwrap().actuator;
        drive.position_loop = Some(PdGain { kp, kd });
        (drive.torque_source, drive.goal_hold_s) = (TorqueSource::Commanded, goal_hold_s);
    }
    robot
}

/// The runs as a logger of goals and positions writes them.
fn through_files(folder: &Path, robot: &Robot, runs: Vec<Run>) -> Vec<Run> {
    let write = |mut run: Run| {
        for joint in std::mem::take(&mut run.joints) {
            for channel in [Channel::Position, Channel::DesiredPosition] {
                let column = format!("{}.{}", joint.name, channel.suffix());
                run.extra.insert(column, joint.get(channel).unwrap().to_vec());
            }
        }
        let path = folder.join(format!("{}.parquet", run.name));
        write_parquet(&path, &run).unwrap();
        read_run(&path, robot, &ReadOptions::default()).unwrap()
    };
    runs.into_iter().map(write).collect()
}

fn diagnosed(robot: &Robot, runs: Vec<Run>) -> Diagnosis {
    let folder = tempfile::tempdir().unwrap();
    let runs = through_files(folder.path(), robot, runs);
    let settings = Settings { control_rate_hz: Some(500.0), ..Settings::default() };
    let answer = diagnose(robot, &runs, &settings, &Silent).unwrap().diagnosis;
    for finding in &answer.findings {
        println!("{} {:?}", finding.at.words(), finding.parameters);
    }
    answer
}

const FRICTION: &str = "{ coulomb_friction={ joint='elbow_flex', level_nm=0.3 } }";

/// Goals once a row or in a staircase of several rows: the delay is the same, beside the time for which goals are held.
#[test]
fn blind_goals_that_come_late_are_named_with_their_delay() {
    for (goal_hz, log_hz, delay_ms) in
        [(50.0, 50.0, 40.0), (100.0, 100.0, 20.0), (50.0, 500.0, 30.0)]
    {
        let of = format!("{goal_hz} Hz in {log_hz} Hz");
        let late = format!("{{ goal_delay={{ delay_ms={delay_ms:?} }} }}");
        let answer =
            diagnosed(&servos(Some(1.0 / goal_hz)), simulated(goal_hz, log_hz, &[FRICTION, &late]));
        let mut names = named(&answer);
        names.sort();
        assert_eq!(names, ["DR07 goal delay", "FR02 Coulomb friction at elbow_flex"], "{of}");
        let kind = |kind| answer.findings.iter().find(|f| f.at.effect == kind).unwrap();
        let delay = &kind(EffectKind::GoalDelay).parameters[0];
        assert!((1e3 * delay.value - delay_ms).abs() < 1.0, "{of}: {delay:?}");
        assert!((delay.ci95[0]..=delay.ci95[1]).contains(&(1e-3 * delay_ms)), "{of}: {delay:?}");
        let level = &kind(EffectKind::CoulombFriction).parameters[0];
        assert!((level.value / 0.3 - 1.0).abs() < 0.05, "{of}: {level:?}");
    }
}

/// Goals that are as early as described, and such whose delay the description has.
#[test]
fn blind_goals_on_time_are_not_called_late() {
    let late = "{ goal_delay={ delay_ms=30.0 } }";
    for (effects, described_s) in [(vec![FRICTION], 0.0), (vec![FRICTION, late], 0.03)] {
        let mut robot = servos(Some(0.01));
        for j in 0..robot.joint_count() {
            robot.link_mut(j).unwrap().actuator.goal_delay_s = described_s;
        }
        let names = named(&diagnosed(&robot, simulated(100.0, 100.0, &effects)));
        assert!(names.contains(&"FR02 Coulomb friction at elbow_flex".to_owned()), "{names:?}");
        assert!(!names.iter().any(|name| name.contains("goal")), "{described_s} s: {names:?}");
    }
}

/// Where nothing is said of the hold, half a row is part of the delay, and a sentence takes it apart.
#[test]
fn blind_the_hold_of_goals_is_told_beside_their_delay() {
    let late = "{ goal_delay={ delay_ms=20.0 } }";
    let answer = diagnosed(&servos(None), simulated(100.0, 100.0, &[FRICTION, late]));
    let is_delay = |f: &&diagnosis::Finding| f.at.effect == EffectKind::GoalDelay;
    let delay = &answer.findings.iter().find(is_delay).unwrap().parameters[0];
    assert!((1e3 * delay.value - 25.0).abs() < 1.0, "{delay:?}");
    let told = answer.warnings.iter().find(|w| w.contains("goal_hold_hz")).unwrap();
    let parts: Vec<f64> = told.split(' ').filter_map(|word| word.parse().ok()).collect();
    assert!((parts[1] - 5.0).abs() < 0.01 && (parts[2] - 20.0).abs() < 1.0, "{told}");
}
