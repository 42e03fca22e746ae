use std::fs;
use std::path::Path;

use serde_json::Value;

use crate::program::{Answer, run};

const PAPER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../scenarios/paper");

fn made(folder: &Path, scenario: &str, arguments: &[&str]) -> Answer {
    let scenario = format!("{PAPER}/{scenario}");
    let answer = run(folder, &[&["figure", &scenario], arguments].concat());
    assert_eq!(answer.code, 0, "{}{}", answer.out, answer.err);
    answer
}

fn metrics(out: &Path) -> Value {
    serde_json::from_str(&fs::read_to_string(out.join("metrics.json")).unwrap()).unwrap()
}

/// The stages that were made, those that were there before left out.
fn stages(answer: &Answer) -> Vec<&str> {
    let lines = answer.err.lines().filter(|line| !line.ends_with("made before"));
    lines.filter_map(|line| line.split_whitespace().next()).collect()
}

/// Figure 2 in seconds: few points of short runs in coarse steps.
fn small() -> Vec<String> {
    let runs: Vec<String> = [8, 6, 10]
        .iter()
        .enumerate()
        .map(|(i, s)| format!("\"run.{i}.motion.sinusoids.duration_s={s}\""))
        .collect();
    let of = |data: &str, more: &str| {
        format!(
            "figure.learning.{data}.settings=[\"engine.step_ms=0.25\", {}{more}]",
            runs.join(", ")
        )
    };
    let exact = ", \"effect=[]\", \"sensors={ position = 'motor', effort = 'commanded' }\"";
    let settings = [
        of("simulated", exact),
        of("real", ""),
        "figure.learning.outside.sinusoids.duration_s=20".to_owned(),
        "figure.learning.learn.points=150".to_owned(),
        "figure.learning.test_points=400".to_owned(),
    ];
    settings.into_iter().flat_map(|setting| ["--set".to_owned(), setting]).collect()
}

fn claims(metrics: &Value) -> Vec<&str> {
    let claims = metrics["claims"].as_array().unwrap();
    claims.iter().map(|claim| claim["verdict"].as_str().unwrap()).collect()
}

#[test]
fn figure_2_is_drawn_judged_and_the_same_for_the_same_seed() {
    let folder = tempfile::tempdir().unwrap();
    let settings = small();
    let settings: Vec<&str> = settings.iter().map(String::as_str).collect();
    let answer = made(folder.path(), "fig2_learning.toml", &settings);
    let parts = ["logs", "diagnosis", "models", "errors"];
    let expected: Vec<String> = ["simulated", "real"]
        .iter()
        .flat_map(|data| parts.map(|part| format!("{data}_{part}")))
        .collect();
    assert_eq!(stages(&answer), expected);
    for said in
        ["of the claims hold on this arm", "best gp / named", "holds: ", "figure2c_real.svg"]
    {
        assert!(answer.out.contains(said), "{said} is missing in {}", answer.out);
    }

    let out = folder.path().join("out/fig2_learning");
    let value = metrics(&out);
    assert_eq!(
        (&value["schema"], &value["points"]),
        (&"plumbline.figure_learning/1".into(), &150.into())
    );
    let error = |data: &str, model: &str, joint: usize| {
        let models = value[data].as_array().unwrap();
        let of = models.iter().find(|errors| errors["model"] == model).unwrap();
        of["nmse"][joint].as_f64().unwrap()
    };
    // The elbow: rigid bodies say what the arm without effects does, and not what the other does.
    assert!(error("simulated", "rbd", 3) < 0.01 && error("real", "rbd", 3) > 0.05, "{value}");
    assert!(error("real", "named", 3) < 0.2 * error("real", "rbd", 3), "{value}");
    assert!(error("outside", "named", 0) < 0.5 * error("outside", "gp", 0), "{value}");
    assert_eq!(claims(&value).len(), 5);
    let first = &value["claims"][0]["cases"][3];
    assert_eq!(first["value"], value["simulated"][0]["nmse"][3]);

    let page = fs::read_to_string(out.join("report.html")).unwrap();
    assert_eq!(page.matches("<svg").count(), 3);
    for file in ["figure2b_simulated.svg", "outside.svg", "logs/real/outside.parquet"] {
        assert!(out.join(file).is_file(), "{file} is missing");
    }
    assert!(!out.join("logs/real/tracking.parquet").exists(), "a run that nothing needs");

    // From the scenario that the run leaves, and again into the same folder.
    let scenario = out.join("scenario.toml").display().to_string();
    let again = run(folder.path(), &["figure", &scenario, "--out", "again", "--json", "--quiet"]);
    assert_eq!(again.code, 0, "{}", again.err);
    assert_eq!(again.out, fs::read_to_string(out.join("metrics.json")).unwrap());
    let kept = made(folder.path(), "fig2_learning.toml", &settings);
    assert!(stages(&kept).is_empty(), "{}", kept.err);
    let fewer = [&settings[..], &["--set", "figure.learning.test_points=100"]].concat();
    let fewer = made(folder.path(), "fig2_learning.toml", &fewer);
    assert_eq!(stages(&fewer), ["simulated_errors", "real_errors"]);
}

#[test]
fn figure_1_is_drawn_and_judged_and_its_times_are_kept() {
    let folder = tempfile::tempdir().unwrap();
    let few = ["--set", "figure.prediction_time.points=[300, 1000]"];
    let answer = made(folder.path(), "fig1_prediction_time.toml", &few);
    assert_eq!(stages(&answer), ["times"]);
    assert!(answer.out.contains("of the claims hold on this arm"), "{}", answer.out);
    let out = folder.path().join("out/fig1_prediction_time");
    let value = metrics(&out);
    let names: Vec<&str> =
        value["curves"].as_array().unwrap().iter().map(|c| c["name"].as_str().unwrap()).collect();
    assert_eq!(names, ["rbd", "gp", "gp-rbd", "rbd-kernel", "rbd-kernel as in eq. 10"]);
    let time = |curve: usize| value["curves"][curve]["points"][1]["microseconds"].as_f64().unwrap();
    assert!(time(0) < time(1) && time(1) < time(4), "{value}");
    // Of that many points rigid bodies are the fastest and the kernel of equation 10 the slowest on
    // any machine. Of 100 a Gaussian process has taken .61 us where rigid bodies took .68.
    assert_eq!((claims(&value)[0], claims(&value)[2]), ("holds", "holds"));
    assert!(fs::read_to_string(out.join("figure1.svg")).unwrap().contains("training points"));
    let kept = made(folder.path(), "fig1_prediction_time.toml", &few);
    assert!(stages(&kept).is_empty() && metrics(&out)["curves"] == value["curves"]);
    let other = [&few[..], &["--seed", "2", "--json", "--quiet"]].concat();
    let other = made(folder.path(), "fig1_prediction_time.toml", &other);
    assert_eq!(serde_json::from_str::<Value>(&other.out).unwrap()["provenance"]["seed"], 2);
}

#[test]
fn a_mistake_in_a_figure_is_shown_where_it_stands() {
    let folder = tempfile::tempdir().unwrap();
    for (scenario, setting, expected) in [
        ("fig2_learning.toml", "figure={ learnin = {} }", "did you mean `learning`?"),
        ("fig2_learning.toml", "figure.learning.tests=[]", "did you mean `test`?"),
        ("fig2_learning.toml", "figure.learning.test=[]", "no run, one at least was expected"),
        (
            "fig2_learning.toml",
            "figure.learning.test=[\"training\"]",
            "that nothing is learned from",
        ),
        (
            "fig2_learning.toml",
            "figure.learning.test=[\"tset\"]",
            "unknown run of the plant `tset`",
        ),
        (
            "fig2_learning.toml",
            "figure.learning.real.plant=x.toml",
            "x.toml: there is no such file",
        ),
        (
            "fig2_learning.toml",
            "figure.learning.real.settings=[\"efect=1\"]",
            "unknown key `efect`",
        ),
        ("fig2_learning.toml", "figure.learning.outside.sinusoids.terms=0", "terms"),
        ("fig2_learning.toml", "figure.learning.learn.points=0", "0, at least one was expected"),
        ("fig1_prediction_time.toml", "figure.prediction_time.points=[3, 2]", "rising numbers"),
        (
            "fig1_prediction_time.toml",
            "figure.prediction_time.robot=x.toml",
            "the robot cannot be used",
        ),
    ] {
        let scenario = format!("{PAPER}/{scenario}");
        let answer = run(folder.path(), &["figure", &scenario, "--set", setting]);
        assert_eq!(answer.code, 3, "{setting}: {}", answer.err);
        assert!(answer.err.contains(expected), "{setting}: {}", answer.err);
        assert!(!folder.path().join("out").exists(), "{setting} left something");
    }
}
