use std::fs;

use benchmark::{BenchmarkError, Hidden, Trial, judge};
use catalogue::EffectKind::{self, ActuatorDelay, CoulombFriction, EncoderOffset, TimeSkew};
use checks::arms::workspace_root;
use experiment::ExperimentError;
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

/// Seeds and kinds for which the answer is plain: what is tested here is the way through files.
#[test]
fn a_trial_goes_through_files_and_a_clean_one_names_nothing() {
    let root = tempfile::tempdir().unwrap();
    let friction = cheap(Hidden::One(EffectKind::CoulombFriction), 3);
    let folder = friction.folder(root.path());
    assert_eq!(folder, root.path().join("coulomb_friction/3"));
    let score = friction.run(&folder).unwrap();
    let mut files: Vec<_> =
        fs::read_dir(&folder).unwrap().map(|entry| entry.unwrap().file_name()).collect();
    files.sort();
    assert_eq!(files, ["a.parquet", "b.parquet", "scenario.toml", "truth.json"]);
    assert_eq!((score.seed, score.injected.len()), (3, 1));
    assert_eq!(score.injected[0].at.effect, EffectKind::CoulombFriction);
    assert!(score.exactly, "{}", score.words());

    let clean = cheap(Hidden::Nothing, 1);
    let score = clean.run(&clean.folder(root.path())).unwrap();
    assert!(score.exactly && score.injected.is_empty(), "{}", score.words());
}

/// The same logs, once more without a name for what is in them.
#[test]
fn an_effect_that_is_not_looked_for_is_not_named() {
    let root = tempfile::tempdir().unwrap();
    let unknown = cheap(Hidden::Unknown(EffectKind::CoulombFriction), 3);
    let score = unknown.run(&unknown.folder(root.path())).unwrap();
    assert!(!score.looked_for && score.injected[0].at.effect == EffectKind::CoulombFriction);
    let names =
        score.findings.iter().flat_map(|f| std::iter::once(&f.at).chain(&f.not_separable_from));
    assert!(names.clone().all(|at| at.effect != EffectKind::CoulombFriction), "{}", score.words());
    assert!(!score.exactly && !score.is_found());
}

/// The last run takes no part in the diagnosis, and every error at the joint is less on it: of a
/// friction, of a torque that comes late, which is no function of the state, of an encoder that
/// errs, which says itself that it follows, and of a clock, which tracking does not ask.
#[test]
fn what_naming_an_effect_gains_is_measured_where_it_was_not_looked_for() {
    let root = tempfile::tempdir().unwrap();
    // How many times less torque, drift and tracking must be off at least: what noise of the torque
    // moves is left of the drift of a delay. Slow motions do not tell that from a lag.
    let effects = [
        (CoulombFriction, 3, 0.8, [2.0; 3]),
        (ActuatorDelay, 1, 2.0, [2.0, 1.2, 2.0]),
        (EncoderOffset, 1, 0.8, [2.0; 3]),
        (TimeSkew, 1, 0.8, [2.0, 2.0, 0.9]),
    ];
    for (kind, seed, highest_hz, least) in effects {
        let trial = Trial { gains: true, ..moved(Hidden::One(kind), seed, highest_hz) };
        let folder = trial.folder(root.path());
        let score = trial.run(&folder).unwrap();
        assert!(score.exactly && score.explained_share() > 0.5, "{}", score.words());
        let gains = score.gains.unwrap();
        println!("{}: {gains:?}", kind.name());
        let all = [gains.torque, gains.drift, gains.tracking];
        for (gain, least) in all.into_iter().zip(least) {
            assert!(gain.unwrap().times() > least, "{}: {gains:?}", kind.name());
        }
        let of_all = Trial { gains: false, ..trial }.run(&folder).unwrap();
        assert_eq!(of_all.gains, None);
        assert_ne!(of_all.injected[0].sizes, score.injected[0].sizes, "both runs were diagnosed");
    }
}

/// A truth that was changed since shows that nothing was simulated anew.
#[test]
fn logs_that_are_there_are_used_again_and_those_of_another_trial_are_not() {
    let root = tempfile::tempdir().unwrap();
    let folder = root.path().join("logs");
    let clean = cheap(Hidden::Nothing, 1);
    assert!(clean.run(&folder).unwrap().injected.is_empty());
    let made_up = r#"{"seed": 1, "effects": [{"effect": "payload", "link": "palm", "parameters": {"mass": 1.0}}]}"#;
    fs::write(folder.join("truth.json"), made_up).unwrap();
    // A robot that lies elsewhere does not make it another scenario.
    let scenario = folder.join("scenario.toml");
    let text = fs::read_to_string(&scenario).unwrap();
    let line = text.lines().find(|line| line.starts_with("robot = ")).unwrap();
    fs::write(&scenario, text.replace(line, "robot = \"/elsewhere/robot.toml\"")).unwrap();
    let again = clean.run(&folder).unwrap();
    assert_eq!(again.injected[0].at.effect, EffectKind::Payload);
    assert!(again.findings.is_empty() && !again.exactly);

    let other = cheap(Hidden::Nothing, 2).run(&folder).unwrap();
    assert_eq!((other.seed, other.injected.len()), (2, 0));
    fs::write(folder.join("truth.json"), made_up).unwrap();
    let mut longer = cheap(Hidden::Nothing, 2);
    longer.settings.push("run.0.lead_in_s=0.5".to_owned());
    assert!(longer.run(&folder).unwrap().injected.is_empty());
}

#[test]
fn what_cannot_be_scored_says_what_it_lacks() {
    let folder = tempfile::tempdir().unwrap();
    let robot = Robot::load(&workspace_root().join("robots/wam7/robot.toml")).unwrap();
    let none = folder.path().join("none");
    let error = judge(&none, &robot, &[]).unwrap_err();
    assert!(matches!(&error, BenchmarkError::TrialFolder { path, .. } if *path == none));
    let error = judge(folder.path(), &robot, &[]).unwrap_err();
    assert!(matches!(&error, BenchmarkError::NoLogs { path } if *path == folder.path()));

    let file = folder.path().join("file");
    fs::write(&file, "").unwrap();
    let error = cheap(Hidden::Nothing, 1).run(&file).unwrap_err();
    assert!(matches!(&error, BenchmarkError::TrialFolder { path, .. } if *path == file));

    cheap(Hidden::Nothing, 1).run(folder.path()).unwrap();
    let truth = folder.path().join("truth.json");
    for broken in [Some("{}"), Some("no"), None] {
        match broken {
            Some(text) => fs::write(&truth, text).unwrap(),
            None => fs::remove_file(&truth).unwrap(),
        }
        let error = judge(folder.path(), &robot, &[]).unwrap_err();
        let BenchmarkError::Experiment(error) = error else { panic!("{error}") };
        assert!(matches!(&*error, ExperimentError::UnreadableTruth { path, .. } if *path == truth));
    }
}
