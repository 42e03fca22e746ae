//! Effects hidden in the simulated arm, another engine with its own laws, and looked for through
//! files: the diagnosis sees the logs and the robot, the test alone opens `truth.json`.

use std::path::Path;

use catalogue::EffectKind;
use checks::arms::{wam, workspace_root};
use diagnosis::{Diagnosis, Outcome, Settings, Silent, Verdict, diagnose};
use document::Document;
use logs::{ReadOptions, Run};
use rayon::prelude::*;
use robot::Robot;
use simulator::Truth;
use simulator::scenario::Scenario;

const RUNS: &str = "run=[\
    { name='a', motion={ sinusoids={ seed=11, terms=3, lowest_hz=0.1, highest_hz=0.5, duration_s=15.0 } } },\
    { name='b', motion={ sinusoids={ seed=12, terms=3, lowest_hz=0.1, highest_hz=0.5, duration_s=15.0 } } }]";

/// Simulates two runs of the WAM with its sensors into a folder.
pub fn simulate(folder: &Path, settings: &[&str]) {
    simulate_runs(folder, &[settings, &[RUNS]].concat());
}

/// The same with runs that the settings say.
pub fn simulate_runs(folder: &Path, settings: &[&str]) {
    let mut document = Document::read(workspace_root().join("scenarios/wam.toml")).unwrap();
    for setting in settings {
        document.set(setting).unwrap();
    }
    let scenario = Scenario::from_document(&document).unwrap();
    let simulation = simulator::simulate(&scenario, &|| {}).unwrap();
    let format = simulator::LogFormat::Parquet;
    simulator::write(folder, &scenario, &simulation, format).unwrap();
}

/// The logs of [`simulate`].
pub fn read(folder: &Path) -> [Run; 2] {
    let options = ReadOptions { map: None, effort: "effort" };
    let read = |name: &str| logs::read_run(&folder.join(name), &wam(), &options).unwrap();
    [read("a.parquet"), read("b.parquet")]
}

fn look(folder: &Path) -> Diagnosis {
    diagnosed(&wam(), &read(folder)).diagnosis
}

/// What a robot gets wrong in such logs.
pub fn diagnosed(robot: &Robot, runs: &[Run]) -> Outcome {
    let settings = Settings { control_rate_hz: Some(500.0), ..Settings::default() };
    diagnose(robot, runs, &settings, &Silent).unwrap()
}

fn truth(folder: &Path) -> Vec<Truth> {
    let text = std::fs::read_to_string(folder.join("truth.json")).unwrap();
    let sealed: serde_json::Value = serde_json::from_str(&text).unwrap();
    serde_json::from_value(sealed["effects"].clone()).unwrap()
}

#[test]
fn blind_an_arm_without_effects_is_consistent() {
    for seed in 1..=2 {
        let folder = tempfile::tempdir().unwrap();
        simulate(folder.path(), &[&format!("seed={seed}")]);
        let diagnosis = look(folder.path());
        assert_eq!(diagnosis.verdict, Verdict::Consistent, "seed {seed}: {:?}", diagnosis.findings);
    }
}

/// The first name is the effect's, at its joint or link; a payload may as well be the last link.
fn check_named(kind: &str, seed: u64) {
    let folder = tempfile::tempdir().unwrap();
    let hidden = format!("hidden={{ count=[1, 1], from=['{kind}'] }}");
    simulate(folder.path(), &[&format!("seed={seed}"), &hidden]);
    let diagnosis = look(folder.path());
    let put_in = &truth(folder.path())[0];
    println!("{put_in:?}");
    let mut findings: Vec<_> = diagnosis.findings.iter().collect();
    findings.sort_by(|a, b| b.share_explained.total_cmp(&a.share_explained));
    let first = findings.first().unwrap_or_else(|| panic!("nothing found of {put_in:?}"));
    println!("{} {:?}", first.at.words(), first.parameters);
    let named = std::iter::once(&first.at).chain(&first.not_separable_from);
    let mut places = named.map(|at| (at.effect, at.joint.clone(), at.link.clone()));
    let expected = (put_in.effect, put_in.joint.clone(), put_in.link.clone());
    assert!(places.any(|place| place == expected), "{} for {put_in:?}", first.at.words());
}

/// What is hidden, with the seed of its draw.
pub const HIDDEN: [(EffectKind, u64); 20] = [
    (EffectKind::CoulombFriction, 1),
    (EffectKind::RotorInertia, 1),
    (EffectKind::TorqueConstant, 1),
    (EffectKind::Payload, 2),
    (EffectKind::InertialParameters, 2),
    (EffectKind::GravityDirection, 2),
    (EffectKind::LoadDependentFriction, 1),
    (EffectKind::EncoderOffset, 1),
    (EffectKind::TransmissionRatio, 1),
    (EffectKind::Backlash, 1),
    (EffectKind::StribeckFriction, 1),
    (EffectKind::PreslidingFriction, 101),
    (EffectKind::PositionDependentFriction, 101),
    (EffectKind::DifferentialCoupling, 1),
    (EffectKind::TorqueRipple, 1),
    (EffectKind::ExternalDisturbance, 1),
    (EffectKind::JointElasticity, 1),
    (EffectKind::TimeSkew, 1),
    // Below 4 ms two runs of 15 s show nothing: another draw.
    (EffectKind::ActuatorDelay, 101),
    (EffectKind::ActuatorLag, 101),
];

#[test]
fn blind_effects_are_named_first() {
    HIDDEN.par_iter().for_each(|(kind, seed)| check_named(kind.name(), *seed));
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
    assert!((viscous.ci95[0]..=viscous.ci95[1]).contains(&2.36), "{viscous:?}");
    assert!((viscous.value / 2.36 - 1.0).abs() < 0.005, "{viscous:?}");
}
