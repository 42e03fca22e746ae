use std::fs;
use std::path::{Path, PathBuf};

use checks::arms::workspace_root;
use evaluation::{Hidden, Score, Tally, Trial, judge};
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
