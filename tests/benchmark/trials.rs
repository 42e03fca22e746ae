use std::fs;

use benchmark::{BenchmarkError, Hidden, Judgement, Trial};
use catalogue::EffectKind::{self, ActuatorDelay, CoulombFriction, EncoderOffset, TimeSkew};
use checks::arms::{wam, workspace_root};
use diagnosis::EffectAt;
use experiment::ExperimentError;
use population::TruthSheet;
use robot::Robot;

/// Two short runs in long steps: a trial in a second or two.
pub fn cheap(hidden: Hidden, seed: u64) -> Trial {
    moved(hidden, seed, 0.8)
}

/// The same in a motion up to `highest_hz`.
fn moved(hidden: Hidden, seed: u64, highest_hz: f64) -> Trial {
    let run = |name: &str, seed: u64| {
        let motion = format!("terms=3, lowest_hz=0.2, highest_hz={highest_hz}, duration_s=8.0");
        format!("{{ name='{name}', motion={{ sinusoids={{ seed={seed}, {motion} }} }} }}")
    };
    let settings = [
        &format!("run=[{}, {}]", run("a", 11), run("b", 12)),
        "engine.step_ms=0.5",
        "hidden.torque_share=[0.2, 0.3]",
    ];
    let settings = settings.map(str::to_owned).to_vec();
    let scenario = workspace_root().join("scenarios/demos/no_effects.toml");
    Trial { scenario, hidden, seed, settings, gains: false }
}

/// Names of what is in a folder, sorted.
fn files(folder: &std::path::Path) -> Vec<String> {
    let entries = fs::read_dir(folder).unwrap();
    let mut names: Vec<String> =
        entries.map(|entry| entry.unwrap().file_name().into_string().unwrap()).collect();
    names.sort();
    names
}

fn named(one: &Judgement) -> Vec<String> {
    one.findings.iter().map(|finding| finding.at.words()).collect()
}

/// Seeds and kinds for which the answer is plain: what is tested here is the way through files.
#[test]
fn a_trial_has_the_folder_of_a_population_and_a_clean_one_names_nothing() {
    let root = tempfile::tempdir().unwrap();
    let friction = cheap(Hidden::One(CoulombFriction), 3);
    let folder = friction.folder(root.path());
    assert_eq!(folder, root.path().join("coulomb_friction/3"));
    let one = friction.run(&folder).unwrap();
    assert_eq!(files(&folder), ["logs", "nominal", "sheet.json", "truth"]);
    assert_eq!(files(&folder.join("logs")), ["a.parquet", "b.parquet"]);
    assert_eq!(files(&folder.join("truth")), ["scenario.toml", "truth.json"]);
    // The nominal model is the arm of the scenario, wherever the folder lies.
    let of_scenario = Robot::load(&workspace_root().join("robots/wam7/robot.toml")).unwrap();
    let nominal = Robot::load(&folder.join("nominal/robot.toml")).unwrap();
    assert_eq!((nominal.robot, nominal.control), (of_scenario.robot, of_scenario.control));

    let sheet = TruthSheet::open(&folder).unwrap();
    assert_eq!((sheet.seed, one.seed, sheet.causes.len(), sheet.corner.logs), (3, 3, 1, 2));
    assert_eq!((sheet.corner.joints, sheet.corner.motion.name()), (7, "sinusoids"));
    assert!(sheet.torque_rms.iter().all(|rms| *rms > 0.0));
    assert_eq!(one.causes[0].at.effect, CoulombFriction);
    assert!(one.causes[0].visible() && one.findings[0].at == one.causes[0].at);
    assert_eq!(one.right(), Some(true), "{:?}", named(&one));
    assert!(one.prediction.nominal.is_none(), "no run is held out");

    let clean = cheap(Hidden::Nothing, 1);
    let one = clean.run(&clean.folder(root.path())).unwrap();
    assert!(one.findings.is_empty() && one.causes.is_empty(), "{:?}", named(&one));
    assert_eq!(one.right(), Some(true));
}

/// The same logs, once more without a name for what is in them: it is a stranger to the diagnosis.
#[test]
fn an_effect_that_is_not_looked_for_is_a_stranger_and_not_named() {
    let root = tempfile::tempdir().unwrap();
    let unknown = cheap(Hidden::Unknown(CoulombFriction), 3);
    let one = unknown.run(&unknown.folder(root.path())).unwrap();
    assert!(one.causes.is_empty() && one.hides());
    assert_eq!(one.strangers[0].name, "not looked for: FR02 Coulomb friction");
    assert!(one.strangers[0].joint.is_some());
    let names =
        one.findings.iter().flat_map(|f| std::iter::once(&f.at).chain(&f.not_separable_from));
    let is_it = |at: &EffectAt| at.effect == CoulombFriction;
    assert!(!names.into_iter().any(is_it), "{:?}", named(&one));
    assert_eq!(one.recall().items, 0);
}

/// The last run takes no part in the diagnosis, and its torque is predicted better at the joint: with a friction, with a
/// torque that comes late, which is no function of the state, with an encoder that errs, and with a clock.
#[test]
fn what_naming_an_effect_gains_is_measured_where_it_was_not_looked_for() {
    let root = tempfile::tempdir().unwrap();
    let effects = [
        (CoulombFriction, 3, 0.8),
        (ActuatorDelay, 1, 2.0),
        (EncoderOffset, 1, 0.8),
        (TimeSkew, 1, 0.8),
    ];
    for (kind, seed, highest_hz) in effects {
        let trial = Trial { gains: true, ..moved(Hidden::One(kind), seed, highest_hz) };
        let folder = trial.folder(root.path());
        let one = trial.run(&folder).unwrap();
        assert_eq!(files(&folder.join("held_out")), ["b.parquet"]);
        assert_eq!((one.recall().hits, one.recall().of), (1.0, 1.0), "{:?}", named(&one));
        assert!(one.findings[0].share_explained > 0.5, "{}", kind.name());
        // At the joint of the effect: elsewhere the run shows noise alone.
        let joint = one.causes[0].at.joint.as_ref();
        let joint = joint.map(|name| wam().joint_names().position(|other| other == name).unwrap());
        let [before, after] = [&one.prediction.nominal, &one.prediction.extended].map(|error| {
            let error = error.as_ref().unwrap();
            joint.map_or(error.all, |j| error.joints[j].unwrap())
        });
        let ratio = after / before;
        println!("{}: {ratio:.3} of the error is left", kind.name());
        assert!(ratio < 0.5, "{}: {ratio}", kind.name());
        assert_eq!(one.prediction.worse(), Some(false));
        assert!(one.prediction.worse_than_by_hand().is_some());
        let of_all = Trial { gains: false, ..trial }.run(&folder).unwrap();
        assert_eq!(of_all.prediction.nominal, None);
        assert_ne!(of_all.causes[0].sizes, one.causes[0].sizes, "both runs were diagnosed");
    }
}

/// A truth that was changed since shows that nothing was simulated anew.
#[test]
fn logs_that_are_there_are_used_again_and_those_of_another_trial_are_not() {
    let root = tempfile::tempdir().unwrap();
    let folder = root.path().join("logs");
    let clean = cheap(Hidden::Nothing, 1);
    assert!(clean.run(&folder).unwrap().causes.is_empty());
    let made_up = r#"{"seed": 1, "effects": [{"effect": "payload", "link": "palm", "parameters": {"mass": 1.0}}]}"#;
    fs::write(folder.join("truth/truth.json"), made_up).unwrap();
    // A robot that lies elsewhere does not make it another scenario.
    let scenario = folder.join("truth/scenario.toml");
    let text = fs::read_to_string(&scenario).unwrap();
    let line = text.lines().find(|line| line.starts_with("robot = ")).unwrap();
    fs::write(&scenario, text.replace(line, "robot = \"/elsewhere/robot.toml\"")).unwrap();
    let again = clean.run(&folder).unwrap();
    assert_eq!(again.causes[0].at.effect, EffectKind::Payload);
    assert!(again.findings.is_empty() && again.right() == Some(false));

    let other = cheap(Hidden::Nothing, 2).run(&folder).unwrap();
    assert_eq!((other.seed, other.causes.len()), (2, 0));
    fs::write(folder.join("truth/truth.json"), made_up).unwrap();
    let mut longer = cheap(Hidden::Nothing, 2);
    longer.settings.push("run.0.lead_in_s=0.5".to_owned());
    assert!(longer.run(&folder).unwrap().causes.is_empty());
}

#[test]
fn what_cannot_be_judged_says_what_it_lacks() {
    let folder = tempfile::tempdir().unwrap();
    let file = folder.path().join("file");
    fs::write(&file, "").unwrap();
    let error = cheap(Hidden::Nothing, 1).run(&file).unwrap_err();
    assert!(matches!(&error, BenchmarkError::TrialFolder { path, .. } if *path == file));

    let trial = folder.path().join("trial");
    cheap(Hidden::Nothing, 1).run(&trial).unwrap();
    let truth = trial.join("truth/truth.json");
    for broken in ["{}", "no"] {
        fs::write(&truth, broken).unwrap();
        let error = cheap(Hidden::Nothing, 1).run(&trial).unwrap_err();
        let BenchmarkError::Experiment(error) = error else { panic!("{error}") };
        assert!(matches!(&*error, ExperimentError::UnreadableTruth { path, .. } if *path == truth));
    }
    for log in ["a", "b"] {
        fs::remove_file(trial.join(format!("logs/{log}.parquet"))).unwrap();
    }
    fs::write(&truth, r#"{"seed": 1, "effects": []}"#).unwrap();
    let error = cheap(Hidden::Nothing, 1).run(&trial).unwrap_err();
    assert!(matches!(&error, BenchmarkError::NoLogs { path } if *path == trial.join("logs")));
}
