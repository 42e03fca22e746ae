//! What a population may ask for.

use document::{Coloring, Document, KeyPath};
use population::{Origin, PopulationSpec};
use serde::Deserialize;

#[derive(Deserialize)]
struct File {
    population: PopulationSpec,
}

fn read(text: &str) -> Result<PopulationSpec, String> {
    let document = Document::from_text("panel.toml", text).unwrap();
    let file: File = document.parse().map_err(|e| e.render(Coloring::Plain))?;
    PopulationSpec::from_document(&document, &KeyPath::root().key("population"), file.population)
        .map_err(|e| e.render(Coloring::Plain))
}

#[test]
fn what_no_workshop_has_is_underlined() {
    let mistakes = [
        ("trials = 0", "population.trials", "0, a number from 1 to 1000000 was expected"),
        ("logs = [0, 9]", "population.logs", "[0, 9], the least and the largest from 1 to 8"),
        ("logs = [3, 2]", "population.logs", "[3, 2]"),
        ("log_s = [1.0, 60.0]", "population.log_s", "from 5 to 60 were expected"),
        ("longest_s = 900.0", "population.longest_s", "900, a number from 5 to 480"),
        (
            "logs = [8, 8]\nlongest_s = 20.0",
            "population.longest_s",
            "at least 40 s for 8 logs of 5 s",
        ),
        ("causes = [0, 7]", "population.causes", "from 0 to 6 were expected"),
        ("strangers = 1.5", "population.strangers", "1.5, a number from 0 to 1"),
        ("clean = -0.1", "population.clean", "-0.1, a number from 0 to 1"),
        ("spoilt = 2.0", "population.spoilt", "2, a number from 0 to 1"),
        ("log_kinds.no_noise = { share = 1.5 }", "log_kinds.no_noise.share", "1.5, a number"),
        (
            "log_kinds.low_rate = { share = 0.5, size = 500.0 }",
            "log_kinds.low_rate.size",
            "500, a number from 5 to 100",
        ),
        (
            "log_kinds.no_noise = { share = 0.5, size = 0.1 }",
            "log_kinds.no_noise.size",
            "no size was expected",
        ),
        ("log_kinds.noisy = { share = 0.5 }", "population.log_kinds", "noisy"),
        ("servos = { share = 0.5, delay_ms = [9.0, 3.0] }", "servos.delay_ms", "[9, 3]"),
        ("arms = [\"wam\"]\nservos = { share = 0.5 }", "servos.share", "hobby among the arms"),
        ("arms = []", "population.arms", "at least one kind was expected"),
        ("motions = []", "population.motions", "at least one kind was expected"),
        ("arms = [\"wham\"]", "population.arms", "wham"),
        ("robot = 3", "population.robot", "robot"),
        (
            "robots = { wrong_urdfs = 1.5 }",
            "population.robots.wrong_urdfs",
            "1.5, a number from 0 to 1 was expected",
        ),
        ("robots = { worn_out = 0.1 }", "population.robots.worn_out", "worn_out"),
        ("instruments.rates_hz = [0.5]", "instruments.rates_hz", "0.5, rates from 1 to 10000"),
        ("instruments.encoder_bits = [12, 30]", "instruments.encoder_bits", "30, whole numbers"),
        ("instruments.effort_kinds = [\"volt\"]", "instruments.effort_kinds", "volt"),
    ];
    for (line, key, words) in mistakes {
        let trials = if line.starts_with("trials") { "" } else { "trials = 3\n" };
        let error = read(&format!("[population]\n{trials}{line}\n")).unwrap_err();
        assert!(error.contains(key) && error.contains(words) && error.contains('^'), "{error}");
    }
}

#[test]
fn recorded_trials_follow_the_simulated_ones_where_their_logs_are() {
    let folder = tempfile::tempdir().unwrap();
    let recorded = |data: &std::path::Path| {
        let text = format!("trials = 4\nrecorded = {{ data = {data:?}, trials = 3 }}");
        read(&format!("[population]\n{text}\n")).unwrap()
    };
    let spec = recorded(folder.path());
    let origins: Vec<Origin> = (0..spec.tasks()).map(|task| spec.origin(task)).collect();
    use Origin::{Recorded, Simulated, Transplant};
    let all = [Simulated, Simulated, Simulated, Simulated, Recorded, Transplant, Transplant];
    assert_eq!(origins, all);
    let absent = recorded(&folder.path().join("absent"));
    assert_eq!((absent.tasks(), absent.recorded.clone()), (4, None));

    // The same wherever the logs lie, another with another population.
    let elsewhere = tempfile::tempdir().unwrap();
    assert_eq!(spec.identity(), recorded(elsewhere.path()).identity());
    assert_ne!(spec.identity(), absent.identity());
    let larger = PopulationSpec { trials: 5, ..spec.clone() };
    assert_ne!(spec.identity(), larger.identity());
}

/// A population without what robots in use have is stored and told as it was before there was any.
#[test]
fn shares_of_zero_leave_no_word() {
    let plain = read("[population]\ntrials = 3\n").unwrap();
    let zero = read("[population]\ntrials = 3\nrobots = { turned_axes = 0.0 }\n").unwrap();
    assert_eq!(plain.identity(), zero.identity());
    assert!(!plain.identity().contains("robots"));
    let some = read("[population]\ntrials = 3\nrobots = { turned_axes = 0.1 }\n").unwrap();
    assert_ne!(plain.identity(), some.identity());
}
