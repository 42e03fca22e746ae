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
    let of = |name, seeds, read| Reader {
        name,
        file: "input.toml",
        short: 800,
        seeds,
        change: changed_text,
        read,
        parse: read,
        words: robots::TOML,
    };
    vec![
        of("scenario", scenarios, |path| {
            let document = Document::read(path).map_err(|e| e.to_string())?;
            Scenario::from_document(&document).map(drop).map_err(|e| e.to_string())
        }),
        of("tracking", trackings, |path| {
            let document = Document::read(path).map_err(|e| e.to_string())?;
            Experiment::from_document(&document, None).map(drop).map_err(told)
        }),
        of("campaign", campaigns, |path| {
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
