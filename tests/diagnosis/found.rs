//! Every effect that has a model in a log whose cause is known: named, at its place, with
//! its size, and nothing else named.
//!
//! Whatever the name, the extended robot must predict a motion that is in no log.
//!
//! The bodies move as the project's own inverse dynamics says, so this shows that the
//! causes are told apart, not that the rigid-body model is right.

use catalogue::EffectKind;
use diagnosis::{Diagnosis, DiagnosisRun, Estimate, Finding, Verdict};
use effects::MODELLED;
use rayon::prelude::*;

use crate::trials::{Name, Trial, trials};
use crate::world::{World, against_nominal, finding, left_on_a_new_motion, named};

const SEEDS: std::ops::Range<u64> = 1000..1003;

/// Findings over all seeds of one trial that are neither the cause nor a rival of it.
const STRAYS: usize = 1;

/// An interval is widened by this much: three seeds are no test of coverage, which is
/// measured in `intervals.rs`.
const WIDENED: f64 = 1.5;

/// Relative error of a size that is small enough whatever the interval says.
const CLOSE: f64 = 0.05;

/// Largest share of the gap, RMS over RMS, left by the extended robot on a new motion.
const LEFT: f64 = 0.1;

/// What one log said of a trial's cause.
struct Seen {
    exact: bool,
    rival: bool,
    strays: Vec<String>,
    wrong: Vec<String>,
    text: String,
}

fn seen(trial: &Trial, world: &World, seed: u64) -> Seen {
    let DiagnosisRun { diagnosis, extended, .. } = against_nominal(&world.log(seed));
    let words = trial.words();
    let found = finding(&diagnosis, &words);
    let names = |f: &&Finding| f.not_separable_from.iter().any(|r| r.words() == words);
    let disguised = diagnosis.findings.iter().find(names);
    let cause = found.or(disguised);
    let others = diagnosis.findings.iter().filter(|f| cause.is_none_or(|c| c.at != f.at));
    let strays = others.map(|f| f.at.words()).filter(|w| trial.beside != Some(w)).collect();
    let mut wrong = wrong_sizes(trial, found);
    let left = left_on_a_new_motion(world, &extended, seed + 500);
    for &j in trial.joints {
        if left[j] > LEFT {
            wrong.push(format!("{:.0} % left at joint {}", 100.0 * left[j], j + 1));
        }
    }
    for (j, joint) in diagnosis.joints.iter().enumerate() {
        let named = matches!(joint.verdict, Verdict::Explained | Verdict::PartlyExplained);
        let left_alone = joint.verdict != Verdict::Unexplained;
        if !(left_alone && (named || !trial.joints.contains(&j))) {
            wrong.push(format!("{} is {}: {}", joint.name, joint.verdict.words(), joint.because));
        }
    }
    let sizes = cause.map(|f| f.parameters.iter().map(text_of).collect::<Vec<_>>().join(", "));
    let text = format!("{:?} {}", named(&diagnosis), sizes.unwrap_or_default());
    Seen {
        exact: found.is_some(),
        rival: found.is_none() && disguised.is_some(),
        strays,
        wrong,
        text,
    }
}

/// The parameters that claim to be determined and are not where the truth is.
fn wrong_sizes(trial: &Trial, found: Option<&Finding>) -> Vec<String> {
    let Some(found) = found else { return Vec::new() };
    let wrong = |&(name, truth): &(&str, f64)| {
        let estimate = found.parameters.iter().find(|p| p.name == name).unwrap();
        let right = !estimate.determined || holds(estimate, truth);
        (!right).then(|| format!("{name} is {truth:.4}: {}", text_of(estimate)))
    };
    trial.sizes.iter().filter_map(wrong).collect()
}

/// Whether the truth is near an estimate.
fn holds(estimate: &Estimate, truth: f64) -> bool {
    let off = (estimate.value - truth).abs();
    let half = 0.5 * (estimate.noise95[1] - estimate.noise95[0]);
    off <= WIDENED * half || off <= CLOSE * truth.abs()
}

fn text_of(e: &Estimate) -> String {
    let open = if e.determined { "" } else { " (open)" };
    format!("{} {:.4} [{:.4}, {:.4}]{open}", e.name, e.value, e.noise95[0], e.noise95[1])
}

#[test]
fn every_effect_that_has_a_model_is_hidden_in_the_simulated_arm() {
    for kind in MODELLED {
        // A counterbalance is looked for where a robot has one, warming up takes minutes, and late goals are those of
        // servos: `counterbalance`, `warming`, `late_goals`.
        let apart = matches!(
            kind,
            EffectKind::Counterbalance
                | EffectKind::FrictionTemperatureDrift
                | EffectKind::GoalDelay
        );
        assert!(apart || crate::hidden::HIDDEN.contains(&kind), "{kind}");
        assert!(trials(kind).iter().all(|t| t.kind == kind), "{kind}");
    }
}

#[test]
fn every_effect_is_named_at_its_place_with_its_size_and_nothing_else_is() {
    let trials: Vec<Trial> = MODELLED.into_iter().flat_map(trials).collect();
    let failures: Vec<String> = trials.par_iter().filter_map(failure).collect();
    assert!(failures.is_empty(), "\n{}", failures.join("\n"));
}

/// Runs a trial at every seed, prints what was seen, and says what was wrong with it.
fn failure(trial: &Trial) -> Option<String> {
    let world = (trial.world)(World::nominal());
    let all: Vec<Seen> = SEEDS.into_par_iter().map(|s| seen(trial, &world, s)).collect();
    let count = |of: fn(&Seen) -> bool| all.iter().filter(|s| of(s)).count();
    let (exact, rival) = (count(|s| s.exact), count(|s| s.rival));
    let strays: usize = all.iter().map(|s| s.strays.len()).sum();
    let wrong: usize = all.iter().map(|s| s.wrong.len()).sum();
    let mut text = format!(
        "{}: exact {exact}, as a rival {rival}, of {}; strays {strays}\n",
        trial.words(),
        all.len()
    );
    for seen in &all {
        text += &format!("    {} wrong {:?}\n", seen.text, seen.wrong);
    }
    println!("{}", text.trim_end());
    let enough = match trial.name {
        Name::Exact => exact == all.len(),
        Name::OrRival => exact + rival == all.len(),
    };
    (!enough || strays > STRAYS || wrong > 0).then_some(text)
}

/// Negative control of all trials: the same logs without the effect.
#[test]
fn no_effect_is_named_at_a_trials_place_where_it_is_absent() {
    let world = World::nominal();
    let controls: Vec<Diagnosis> =
        SEEDS.into_par_iter().map(|s| against_nominal(&world.log(s)).diagnosis).collect();
    for trial in MODELLED.into_iter().flat_map(trials) {
        for control in &controls {
            assert!(finding(control, &trial.words()).is_none(), "{:?}", named(control));
        }
    }
}
