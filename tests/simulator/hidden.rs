use std::collections::BTreeSet;
use std::ops::Range;

use catalogue::EffectKind;
use document::Document;
use simulator::scenario::Scenario;
use simulator::{Simulation, SimulatorError, Truth, simulate};

use crate::scenario::document;

/// Seven joints in sines, and effects to be drawn.
fn moving(hidden: &str) -> Document {
    let mut document = document("");
    document.set("run.0.motion.sinusoids.duration_s=1.5").unwrap();
    document.set("run.0.motion.sinusoids.fade_s=0.5").unwrap();
    document.set("run.0.lead_in_s=0.3").unwrap();
    if !hidden.is_empty() {
        document.set(&format!("hidden={{ {hidden} }}")).unwrap();
    }
    document
}

fn simulated(document: &Document) -> Result<Simulation, SimulatorError> {
    simulate(&Scenario::from_document(document).unwrap(), &|| {})
}

fn truth(hidden: &str) -> Vec<Truth> {
    simulated(&moving(hidden)).unwrap().truth
}

/// `rms(tau - tau_without) / rms(tau_without)` from the logs, at the effect's joint or over all.
fn share(with: &Simulation, without: &Simulation) -> f64 {
    let own = with.truth[0].joint.as_deref();
    let (mut added, mut torque) = (0.0, 0.0);
    let joints = with.runs[0].joints.iter().zip(&without.runs[0].joints);
    for (a, b) in joints.filter(|(a, _)| own.is_none_or(|name| name == a.name)) {
        for (a, b) in a.effort.iter().zip(&b.effort) {
            added += (a - b).powi(2);
            torque += b * b;
        }
    }
    f64::sqrt(added / torque)
}

/// Shares of torque of a kind drawn alone, for some seeds; what was said where none was found.
fn shares(kind: EffectKind, seeds: Range<u64>) -> Vec<Result<f64, String>> {
    let without = simulated(&moving("")).unwrap();
    let of = |seed: u64| {
        let hidden = format!("count = [1, 1], from = ['{kind}'], seed = {seed}");
        let with = simulated(&moving(&hidden)).map_err(|error| error.to_string())?;
        assert_eq!((with.truth.len(), with.truth[0].effect), (1, kind));
        Ok(share(&with, &without))
    };
    seeds.map(of).collect()
}

/// Kinds to draw, and seeds: a few, or all of them where half an hour is no matter. Friction that
/// warms up in minutes takes too little away in seconds to be drawn.
fn kinds() -> (Vec<EffectKind>, Range<u64>) {
    use EffectKind as K;
    if std::env::var_os("PLUMBLINE_EVERY_KIND").is_none() {
        return (vec![K::CoulombFriction, K::Payload, K::CableSpring, K::TorqueConstant], 1..2);
    }
    (K::ALL.into_iter().filter(|kind| *kind != K::FrictionTemperatureDrift).collect(), 1..4)
}

#[test]
fn a_hidden_effect_has_the_share_of_torque_that_was_asked_for() {
    let (kinds, seeds) = kinds();
    for kind in kinds {
        let shares = shares(kind, seeds.clone());
        println!("{kind:28} {shares:.3?}");
        for share in shares {
            let fits = share.as_ref().is_ok_and(|share| (0.03..=0.3).contains(share));
            assert!(fits, "{kind}: {share:?}");
        }
    }
}

const THREE: &str = "from = ['coulomb_friction', 'torque_offset', 'payload']";

#[test]
fn as_many_effects_are_drawn_as_asked_for_of_the_kinds_asked_for_and_no_two_at_one_place() {
    let mut counts = BTreeSet::new();
    for seed in 0..3 {
        let drawn = truth(&format!("count = [1, 3], {THREE}, seed = {seed}"));
        counts.insert(drawn.len());
        for (index, truth) in drawn.iter().enumerate() {
            assert!(THREE.contains(truth.effect.name()), "{truth:?}");
            let place = |t: &Truth| (t.effect, t.joint.clone(), t.link.clone());
            assert!(drawn[..index].iter().all(|other| place(other) != place(truth)));
        }
    }
    assert!(counts.iter().all(|count| (1..=3).contains(count)) && counts.len() > 1, "{counts:?}");
    assert_eq!(truth("count = [0, 0]"), []);
}

#[test]
fn a_draw_follows_from_its_seed_and_another_seed_draws_another() {
    let drawn = |seed: u64| truth(&format!("count = [1, 1], {THREE}, seed = {seed}"));
    assert_eq!(drawn(1), drawn(1));
    assert_ne!(drawn(1), drawn(2));
    // Without a seed of its own it is the scenario's.
    let of_scenario = |seed: u64| {
        let mut document = moving(&format!("count = [1, 1], {THREE}"));
        document.set(&format!("seed={seed}")).unwrap();
        simulated(&document).unwrap().truth
    };
    assert_eq!(of_scenario(1), of_scenario(1));
    assert_ne!(of_scenario(1), of_scenario(2));
}

#[test]
fn hidden_effects_come_on_top_of_the_stated_ones() {
    let mut document = moving(&format!("count = [1, 1], {THREE}, seed = 5"));
    let stated =
        "effect=[{ viscous_friction = { joint = 'j1_base_yaw', viscous_nm_s_per_rad = 1 } }]";
    document.set(stated).unwrap();
    let truth = simulated(&document).unwrap().truth;
    assert_eq!((truth.len(), truth[0].effect), (2, EffectKind::ViscousFriction));
}
