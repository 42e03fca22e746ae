//! What a trial of the population is made of, seen through its files.

use std::collections::BTreeMap;
use std::fs;
use std::path::Path;

use document::Document;
use population::{ArmClass, CauseRole, MotionClass, PopulationSpec, RobotShares, TruthSheet, make};
use rayon::ThreadPoolBuilder;
use simulator::scenario::Scenario;
use simulator::simulate_noise_free;

/// Short trials of one class.
pub fn short(class: ArmClass, causes: [usize; 2]) -> PopulationSpec {
    PopulationSpec {
        trials: 1,
        seed: 0,
        arms: vec![class],
        motions: MotionClass::ALL.to_vec(),
        logs: [1, 2],
        log_s: [5.0, 6.0],
        longest_s: 12.0,
        causes,
        strangers: 0.5,
        clean: 0.0,
        spoilt: 0.0,
        robots: RobotShares::default(),
        instruments: None,
        log_kinds: BTreeMap::new(),
        servos: None,
        recorded: None,
    }
}

/// Every file below a folder.
pub fn files(folder: &Path) -> BTreeMap<String, Vec<u8>> {
    let mut all = BTreeMap::new();
    let mut folders = vec![folder.to_owned()];
    while let Some(next) = folders.pop() {
        for entry in fs::read_dir(next).unwrap() {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else {
                let name = path.strip_prefix(folder).unwrap().display().to_string();
                all.insert(name, fs::read(path).unwrap());
            }
        }
    }
    all
}

#[test]
fn a_seed_gives_the_same_files_on_any_number_of_threads() {
    let spec = short(ArmClass::Hobby, [2, 2]);
    let made = |threads: usize| {
        let folder = tempfile::tempdir().unwrap();
        let pool = ThreadPoolBuilder::new().num_threads(threads).build().unwrap();
        pool.install(|| make(&spec, 7, folder.path())).unwrap();
        files(folder.path())
    };
    let (alone, together) = (made(1), made(3));
    assert_eq!(alone.keys().collect::<Vec<_>>(), together.keys().collect::<Vec<_>>());
    for (name, bytes) in &alone {
        assert!(together[name] == *bytes, "{name} differs");
    }
}

#[test]
fn a_diagnosis_is_given_no_word_of_what_is_true() {
    let folder = tempfile::tempdir().unwrap();
    make(&short(ArmClass::Cobot, [3, 3]), 3, folder.path()).unwrap();
    let all = files(folder.path());
    let given: Vec<&str> = all
        .keys()
        .filter(|name| name.starts_with("nominal/") || name.starts_with("logs/"))
        .map(String::as_str)
        .collect();
    assert!(given.contains(&"nominal/robot.toml") && given.len() >= 3, "{given:?}");
    let nominal = String::from_utf8(all["nominal/robot.toml"].clone()).unwrap();
    let truth = String::from_utf8(all["truth/robot.toml"].clone()).unwrap();
    let urdfs = [&all["nominal/robot.urdf"], &all["truth/robot.urdf"]];
    assert!(nominal != truth || urdfs[0] != urdfs[1], "the nominal model is the truth");
}

/// The arm as it is, simulated again in steps of a tenth, goes the same way to a tenth of the encoder's step: once a
/// class.
#[test]
fn a_step_of_the_simulation_is_a_tenth_of_the_encoders() {
    for (class, seed) in ArmClass::ALL.iter().zip(31..) {
        let folder = tempfile::tempdir().unwrap();
        let sheet = make(&short(*class, [0, 0]), seed, folder.path()).unwrap();
        let file = folder.path().join("truth/scenario.toml");
        let moved = |step: Option<f64>| {
            let mut document = Document::read(&file).unwrap();
            if let Some(step) = step {
                document.set(&format!("engine.step_ms={step}")).unwrap();
            }
            let scenario = Scenario::from_document(&document).unwrap();
            let first = scenario.runs()[0].name.clone();
            let (effects, step) = (scenario.effects().to_vec(), scenario.spec().engine.step_ms);
            let runs =
                simulate_noise_free(&scenario, &|name| name == first, &effects, &[]).unwrap();
            (runs[0].clone(), step)
        };
        let (coarse, step) = moved(None);
        let (fine, _) = moved(Some(0.1 * step));
        let far = coarse.joints.iter().zip(&fine.joints).map(|(a, b)| {
            a.position.iter().zip(&b.position).map(|(a, b)| (a - b).abs()).fold(0.0, f64::max)
        });
        let far = far.fold(0.0, f64::max);
        let counts = far / sheet.corner.encoder_step;
        println!("{class}: {step} ms, {far:.1e} rad, {counts:.3} steps of the encoder");
        assert!(counts < 0.1, "{class}: {counts} steps of the encoder in steps of {step} ms");
    }
}

/// Friction is at every joint; what the drive's sensor cannot see of it has no strength.
#[test]
fn friction_is_everywhere_and_as_strong_as_its_sensor_shows() {
    for (class, seed) in [(ArmClass::Hobby, 5), (ArmClass::Industrial, 6)] {
        let folder = tempfile::tempdir().unwrap();
        let sheet = make(&short(class, [0, 0]), seed, folder.path()).unwrap();
        assert_eq!(sheet, TruthSheet::open(folder.path()).unwrap());
        let background: Vec<_> =
            sheet.causes.iter().filter(|c| c.role == CauseRole::Background).collect();
        assert_eq!(background.len(), 2 * sheet.joints.len(), "{class}");
        for cause in background {
            let level = cause.truth.parameters.values().next().unwrap().abs();
            let joint = cause.truth.joint.as_deref().unwrap();
            let index = sheet.joints.iter().position(|name| name == joint).unwrap();
            if cause.truth.parameters.contains_key("level") {
                let most = level / sheet.torque_rms[index];
                let seen = cause.strength.torque;
                assert!(seen <= 1.001 * most, "{joint}: {seen} of the torque, at most {most}");
            }
            assert!(cause.strength.share <= cause.strength.torque + 1e-9, "{joint}");
        }
    }
}
