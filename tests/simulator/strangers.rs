//! What holds for every effect of no catalogue.

use std::collections::BTreeSet;

use catalogue::EffectKind;
use document::Document;
use logs::Run;
use robot::Robot;
use simulator::scenario::Scenario;
use simulator::strangers::{StrangerKind, StrangerSpec, StrangerTruth};
use simulator::{
    EffectSizer, LogFormat, Simulator, SimulatorError, Stepping, draw_hidden_effects, simulate,
    simulate_noise_free, write,
};

use crate::scenario::document;

/// One stranger of every kind, as it may stand on the WAM.
pub const STRANGERS: [&str; 12] = [
    "soft_wall = { joint = 'j4_elbow_pitch', wall_rad = 1.0, side = 'above', stiffness_nm_per_rad = 20.0, damping_nm_s_per_rad = 0.2 }",
    "magnet_well = { joint = 'j4_elbow_pitch', centre_rad = 1.0, width_rad = 0.1, peak_nm = 1.0 }",
    "speed_crosstalk = { joint = 'j4_elbow_pitch', other = 'j2_shoulder_pitch', coefficient_nm_s_per_rad = 0.5 }",
    "drive_dead_zone = { joint = 'j4_elbow_pitch', width_nm = 0.3 }",
    "torque_rate_limit = { joint = 'j4_elbow_pitch', rate_nm_per_s = 5.0, behind_nm = 0.5 }",
    "tilting_bearing = { joint = 'j4_elbow_pitch', coefficient = 0.05 }",
    "soft_mount = { stiffness_nm_per_rad = 500.0, frequency_hz = 6.0, damping_ratio = 0.1 }",
    "eccentric_encoder = { joint = 'j4_elbow_pitch', eccentricity_rad = 0.02, phase_rad = 1.0 }",
    "torque_dropout = { joint = 'j4_elbow_pitch', per_minute = 300.0, length_ms = 20.0, kept = 0.1, seed = 3 }",
    "integrator_windup = { joint = 'j4_elbow_pitch', time_constant_s = 0.5, limit_nm = 1.0 }",
    "square_drag = { joint = 'j4_elbow_pitch', coefficient_nm_s2_per_rad2 = 1.0 }",
    "snag = { joint = 'j4_elbow_pitch', centre_rad = 1.0, width_rad = 0.05, peak_nm = 2.0 }",
];

/// A simulator with perfect sensors and the strangers of a piece of TOML, such as
/// `snag = { joint = "joint", ... }`.
pub fn arm(robot: &Robot, toml: &str, stepping: Stepping) -> Simulator {
    #[derive(serde::Deserialize)]
    struct Strangers {
        stranger: Vec<StrangerSpec>,
    }
    let text =
        if toml.is_empty() { "stranger = []".into() } else { format!("[[stranger]]\n{toml}") };
    let strangers = toml::from_str::<Strangers>(&text).unwrap().stranger;
    let injected = strangers.iter().map(|s| s.inject(robot).unwrap()).collect();
    let sensors = simulator::Sensors::perfect(robot.joint_count());
    Simulator::new(robot, injected, sensors, stepping).unwrap()
}

fn with(stranger: &str) -> Document {
    document(&format!("[[stranger]]\n{stranger}"))
}

#[test]
fn there_is_a_stranger_of_every_kind_and_its_truth_and_scenario_hold_it() {
    assert!(StrangerKind::ALL.len() >= 12 && StrangerKind::ALL.len() == STRANGERS.len());
    for (kind, text) in StrangerKind::ALL.iter().zip(STRANGERS) {
        let scenario = Scenario::from_document(&with(text)).unwrap();
        let stranger = &scenario.strangers()[0];
        assert_eq!((stranger.kind(), scenario.strangers().len()), (*kind, 1));
        assert!(text.starts_with(kind.name()), "{kind}");
        assert!(kind.fits(scenario.robot(), 3));
        // Whoever reads the resolved text has the same arm.
        let again = Document::from_text("resolved", scenario.self_contained_text()).unwrap();
        assert_eq!(Scenario::from_document(&again).unwrap().strangers(), scenario.strangers());
        assert_eq!(draw_hidden_effects(&scenario).unwrap().strangers(), scenario.strangers());
        let truth = stranger.truth();
        let joint = (*kind != StrangerKind::SoftMount).then(|| "j4_elbow_pitch".to_owned());
        assert_eq!((truth.stranger, &truth.joint, &truth.link), (*kind, &joint, &None));
        assert!(!truth.parameters.is_empty());
        let json = serde_json::to_string(&truth).unwrap();
        assert!(json.contains(&format!("\"{kind}\"")), "{json}");
        assert_eq!(serde_json::from_str::<StrangerTruth>(&json).unwrap(), truth);
    }
}

#[test]
fn no_catalogue_knows_a_stranger() {
    let known = EffectKind::ALL.map(|kind| [kind.name(), kind.code()]).concat();
    let words = EffectKind::ALL.map(EffectKind::words);
    let names: BTreeSet<&str> = StrangerKind::ALL.iter().map(|kind| kind.name()).collect();
    assert_eq!(names.len(), StrangerKind::ALL.len());
    for name in names {
        assert!(!known.contains(&name) && !words.contains(&name.replace('_', " ").as_str()));
        assert!(name.parse::<EffectKind>().is_err(), "{name}");
    }
}

/// Whatever stands in a stranger: the mistake is underlined there, with its path.
#[test]
fn every_number_of_every_stranger_has_a_range_and_every_joint_must_exist() {
    for stranger in STRANGERS {
        let table: toml::Table = stranger.parse().unwrap();
        let (name, toml::Value::Table(keys)) = table.iter().next().unwrap() else { unreachable!() };
        for (key, value) in keys {
            let wrong: &[&str] = match value {
                toml::Value::Float(_) => &["nan", "inf", "1e12", "-1e12", "'x'"],
                toml::Value::Integer(_) => &["-1", "1.5"],
                _ => &["'nowhere'", "3"],
            };
            for wrong in wrong {
                let mut document = with(stranger);
                document.set(&format!("stranger.0.{name}.{key}={wrong}")).unwrap();
                let error = Scenario::from_document(&document).map(|_| ()).unwrap_err();
                let SimulatorError::Scenario(mistake) = &error else { unreachable!("{error}") };
                assert_eq!(mistake.place().unwrap().text(), *wrong, "{name}.{key}: {mistake}");
                assert!(error.to_string().contains(&format!("stranger.0.{name}.{key}: ")));
            }
        }
    }
    let itself = STRANGERS[2].replace("j2_shoulder_pitch", "j4_elbow_pitch");
    let error = Scenario::from_document(&with(&itself)).map(|_| ()).unwrap_err();
    assert!(error.to_string().contains("another joint was expected"), "{error}");
}

/// Seven joints in sines for 4 s.
fn moving() -> Scenario {
    let mut document = document("");
    document.set("sensors.effort='commanded'").unwrap();
    document.set("run.0.motion.sinusoids.duration_s=4.0").unwrap();
    document.set("run.0.motion.sinusoids.fade_s=0.5").unwrap();
    Scenario::from_document(&document).unwrap()
}

fn silent(scenario: &Scenario, strangers: &[StrangerSpec]) -> Run {
    simulate_noise_free(scenario, &|_| true, &[], strangers).unwrap().remove(0)
}

/// Share of torque that a stranger adds to what is asked for: at its joint, or over all.
fn share(with: &Run, without: &Run, joint: Option<&str>) -> f64 {
    let (mut added, mut torque) = (0.0, 0.0);
    for (a, b) in with.joints.iter().zip(&without.joints) {
        if joint.is_none_or(|name| *name == a.name) {
            for (a, b) in a.effort.iter().zip(&b.effort) {
                added += (a - b).powi(2);
                torque += b * b;
            }
        }
    }
    f64::sqrt(added / torque)
}

#[test]
fn a_drawn_stranger_has_about_the_share_of_torque_that_was_asked_for() {
    let scenario = moving();
    let bench = EffectSizer::new(&scenario).unwrap();
    let without = silent(&scenario, &[]);
    let goal = 0.15;
    let mut off = Vec::new();
    for kind in StrangerKind::ALL {
        for (joint, seed) in [(1, 1), (3, 2)] {
            let stranger = bench.stranger(*kind, joint, goal, seed);
            assert_eq!(stranger, bench.stranger(*kind, joint, goal, seed));
            let with = silent(&scenario, std::slice::from_ref(&stranger));
            let found = share(&with, &without, stranger.truth().joint.as_deref()) / goal;
            println!("{:18} joint {} {found:.2}  {stranger:?}", kind.name(), joint + 1);
            if !(1.0 / 3.0..=3.0).contains(&found) {
                off.push((*kind, joint, found));
            }
        }
    }
    assert!(off.is_empty(), "{off:.2?}");
}

/// From next to nothing to more than all of the torque, where a joint rests too.
#[test]
fn whatever_stranger_is_drawn_can_be_put_in() {
    let resting = "[[run]]\nname = 'two'\nmotion.hold.duration_s = 0.3";
    let mut document = document(resting);
    document.set("run.0.motion={ hold = { duration_s = 0.2 } }").unwrap();
    for scenario in [moving(), Scenario::from_document(&document).unwrap()] {
        let bench = EffectSizer::new(&scenario).unwrap();
        for (kind, joint) in StrangerKind::ALL.iter().flat_map(|k| (0..7).map(move |j| (*k, j))) {
            for share in [1e-3, 0.2, 3.0] {
                let stranger = bench.stranger(kind, joint, share, 5);
                assert_eq!(stranger.kind(), kind);
                let refused = stranger.inject(scenario.robot()).err();
                assert_eq!(refused, None, "{stranger:?}, share {share}");
            }
        }
    }
}

/// `truth.json` has the key where there is one, and logs are those of the arm with it.
#[test]
fn strangers_stand_in_the_truth_and_in_nothing_else() {
    for (index, text) in STRANGERS.iter().enumerate() {
        let scenario = Scenario::from_document(&with(text)).unwrap();
        let simulation = simulate(&scenario, &|| {}).unwrap();
        assert_eq!(simulation.strangers, [scenario.strangers()[0].truth()]);
        assert_eq!(simulation.truth, []);
        let silent =
            simulate_noise_free(&scenario, &|name| name == "one", &[], scenario.strangers());
        // The sensors of the scenario are perfect.
        assert_eq!(silent.unwrap(), simulation.runs);
        let folder = tempfile::tempdir().unwrap();
        write(folder.path(), &scenario, &simulation, LogFormat::Csv).unwrap();
        let read = |name: &str| std::fs::read_to_string(folder.path().join(name)).unwrap();
        let blinded = experiment::Blinded::open(folder.path()).unwrap();
        assert_eq!((blinded.strangers, blinded.effects), (simulation.strangers, vec![]));
        let name = StrangerKind::ALL[index].name();
        assert!(read("truth.json").contains(name) && !read("one.csv").contains(name));
    }
    let plain = Scenario::from_document(&document("")).unwrap();
    let simulation = simulate(&plain, &|| {}).unwrap();
    let folder = tempfile::tempdir().unwrap();
    write(folder.path(), &plain, &simulation, LogFormat::Csv).unwrap();
    let truth = std::fs::read_to_string(folder.path().join("truth.json")).unwrap();
    assert!(!truth.contains("stranger"), "{truth}");
}

/// Exactly the effects and strangers that are given, whatever the scenario states and its sensors
/// do.
#[test]
fn silent_runs_have_what_is_given_and_no_error() {
    let mut noisy = with(STRANGERS[10]);
    for setting in [
        "effect=[{ viscous_friction = { joint = 'j1_base_yaw', viscous_nm_s_per_rad = 1 } }]",
        "sensors.effort_noise_nm={ j4_elbow_pitch = 0.3 }",
        "sensors.effort_resolution_nm={ j4_elbow_pitch = 0.5 }",
        "sensors.position_noise_rad={ j4_elbow_pitch = 1e-4 }",
        "sensors.link_position_resolution_rad={ j4_elbow_pitch = 1e-3 }",
        "sensors.link_position_lag_ms=5.0",
        "sensors.velocity_logged='no'",
        "sensors.dropouts={ per_minute = 60.0, length_ms = 100.0 }",
        "sensors.time_jitter_ms=0.2",
        "sensors.dropped_share=0.2",
        "sensors.log_rate_hz=250.0",
    ] {
        noisy.set(setting).unwrap();
    }
    let noisy = Scenario::from_document(&noisy).unwrap();
    let mut plain = document("");
    plain.set("sensors.log_rate_hz=250.0").unwrap();
    plain.set("sensors.link_position_resolution_rad={ j4_elbow_pitch = 0.0 }").unwrap();
    let plain = Scenario::from_document(&plain).unwrap();
    let silent = simulate_noise_free(&noisy, &|_| true, &[], &[]).unwrap();
    assert_eq!(silent, simulate(&plain, &|| {}).unwrap().runs);
    let own = simulate_noise_free(&noisy, &|_| true, noisy.effects(), noisy.strangers()).unwrap();
    assert_ne!(silent, own);
    assert!(simulate_noise_free(&noisy, &|_| false, &[], &[]).unwrap().is_empty());
}
