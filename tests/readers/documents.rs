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
        of("campaign", campaigns, short_campaigns, |path| {
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

/// Motions of so many seconds say as much as longer ones.
const SHORT_S: f64 = 4.0;

/// At most two runs, of at most [`SHORT_S`], of a robot without pictures.
fn shortened(text: &str, folder: &Path) -> String {
    let end = text.match_indices("[[run]]").nth(2).map_or(text.len(), |(at, _)| at);
    let lines = text[..end].lines().map(|line| {
        let duration = line.strip_prefix("duration_s = ").and_then(|s| s.parse::<f64>().ok());
        let robot = line.strip_prefix("robot = \"").and_then(|rest| rest.strip_suffix('"'));
        match (duration, robot) {
            (Some(seconds), _) if seconds > SHORT_S => format!("duration_s = {SHORT_S:?}\n"),
            (_, Some(robot)) => format!("robot = {:?}\n", without_pictures(robot.as_ref(), folder)),
            _ => format!("{line}\n"),
        }
    });
    lines.collect()
}

/// Puts a robot without shapes and remarks into a folder. Returns its name there. Descriptions of robots have readers
/// of their own.
fn without_pictures(robot: &Path, folder: &Path) -> String {
    let arm = robot.parent().unwrap();
    let name = arm.file_name().unwrap().to_string_lossy().into_owned();
    let mut urdf = std::fs::read_to_string(arm.join("robot.urdf")).unwrap();
    for (start, end) in
        [("<!--", "-->"), ("<visual>", "</visual>"), ("<collision>", "</collision>")]
    {
        while let Some(from) = urdf.find(start) {
            let to = from + urdf[from..].find(end).unwrap() + end.len();
            urdf.replace_range(from..to, "");
        }
    }
    let lines =
        urdf.lines().map(str::trim).filter(|line| !line.is_empty()).map(|l| format!("{l}\n"));
    std::fs::write(folder.join(format!("{name}.urdf")), lines.collect::<String>()).unwrap();
    let settings = std::fs::read_to_string(robot).unwrap();
    let settings = settings.replace("\"robot.urdf\"", &format!("\"{name}.urdf\""));
    std::fs::write(folder.join(format!("{name}.toml")), settings).unwrap();
    format!("{name}.toml")
}

fn short_scenarios(folder: &Path) -> Vec<Vec<u8>> {
    let of = |seed: Vec<u8>| shortened(&String::from_utf8(seed).unwrap(), folder).into_bytes();
    scenarios(folder).into_iter().map(of).collect()
}

/// The plant is short as well.
fn short_trackings(folder: &Path) -> Vec<Vec<u8>> {
    let tracking = TrackingScenario::from_document(&file("tracking/low_gains.toml")).unwrap();
    let plant = Scenario::from_document(&file("tracking/tracked_wam.toml")).unwrap();
    std::fs::write(folder.join("plant.toml"), shortened(plant.self_contained_text(), folder))
        .unwrap();
    let text = shortened(tracking.self_contained_text(), folder);
    let (_, rest) =
        text.split_once('\n').filter(|(first, _)| first.starts_with("plant = ")).unwrap();
    vec![format!("plant = \"plant.toml\"\n{rest}").into_bytes()]
}

fn trackings(_: &Path) -> Vec<Vec<u8>> {
    let tracking = TrackingScenario::from_document(&file("tracking/low_gains.toml")).unwrap();
    vec![tracking.self_contained_text().into()]
}

/// Their scenario is short as well.
fn short_campaigns(folder: &Path) -> Vec<Vec<u8>> {
    let found = campaigns(folder);
    let scenario = folder.join("scenario.toml");
    let text = std::fs::read_to_string(&scenario).unwrap();
    std::fs::write(&scenario, shortened(&text, folder)).unwrap();
    found
}

fn campaigns(folder: &Path) -> Vec<Vec<u8>> {
    let of = |name: &str| {
        let campaign = Campaign::from_document(&file(name)).unwrap();
        CampaignFolder::plan(folder, campaign).unwrap();
        std::fs::read(folder.join("campaign.toml")).unwrap()
    };
    vec![of("campaigns/panel.toml"), of("campaigns/trials.toml")]
}
