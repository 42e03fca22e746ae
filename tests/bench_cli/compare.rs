use std::path::Path;

use benchmark::{Judgement, Record};

use crate::arm;
use crate::campaign::{done, folder, trials};
use crate::program::run;

/// A clean trial in which nothing is named, or Coulomb friction is made up.
#[allow(clippy::fn_params_excessive_bools, reason = "a made-up trial is right or not")]
fn record(task: usize, right: bool, campaign: &str) -> Record {
    let finding = r#"{
        "effect": "coulomb_friction", "joint": "elbow", "share_explained": 0.5,
        "not_separable_from": [], "is_true": false, "sharpness": null, "body": null
    }"#;
    let judged = format!(
        r#"{{
            "seed": 0, "knowledge": "whole", "verdict": "consistent", "findings": [{}],
            "corner": {{
                "origin": "simulated", "arm": "arm", "motion": "sweep", "effort": "current", "joints": 2,
                "encoder_step": 0.0, "rate_hz": 100.0, "logs": 1, "length_s": 6.0, "repeats": false
            }},
            "causes": [], "strangers": [], "spoilings": [], "least_squares": [],
            "reasons": {{ "given": 0, "contradicting": [] }},
            "prediction": {{ "nominal": null, "extended": null, "least_squares": null }},
            "costs": {{
                "logs_s": 0.0, "diagnosis_s": 0.0, "least_squares_s": 0.0, "peak_memory_mb": null
            }}
        }}"#,
        if right { "" } else { finding }
    );
    let judged: Judgement = serde_json::from_str(&judged).unwrap();
    Record {
        task,
        hidden: Some("clean".parse().unwrap()),
        seed: 40 + task as u64,
        campaign: campaign.to_owned(),
        score: Ok(judged.into()),
    }
}

fn table(folder: &Path, name: &str, right: &[bool], campaign: &str) {
    let records: Vec<Record> =
        right.iter().enumerate().map(|(task, right)| record(task, *right, campaign)).collect();
    Record::write(&folder.join(name), &records).unwrap();
}

#[test]
fn two_tables_are_compared_and_the_trials_that_turned_are_listed() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    table(path, "a.parquet", &[false, false, false, true, true, true], "campaign");
    table(path, "b.parquet", &[true, true, true, false, true, true], "campaign");
    let text = done(path, &["compare", "a.parquet", "b.parquet"]);
    // 2 (1 + 4) / 2^4 of three wins and one loss among six.
    for expected in [
        "6 trials of campaign campaign in both\n",
        "+33.3 %",
        "0.625",
        "4 trials turned, the second being\n task 0, seed 40 (clean): better: right, false alarm\n",
        " task 3, seed 43 (clean): worse: right, false alarm\n",
    ] {
        assert!(text.contains(expected), "{expected} is missing in\n{text}");
    }
    assert!(text.lines().all(|line| line.chars().count() <= 100), "{text}");
    let json = done(path, &["compare", "a.parquet", "b.parquet", "--json"]);
    let json: serde_json::Value = serde_json::from_str(&json).unwrap();
    assert_eq!(
        (&json["shares"][0]["measure"], &json["shares"][0]["wins"]),
        (&"right".into(), &3.into())
    );
    let same = done(path, &["compare", "a.parquet", "a.parquet"]);
    assert!(same.ends_with("\nno trial turned\n"), "{same}");
}

#[test]
fn results_that_are_no_pair_are_refused_in_one_line() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    table(path, "a.parquet", &[true], "campaign");
    table(path, "other.parquet", &[true], "another campaign");
    table(path, "empty.parquet", &[], "campaign");
    for (second, expected) in [
        ("other.parquet", "other.parquet: its trials are of another campaign (another ), "),
        ("empty.parquet", "a.parquet and empty.parquet: they have no trial in common"),
        ("nowhere.parquet", "nowhere.parquet: "),
        (".", "no campaign was planned here"),
    ] {
        let answer = run(path, &["compare", "a.parquet", second]);
        assert_eq!((answer.code, answer.out.as_str()), (3, ""), "{}", answer.err);
        assert!(answer.err.contains(expected), "{}", answer.err);
        assert_eq!(answer.err.lines().count(), 1, "{}", answer.err);
    }
}

/// A folder is compared before and after it is merged, with a table too.
#[test]
fn folders_are_compared_with_their_tables() {
    let folder = folder();
    let path = folder.path();
    done(path, &["plan", "campaign.toml", "--out", "a", "--quiet"]);
    done(path, &["work", "a", "--part", "1/2", "--quiet"]);
    trials(path, &["merge", "a"]);
    let text = done(path, &["compare", "a", "a/trials.parquet"]);
    assert!(text.starts_with("3 trials of campaign "), "{text}");
    assert!(text.ends_with("\nno trial turned\n"), "{text}");
}

#[test]
fn a_population_is_planned_and_its_merged_page_says_what_is_left() {
    let folder = tempfile::tempdir().unwrap();
    let path = folder.path();
    arm::write(path, "panel.toml", "[population]\ntrials = 3\nseed = 5\n");
    let out = done(path, &["plan", "panel.toml", "--out", "p"]);
    assert!(out.starts_with("3 trials of a population\n"), "{out}");
    let answer = trials(path, &["merge", "p"]);
    assert_eq!((answer.code, answer.err.as_str()), (1, ""));
    assert!(answer.out.contains("3 of 3 trials are left to make"), "{}", answer.out);
    let json = std::fs::read(path.join("p/tally.json")).unwrap();
    let json: serde_json::Value = serde_json::from_slice(&json).unwrap();
    assert_eq!(json["schema"], "plumbline.panel/2");
    let page = std::fs::read_to_string(path.join("p/report.html")).unwrap();
    assert!(page.contains("No trial has a score"));
    assert_eq!(page.matches("<script").count(), 2, "the data, and what sorts and copies");

    for (text, expected) in [
        ("[population]\ntrials = 0\n", "a number from 1 to 1000000 was expected"),
        ("[population]\ntrials = 3\narm = []\n", "unknown key `arm`"),
        ("seeds = 2\n[population]\ntrials = 3\n", "unknown key `seeds`"),
    ] {
        arm::write(path, "wrong.toml", text);
        let answer = trials(path, &["plan", "wrong.toml", "--out", "w"]);
        assert_eq!((answer.code, answer.out.as_str()), (3, ""), "{}", answer.err);
        assert!(answer.err.contains(expected) && answer.err.contains('^'), "{}", answer.err);
        assert!(!path.join("w").exists());
    }
}
