//! The campaigns and figures of the repository, and the schemas beside them.

use std::fs;
use std::path::{Path, PathBuf};

use benchmark::{Campaign, FigureScenario, FigureSpec, LearningFigure, PredictionTimeFigure};
use document::Document;

use crate::program::run;

fn workspace() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../..")
}

#[test]
fn the_schemas_beside_the_scenarios_are_those_of_the_program() {
    let kinds = [
        ("campaign", "trials", ["torque_ripple", "seeds"]),
        ("figure", "figure", ["prediction_time", "test_points"]),
    ];
    for (kind, name, words) in kinds {
        let answer = run(&workspace(), &["schema", kind]);
        let file = format!("scenarios/schemas/{name}.schema.json");
        let stale =
            format!("stale: cargo run --release -p plumbline-bench -- schema {kind} > {file}");
        assert!(fs::read_to_string(workspace().join(&file)).unwrap() == answer.out, "{stale}");
        for expected in words.iter().chain(&["extends"]) {
            assert!(answer.out.contains(&format!("\"{expected}\"")), "{expected} is missing");
        }
        assert!(!answer.out.contains("\n  \"required\""), "what is extended may say it");
    }
}

/// Files in TOML below a folder.
fn below(folder: &Path, found: &mut Vec<PathBuf>) {
    for entry in fs::read_dir(folder).unwrap() {
        let path = entry.unwrap().path();
        if path.is_dir() {
            below(&path, found);
        } else if path.extension().is_some_and(|e| e == "toml") {
            found.push(path);
        }
    }
}

#[test]
fn every_campaign_and_every_figure_is_accepted() {
    let mut found = Vec::new();
    below(&workspace().join("scenarios"), &mut found);
    let (mut campaigns, mut figures) = (0, 0);
    for path in &found {
        let text = fs::read_to_string(path).unwrap();
        let first = text.lines().next().unwrap();
        let document = Document::read(path).unwrap();
        if first.ends_with("trials.schema.json") {
            let campaign = Campaign::from_document(&document);
            assert!(campaign.is_ok(), "{}: {}", path.display(), campaign.err().unwrap());
            campaigns += 1;
        }
        if first.ends_with("figure.schema.json") {
            let figure = match document.parse::<FigureScenario>().unwrap().figure {
                FigureSpec::PredictionTime(_) => {
                    PredictionTimeFigure::from_document(&document, None).map(drop)
                }
                FigureSpec::Learning(_) => LearningFigure::from_document(&document, None).map(drop),
            };
            assert!(figure.is_ok(), "{}: {}", path.display(), figure.err().unwrap());
            figures += 1;
        }
    }
    assert!(campaigns > 0 && figures > 0, "{campaigns} {figures}");
}
