//! Effects of stated size in the simulated arm, another engine with its own laws, looked for through
//! files: what went wrong once and must not again.

use std::path::Path;

use catalogue::EffectKind;
use checks::arms::{wam, workspace_root};
use diagnosis::{Diagnosis, DiagnosisRun, Settings, Silent, diagnose};
use document::Document;
use logs::{ReadOptions, Run};
use robot::Robot;
use simulator::scenario::Scenario;

use crate::hidden::STEP;

const RUNS: &str = "run=[\
    { name='a', motion={ sinusoids={ seed=11, terms=3, lowest_hz=0.1, highest_hz=0.5, duration_s=15.0 } } },\
    { name='b', motion={ sinusoids={ seed=12, terms=3, lowest_hz=0.1, highest_hz=0.5, duration_s=15.0 } } }]";

/// Simulates two runs of the WAM with its sensors into a folder.
pub fn simulate(folder: &Path, settings: &[&str]) {
    simulate_runs(folder, &[settings, &[RUNS]].concat());
}

/// The same with runs that the settings say.
pub fn simulate_runs(folder: &Path, settings: &[&str]) {
    let mut document = Document::read(workspace_root().join("scenarios/arms/wam.toml")).unwrap();
    for setting in [&[STEP], settings].concat() {
        document.set(setting).unwrap();
    }
    let scenario = Scenario::from_document(&document).unwrap();
    let simulation = simulator::simulate(&scenario, &|| {}).unwrap();
    let format = simulator::LogFormat::Parquet;
    simulator::write(folder, &scenario, &simulation, format).unwrap();
}

/// The logs of [`simulate`].
pub fn read(folder: &Path) -> [Run; 2] {
    let options = ReadOptions::default();
    let read = |name: &str| logs::read_run(&folder.join(name), &wam(), &options).unwrap();
    [read("a.parquet"), read("b.parquet")]
}

fn look(folder: &Path) -> Diagnosis {
    diagnosed(&wam(), &read(folder)).diagnosis
}

/// What a robot gets wrong in such logs.
pub fn diagnosed(robot: &Robot, runs: &[Run]) -> DiagnosisRun {
    let settings = Settings { control_rate_hz: Some(500.0), ..Settings::default() };
    diagnose(robot, runs, &settings, &Silent).unwrap()
}

/// To first order a large offset moves gravity like a body does; about the robot that has it nothing
/// of the body is left.
#[test]
fn blind_a_large_offset_of_an_encoder_leaves_no_body_beside_it() {
    let folder = tempfile::tempdir().unwrap();
    let offset = "effect=[{ encoder_offset={ joint='j4_elbow_pitch', offset_rad=0.168 } }]";
    simulate(folder.path(), &[offset]);
    let findings = look(folder.path()).findings;
    let names: Vec<String> = findings.iter().map(|f| f.at.words()).collect();
    assert_eq!(names, ["SE01 encoder offset at j4_elbow_pitch"]);
    let offset = &findings[0].parameters[0];
    assert!((offset.value - 0.168).abs() < 0.002, "{offset:?}");
}

/// Logs without noise, as a simulation makes them that has no sensors: an error that is a part in a thousand of the
/// effort has no name, and the friction has one.
#[test]
fn blind_a_log_without_noise_names_what_matters_and_nothing_else() {
    for log_rate_hz in [250, 500] {
        let folder = tempfile::tempdir().unwrap();
        let effect = "effect=[{ coulomb_friction={ joint='j4_elbow_pitch', level_nm=1.5 } }]";
        simulate(folder.path(), &[&format!("sensors={{ log_rate_hz={log_rate_hz} }}"), effect]);
        let findings = look(folder.path()).findings;
        let names: Vec<String> = findings.iter().map(|f| f.at.words()).collect();
        assert_eq!(names, ["FR02 Coulomb friction at j4_elbow_pitch"], "{log_rate_hz} Hz");
        let level = &findings[0].parameters[0];
        assert!((level.value - 1.5).abs() < 0.02, "{log_rate_hz} Hz: {level:?}");
    }
}

/// Rows of 10 ms, and a controller that renews its commands every 2 ms, of which nothing is said: the log has them
/// 4 ms later than it would were they held for a row, and a sentence says which rate that is.
#[test]
fn blind_commands_of_an_unknown_rate_are_told_with_it() {
    let folder = tempfile::tempdir().unwrap();
    simulate(folder.path(), &["sensors={ log_rate_hz=100 }"]);
    let runs = read(folder.path());
    let warned = |settings: &Settings| {
        let answer = diagnose(&wam(), &runs, settings, &Silent).unwrap().diagnosis;
        let names: Vec<String> = answer.findings.iter().map(|f| f.at.words()).collect();
        (names, answer.warnings.join("\n"))
    };
    let (names, warnings) = warned(&Settings::default());
    assert_eq!(names, ["SE02 time skew"]);
    assert!(
        warnings.contains("ms and held: if these efforts are commands, state control_rate_hz"),
        "{warnings}"
    );
    let held = warnings.split("renewed every ").nth(1).and_then(|rest| rest.split(' ').next());
    let held_ms: f64 = held.unwrap().parse().unwrap();
    assert!((held_ms - 2.0).abs() < 0.2, "{warnings}");
    let (names, warnings) =
        warned(&Settings { control_rate_hz: Some(500.0), ..Settings::default() });
    assert_eq!(names, [""; 0]);
    assert!(!warnings.contains("renewed"), "{warnings}");
}

/// A limit is stated, not drawn: most draws of one make the arm run away.
#[test]
fn blind_a_drive_that_ends_at_a_limit_is_named_with_it() {
    let folder = tempfile::tempdir().unwrap();
    let limit = "effect=[{ torque_saturation={ joint='j4_elbow_pitch', limit_nm=5.3 } }]";
    simulate(folder.path(), &[limit]);
    let diagnosis = look(folder.path());
    let finding = &diagnosis.findings[0];
    println!("{} {:?}", finding.at.words(), finding.parameters);
    assert_eq!(finding.at.effect, EffectKind::TorqueSaturation);
    assert_eq!(finding.at.joint.as_deref(), Some("j4_elbow_pitch"));
    assert!((finding.parameters[0].value / 5.3 - 1.0).abs() < 0.05, "{:?}", finding.parameters);
}

/// With an encoder turned by 143 degrees the effort of the palm has nothing to do with what the model
/// expects, and the less of it counts the less is left: no limit does that.
#[test]
fn blind_effort_that_the_model_gets_wrong_is_not_beyond_a_limit() {
    let folder = tempfile::tempdir().unwrap();
    let offset = "effect=[{ encoder_offset={ joint='j7_palm_yaw', offset_rad=2.5 } }]";
    simulate(folder.path(), &[offset]);
    let diagnosis = look(folder.path());
    let names: Vec<String> = diagnosis.findings.iter().map(|f| f.at.words()).collect();
    let limited = diagnosis.findings.iter().any(|f| f.at.effect == EffectKind::TorqueSaturation);
    assert!(!limited, "{names:?}");
}

/// Commands are held for 2 ms, so they act 1 ms later than they are logged. Taken as they stand,
/// the viscous friction of the shoulder comes out 1.5 % small and its interval misses.
#[test]
fn blind_a_held_command_does_not_pass_for_friction() {
    let folder = tempfile::tempdir().unwrap();
    let friction =
        "effect=[{ viscous_friction={ joint='j2_shoulder_pitch', viscous_nm_s_per_rad=2.36 } }]";
    simulate(folder.path(), &[friction]);
    let diagnosis = look(folder.path());
    let finding = &diagnosis.findings[0];
    println!("{} {:?}", finding.at.words(), finding.parameters);
    let viscous = &finding.parameters[0];
    assert!((viscous.noise95[0]..=viscous.noise95[1]).contains(&2.36), "{viscous:?}");
    assert!((viscous.value / 2.36 - 1.0).abs() < 0.005, "{viscous:?}");
}
