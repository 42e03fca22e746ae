//! What plain least squares makes of logs of another engine and of the simulator, and how its error is measured.

use std::fs;
use std::path::Path;

use benchmark::least_squares;
use catalogue::EffectKind;
use checks::arms::{wam, workspace_root};
use checks::recorded::folder;
use checks::synthetic::{Noise, Truth, run};
use diagnosis::EffectAt;
use document::Document;
use experiment::robot_error;
use logs::{ReadOptions, Run, read_run};
use simulator::scenario::Scenario;

const CONTROL_RATE_HZ: Option<f64> = Some(500.0);

/// The logs of a case, and the effects and places that its truth states.
fn case(folder: &Path, name: &str) -> (Vec<Run>, Vec<EffectAt>) {
    let folder = folder.join("mujoco_wam").join(name);
    let options = ReadOptions::default();
    let path = |k: usize| folder.join(format!("run_{k}.parquet"));
    let runs = (0..4).map(|k| read_run(&path(k), &wam(), &options).unwrap()).collect();
    let text = fs::read_to_string(folder.join("truth.json")).unwrap();
    let truth: serde_json::Value = serde_json::from_str(&text).unwrap();
    let place = |cause: &serde_json::Value, key: &str| cause[key].as_str().map(str::to_owned);
    let cause = |cause: &serde_json::Value| {
        let effect = place(cause, "effect").or_else(|| place(cause, "case")).unwrap();
        let (joint, link) = (place(cause, "joint"), place(cause, "link"));
        EffectAt { effect: effect.parse().unwrap(), joint, link }
    };
    let causes = match truth["causes"].as_array() {
        Some(causes) => causes.iter().map(cause).collect(),
        None => vec![cause(&truth)],
    };
    (runs, causes)
}

/// Errors of joints that all move.
fn all(errors: Vec<Option<f64>>) -> Vec<f64> {
    errors.into_iter().map(Option::unwrap).collect()
}

fn words(names: &[EffectAt]) -> Vec<String> {
    names.iter().map(EffectAt::words).collect()
}

#[test]
fn recorded_a_model_fitted_anew_beats_the_nominal_one_where_much_is_wrong() {
    let Some(folder) = folder() else { return };
    let (runs, truth) = case(&folder, "many");
    let start = std::time::Instant::now();
    let fitted = least_squares(&wam(), CONTROL_RATE_HZ, &runs[..3]).unwrap();
    println!("least squares: {:?} in {:?}", words(&fitted.names), start.elapsed());
    let after = fitted.held_out_error(&wam(), CONTROL_RATE_HZ, &runs[3..]).map(all).unwrap();
    let before = robot_error(&wam(), CONTROL_RATE_HZ, &runs[3..]).map(all).unwrap();
    println!("{after:.3?} left of {before:.3?}");
    assert!(after.iter().zip(&before).all(|(after, before)| *after < 0.4 * before));
    let frictions = [EffectKind::CoulombFriction, EffectKind::ViscousFriction];
    let friction: Vec<_> = truth.iter().filter(|c| frictions.contains(&c.effect)).collect();
    let found = friction.iter().filter(|cause| fitted.names.contains(cause)).count();
    assert_eq!(found, friction.len(), "{:?}", words(&fitted.names));
}

/// Runs of the simulator's WAM with these effects.
fn simulated(effects: &str, runs: &[u64]) -> Vec<Run> {
    let mut document =
        Document::read(workspace_root().join("scenarios/demos/no_effects.toml")).unwrap();
    let motion = "terms=4, lowest_hz=0.1, highest_hz=0.7, duration_s=12.0";
    let run = |seed: &u64| {
        format!("{{ name='run_{seed}', motion={{ sinusoids={{ seed={seed}, {motion} }} }} }}")
    };
    let all: Vec<String> = runs.iter().map(run).collect();
    document.set(&format!("run=[{}]", all.join(", "))).unwrap();
    document.set("engine.step_ms=0.5").unwrap();
    document.set(&format!("effect=[{effects}]")).unwrap();
    let scenario = Scenario::from_document(&document).unwrap();
    simulator::simulate(&scenario, &|| {}).unwrap().runs
}

const FRICTION: &str = "{ coulomb_friction={ joint='j2_shoulder_pitch', level_nm=3.0 } }, \
    { viscous_friction={ joint='j4_elbow_pitch', viscous_nm_s_per_rad=0.8 } }";

#[test]
fn friction_in_the_simulator_is_named_and_predicted_and_nothing_in_a_clean_arm() {
    let expected =
        ["FR01 viscous friction at j4_elbow_pitch", "FR02 Coulomb friction at j2_shoulder_pitch"];
    let runs = simulated(FRICTION, &[11, 12, 13, 14]);
    let fitted = least_squares(&wam(), CONTROL_RATE_HZ, &runs[..3]).unwrap();
    let before = robot_error(&wam(), CONTROL_RATE_HZ, &runs[3..]).map(all).unwrap();
    let mut names = words(&fitted.names);
    names.sort();
    assert_eq!(names, expected);
    let after = fitted.held_out_error(&wam(), CONTROL_RATE_HZ, &runs[3..]).map(all).unwrap();
    println!("{after:.4?} left of {before:.4?}");
    assert!(after[1] < 0.2 * before[1] && after[3] < 0.2 * before[3], "{after:?}");
    let clean = simulated("", &[11, 12, 13]);
    let named = least_squares(&wam(), CONTROL_RATE_HZ, &clean).unwrap().names;
    assert_eq!(words(&named), Vec::<String>::new());
}

/// Both errors of an arm that is as described are noise in one band, at the same samples: of the effort, and of the
/// encoders through the inertia, of which a fit to noisy accelerations takes some. Another band would be a factor.
#[test]
fn errors_of_a_baseline_and_of_a_robot_are_of_one_band() {
    let clean = |seed: u64| {
        let truth = Truth { robot: &wam(), torque: &|_, _| 0.0, reading: &|_, effort| effort };
        run(&truth, &Noise::of_a_wam(), 20.0, seed)
    };
    let logs: Vec<Run> = (0..3).map(clean).collect();
    let fitted = least_squares(&wam(), None, &logs).unwrap();
    assert_eq!(words(&fitted.names), Vec::<String>::new());
    let test = [clean(7)];
    let by_hand = fitted.held_out_error(&wam(), None, &test).map(all).unwrap();
    let of_robot = robot_error(&wam(), None, &test).map(all).unwrap();
    println!("{by_hand:.5?} and {of_robot:.5?}");
    for (a, b) in by_hand.iter().zip(&of_robot) {
        assert!((a / b - 1.0).abs() < 0.25, "{by_hand:?} and {of_robot:?}");
    }
}

#[test]
fn logs_of_another_robot_are_refused() {
    let truth = Truth { robot: &wam(), torque: &|_, _| 0.0, reading: &|_, effort| effort };
    let mut log = run(&truth, &Noise::of_a_wam(), 5.0, 1);
    log.joints.pop();
    let error = least_squares(&wam(), None, std::slice::from_ref(&log)).unwrap_err().to_string();
    assert!(error.contains("j7_palm_yaw"), "{error}");
}
