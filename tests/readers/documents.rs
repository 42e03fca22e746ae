//! Scenarios, tracking scenarios and campaigns.

use std::path::Path;

use benchmark::{Campaign, CampaignFolder};
use checks::arms::workspace_root;
use document::Document;
use experiment::{Experiment, TrackingScenario};
use simulator::scenario::Scenario;

use super::Reader;
use super::robots::{self, changed_text};

pub fn readers() -> Vec<Reader> {
    let of = |name, seeds, parsed, read| Reader {
        name,
        file: "input.toml",
        short: 800,
        seeds,
        parsed: Some(parsed),
        change: changed_text,
        read,
        parse: read,
        words: robots::TOML,
    };
    vec![
        of("scenario", scenarios, short_scenarios, |path| {
            let document = Document::read(path).map_err(|e| e.to_string())?;
            Scenario::from_document(&document).map(drop).map_err(|e| e.to_string())
        }),
        of("tracking", trackings, short_trackings, |path| {
            let document = Document::read(path).map_err(|e| e.to_string())?;
            Experiment::from_document(&document, None).map(drop).map_err(told)
        }),
        of("campaign", campaigns, campaigns, |path| {
            let document = Document::read(path).map_err(|e| e.to_string())?;
            Campaign::from_document(&document).map(|c| drop(c.hash())).map_err(told)
        }),
    ]
}

/// A mistake in a file that the input names is told with the name of that one.
#[allow(clippy::needless_pass_by_value, reason = "it maps an error")]
fn told(error: impl std::error::Error) -> String {
    error.to_string()
}

fn file(name: &str) -> Document {
    Document::read(workspace_root().join("scenarios").join(name)).unwrap()
}

fn scenarios(_: &Path) -> Vec<Vec<u8>> {
    let resolved =
        |name: &str| Scenario::from_document(&file(name)).unwrap().self_contained_text().into();
    ["demos/no_effects.toml", "demos/hidden_effects.toml", "demos/ur5e.toml"].map(resolved).to_vec()
}

/// At most two runs, of at most ten seconds.
fn shortened(text: &str) -> String {
    let end = text.match_indices("[[run]]").nth(2).map_or(text.len(), |(at, _)| at);
    let lines = text[..end].lines().map(|line| match line.strip_prefix("duration_s = ") {
        Some(seconds) if seconds.parse::<f64>().is_ok_and(|s| s > 10.0) => {
            "duration_s = 10.0\n".to_owned()
        }
        _ => format!("{line}\n"),
    });
    lines.collect()
}

fn short_scenarios(folder: &Path) -> Vec<Vec<u8>> {
    let of = |seed: Vec<u8>| shortened(&String::from_utf8(seed).unwrap()).into_bytes();
    scenarios(folder).into_iter().map(of).collect()
}

/// The plant is short as well.
fn short_trackings(folder: &Path) -> Vec<Vec<u8>> {
    let tracking = TrackingScenario::from_document(&file("tracking/low_gains.toml")).unwrap();
    let plant = Scenario::from_document(&file("tracking/tracked_wam.toml")).unwrap();
    std::fs::write(folder.join("plant.toml"), shortened(plant.self_contained_text())).unwrap();
    let text = shortened(tracking.self_contained_text());
    let (_, rest) =
        text.split_once('\n').filter(|(first, _)| first.starts_with("plant = ")).unwrap();
    vec![format!("plant = \"plant.toml\"\n{rest}").into_bytes()]
}

fn trackings(_: &Path) -> Vec<Vec<u8>> {
    let tracking = TrackingScenario::from_document(&file("tracking/low_gains.toml")).unwrap();
    vec![tracking.self_contained_text().into()]
}

fn campaigns(folder: &Path) -> Vec<Vec<u8>> {
    let of = |name: &str| {
        let campaign = Campaign::from_document(&file(name)).unwrap();
        CampaignFolder::plan(folder, campaign).unwrap();
        std::fs::read(folder.join("campaign.toml")).unwrap()
    };
    vec![of("campaigns/panel.toml"), of("campaigns/trials.toml")]
}
