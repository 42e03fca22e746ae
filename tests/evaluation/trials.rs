use std::fs;
use std::path::{Path, PathBuf};

use catalogue::EffectKind;
use checks::arms::workspace_root;
use evaluation::{EvaluationError, Hidden, Score, Tally, Trial, judge};
use rayon::prelude::*;
use robot::Robot;

/// A comma-separated list of an environment variable.
fn list(variable: &str) -> Vec<String> {
    let text = std::env::var(variable).unwrap_or_default();
    text.split(',').map(str::trim).filter(|word| !word.is_empty()).map(str::to_owned).collect()
}

/// Folders with a sealed truth, `KIND/SEED` below `root`, by name.
fn sealed(root: &Path) -> Vec<PathBuf> {
    let folders = |folder: &Path| -> Vec<PathBuf> {
        let entries = fs::read_dir(folder).unwrap().map(|entry| entry.unwrap().path());
        entries.filter(|path| path.is_dir()).collect()
    };
    let mut sealed: Vec<PathBuf> = folders(root).iter().flat_map(|kind| folders(kind)).collect();
    sealed.retain(|folder| folder.join("truth.json").is_file());
    sealed.sort();
    sealed
}

/// Whether a folder is one of these kinds and seeds, none being all.
fn wanted(folder: &Path, kinds: &[String], seeds: &[String]) -> bool {
    let named = |path: &Path, names: &[String]| {
        names.is_empty() || names.iter().any(|name| path.file_name().unwrap() == name.as_str())
    };
    named(folder, seeds) && named(folder.parent().unwrap(), kinds)
}

/// Scores every trial whose logs lie in the folder PLUMBLINE_TRIALS. With PLUMBLINE_KINDS and
/// PLUMBLINE_SEEDS both (such as `clean,backlash` and `1,2,3`) those are simulated where they are
/// not there; with one of them, it limits what is scored.
#[test]
fn trials_of_a_folder_are_scored() {
    let Some(root) = std::env::var_os("PLUMBLINE_TRIALS").map(PathBuf::from) else {
        println!("skipped: set PLUMBLINE_TRIALS to a folder of trials, KIND/SEED/*.parquet");
        return;
    };
    let (kinds, seeds) = (list("PLUMBLINE_KINDS"), list("PLUMBLINE_SEEDS"));
    let told = |score: Score| {
        println!("{} {}", if score.exactly { "+" } else { "-" }, score.words());
        score
    };
    let scores: Vec<Score> = if kinds.is_empty() || seeds.is_empty() {
        let robot = Robot::load(&workspace_root().join("robots/wam7/robot.toml")).unwrap();
        let folders = sealed(&root).into_iter().filter(|folder| wanted(folder, &kinds, &seeds));
        let folders: Vec<PathBuf> = folders.collect();
        folders.par_iter().map(|folder| told(judge(folder, &robot).unwrap())).collect()
    } else {
        let scenario = workspace_root().join("scenarios/clean.toml");
        let trial = |kind: &str, seed: &str| Trial {
            scenario: scenario.clone(),
            hidden: kind.parse::<Hidden>().unwrap(),
            seed: seed.parse().unwrap(),
            settings: Vec::new(),
        };
        let trials: Vec<Trial> =
            seeds.iter().flat_map(|seed| kinds.iter().map(|kind| trial(kind, seed))).collect();
        trials.par_iter().map(|trial| told(trial.run(&trial.folder(&root)).unwrap())).collect()
    };
    println!("\n{}", Tally::of(&scores).text());
    assert!(!scores.is_empty(), "{}: no trial is there", root.display());
}

/// Two short runs in long steps: a trial in a second or two.
fn cheap(hidden: Hidden, seed: u64) -> Trial {
    let run = |name: &str, seed: u64| {
        let motion = "terms=3, lowest_hz=0.2, highest_hz=0.8, duration_s=8.0";
        format!("{{ name='{name}', motion={{ sinusoids={{ seed={seed}, {motion} }} }} }}")
    };
    let mut settings =
        vec![format!("run=[{}, {}]", run("a", 11), run("b", 12)), "engine.step_ms=0.5".to_owned()];
    if hidden != Hidden::Nothing {
        settings.push("hidden.torque_share=[0.2, 0.3]".to_owned());
    }
    Trial { scenario: workspace_root().join("scenarios/clean.toml"), hidden, seed, settings }
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
    assert_eq!((score.seed, score.put_in.len()), (3, 1));
    assert_eq!(score.put_in[0].at.effect, EffectKind::CoulombFriction);
    assert!(score.exactly, "{}", score.words());

    let clean = cheap(Hidden::Nothing, 1);
    let score = clean.run(&clean.folder(root.path())).unwrap();
    assert!(score.exactly && score.put_in.is_empty(), "{}", score.words());
    assert_eq!(sealed(root.path()), [root.path().join("clean/1"), folder]);
}

/// A truth that was changed since shows that nothing was simulated anew.
#[test]
fn logs_that_are_there_are_used_again_and_those_of_another_trial_are_not() {
    let root = tempfile::tempdir().unwrap();
    let folder = root.path().join("logs");
    let clean = cheap(Hidden::Nothing, 1);
    assert!(clean.run(&folder).unwrap().put_in.is_empty());
    let made_up = r#"{"seed": 1, "effects": [{"effect": "payload", "link": "palm", "parameters": {"mass": 1.0}}]}"#;
    fs::write(folder.join("truth.json"), made_up).unwrap();
    // A robot that lies elsewhere does not make it another scenario.
    let scenario = folder.join("scenario.toml");
    let text = fs::read_to_string(&scenario).unwrap();
    let line = text.lines().find(|line| line.starts_with("robot = ")).unwrap();
    fs::write(&scenario, text.replace(line, "robot = \"/elsewhere/robot.toml\"")).unwrap();
    let again = clean.run(&folder).unwrap();
    assert_eq!(again.put_in[0].at.effect, EffectKind::Payload);
    assert!(again.findings.is_empty() && !again.exactly);

    let other = cheap(Hidden::Nothing, 2).run(&folder).unwrap();
    assert_eq!((other.seed, other.put_in.len()), (2, 0));
    fs::write(folder.join("truth.json"), made_up).unwrap();
    let mut longer = cheap(Hidden::Nothing, 2);
    longer.settings.push("run.0.lead_in_s=0.5".to_owned());
    assert!(longer.run(&folder).unwrap().put_in.is_empty());
}

#[test]
fn what_cannot_be_scored_says_what_it_lacks() {
    let folder = tempfile::tempdir().unwrap();
    let robot = Robot::load(&workspace_root().join("robots/wam7/robot.toml")).unwrap();
    let none = folder.path().join("none");
    let error = judge(&none, &robot).unwrap_err();
    assert!(matches!(&error, EvaluationError::TrialFolder { path, .. } if *path == none));
    let error = judge(folder.path(), &robot).unwrap_err();
    assert!(matches!(&error, EvaluationError::NoLogs { path } if *path == folder.path()));

    let file = folder.path().join("file");
    fs::write(&file, "").unwrap();
    let error = cheap(Hidden::Nothing, 1).run(&file).unwrap_err();
    assert!(matches!(&error, EvaluationError::TrialFolder { path, .. } if *path == file));

    cheap(Hidden::Nothing, 1).run(folder.path()).unwrap();
    let truth = folder.path().join("truth.json");
    for broken in [Some("{}"), Some("no"), None] {
        match broken {
            Some(text) => fs::write(&truth, text).unwrap(),
            None => fs::remove_file(&truth).unwrap(),
        }
        let error = judge(folder.path(), &robot).unwrap_err();
        assert!(matches!(&error, EvaluationError::UnreadableTruth { path, .. } if *path == truth));
    }
}
