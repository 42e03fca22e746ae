//! Effects of one run alone.

use logs::Run;
use simulator::simulate;

use crate::scenario::{document, scenario};

const PAYLOAD: &str = "payload = { link = 'palm', mass_kg = 0.5, com_m = [0.0, 0.01, 0.05] }";

/// A second run with the motion of the first.
const TWO: &str = "[[run]]\nname = 'two'\nlead_in_s = 0.0\n[run.motion.sinusoids]\n\
                   seed = 1\nterms = 3\nlowest_hz = 0.2\nhighest_hz = 1.0\nduration_s = 0.4\nfade_s = 0.2\n";

fn efforts(run: &Run) -> Vec<&[f64]> {
    run.joints.iter().map(|joint| joint.effort.as_slice()).collect()
}

#[test]
fn a_payload_of_one_run_acts_as_the_scenarios_does_and_leaves_the_other_run_alone() {
    let own = simulate(&scenario(&format!("{TWO}[[run.effect]]\n{PAYLOAD}")), &|| {}).unwrap();
    let without = simulate(&scenario(TWO), &|| {}).unwrap();
    let all = simulate(&scenario(&format!("{TWO}[[effect]]\n{PAYLOAD}")), &|| {}).unwrap();
    assert_eq!(efforts(&own.runs[0]), efforts(&without.runs[0]));
    assert_eq!(efforts(&own.runs[1]), efforts(&all.runs[1]));
    assert_ne!(efforts(&own.runs[1]), efforts(&without.runs[1]));
    assert!(own.truth.is_empty() && without.truth_of_runs.is_empty());
    assert_eq!(own.truth_of_runs["two"], all.truth);
}

#[test]
fn the_truth_and_the_resolved_scenario_say_in_which_run_an_effect_was() {
    let scenario = scenario(&format!("{TWO}[[run.effect]]\n{PAYLOAD}"));
    let folder = tempfile::tempdir().unwrap();
    let simulation = simulate(&scenario, &|| {}).unwrap();
    simulator::write(folder.path(), &scenario, &simulation, simulator::LogFormat::Csv).unwrap();
    let truth = std::fs::read_to_string(folder.path().join("truth.json")).unwrap();
    let truth: serde_json::Value = serde_json::from_str(&truth).unwrap();
    assert_eq!(truth["runs"]["two"][0]["effect"], "payload");
    assert_eq!(truth["effects"].as_array().unwrap().len(), 0);
    assert!(scenario.self_contained_text().contains("[[run.effect]]"));
}

#[test]
fn an_effect_of_a_run_that_the_arm_cannot_have_is_underlined() {
    let text = format!("{TWO}[[run.effect]]\n{}", PAYLOAD.replace("palm", "plam"));
    let error = simulator::scenario::Scenario::from_document(&document(&text)).unwrap_err();
    let words = error.to_string();
    assert!(words.contains("run.1.effect.0.payload.link"), "{words}");
}
