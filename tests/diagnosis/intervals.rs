//! Coverage of the 95 per cent intervals.

use catalogue::EffectKind;
use checks::synthetic::{Noise, State, wam};
use diagnosis::{Finding, Settings, Silent, diagnose};
use rayon::prelude::*;

use crate::world::{Torque, World, against_nominal, finding, sign};

const LOGS: u64 = 80;

/// Logs of the arm whose every joint is wrong.
const SEEDS: u64 = 6;

/// The causes in every log: words, parameter, true value.
const CAUSES: [(&str, &str, f64); 3] = [
    ("FR02 Coulomb friction at j4_elbow_pitch", "level", 0.5),
    ("FR01 viscous friction at j2_shoulder_pitch", "viscous", 1.5),
    ("DR03 torque offset at j3_shoulder_yaw", "offset", 0.3),
];

/// Of `n` intervals that hold the truth with probability 0.95, `0.95 n +- sqrt(0.0475 n)`
/// do: for `n` = 80, fewer than 88 % with probability 0.006, for the 240 of all three
/// parameters with 1e-5. Intervals that are 0.8 as wide as they should be hold it in 88 %.
const LEAST: f64 = 0.88;

/// Share of the logs in which the cause must be found for its interval to be judged.
const FOUND: f64 = 0.9;

#[test]
fn intervals_hold_the_truth_as_often_as_they_say() {
    let world = World::nominal()
        .torque(3, |[_, qd, _]| 0.5 * sign(qd))
        .torque(1, |[_, qd, _]| 1.5 * qd)
        .reading(2, |effort| effort + 0.3);
    let noise = Noise::of_a_wam();
    let answers: Vec<_> = (0..LOGS)
        .into_par_iter()
        .map(|seed| against_nominal(&world.runs(3, 12.0, &noise, 3000 + seed)).diagnosis)
        .collect();
    for (words, parameter, truth) in CAUSES {
        let estimates: Vec<_> = answers
            .iter()
            .filter_map(|a| finding(a, words))
            .filter_map(|f| f.parameters.iter().find(|p| p.name == parameter))
            .collect();
        let count = estimates.len() as f64;
        let inside =
            estimates.iter().filter(|e| (e.noise95[0]..=e.noise95[1]).contains(&truth)).count()
                as f64;
        let mean = estimates.iter().map(|e| e.value).sum::<f64>() / count;
        let half =
            estimates.iter().map(|e| 0.5 * (e.noise95[1] - e.noise95[0])).sum::<f64>() / count;
        let text = format!(
            "{words}: found in {count} of {LOGS}, truth {truth} inside {inside} times \
             ({:.0} %), mean {mean:.4}, mean half width {half:.4}",
            100.0 * inside / count
        );
        println!("{text}");
        assert!(count >= FOUND * LOGS as f64, "{text}");
        assert!(inside >= LEAST * count, "{text}");
    }
}

/// Joints described with a damping of 10 N m s/rad, for the stability of a simulator, and true ones with .5: the intervals of
/// what is found are those about the true arm. About the description, a torque constant that is off by a tenth would be
/// 1 N m s/rad of viscous friction.
#[test]
fn intervals_do_not_grow_with_the_error_that_a_finding_puts_right() {
    let viscous: Torque = |[_, qd, _]: State| 0.3 * sign(qd) + 0.5 * qd;
    let world = (0..7).fold(World::nominal(), |world, joint| world.torque(joint, viscous));
    let mut described = wam();
    for joint in 0..7 {
        described.link_mut(joint).unwrap().actuator.viscous = 10.0;
    }
    let answer = diagnose(&described, &world.log(61), &Settings::default(), &Silent).unwrap();
    let of_kind = |f: &&Finding| f.at.effect == EffectKind::ViscousFriction;
    let found: Vec<&Finding> = answer.diagnosis.findings.iter().filter(of_kind).collect();
    assert_eq!(found.len(), 7);
    for finding in found {
        let size = &finding.parameters[0];
        let [low, high] = size.ci95;
        println!("{}: {low:.4} to {high:.4}", finding.at.words());
        assert!(0.5 * (high - low) < 0.1, "{}: {size:?}", finding.at.words());
        assert!((low..=high).contains(&0.5), "{}: {size:?}", finding.at.words());
    }
}

/// Dry friction of every joint (N m).
const LEVELS: [f64; 7] = [1.2, 1.0, 0.8, 0.6, 0.2, 0.2, 0.05];

/// What is besides wrong with every joint and too small to be named: a share of that friction that goes with
/// position, and one that goes with speed.
const SMALL: [f64; 2] = [0.03, 0.02];

/// Torque of joint `J`: its friction, and what has no name.
fn rough<const J: usize>([q, qd, _]: State) -> f64 {
    LEVELS[J] * (sign(qd) + SMALL[0] * (3.0 * q + J as f64).sin() + SMALL[1] * qd)
}

/// Small errors are everywhere; those without a name lean on the sizes of what has one.
#[test]
fn intervals_hold_the_truth_where_small_errors_have_no_name() {
    let joints: [Torque; 7] =
        [rough::<0>, rough::<1>, rough::<2>, rough::<3>, rough::<4>, rough::<5>, rough::<6>];
    let world = joints.iter().enumerate().fold(World::nominal(), |w, (j, of)| w.torque(j, *of));
    let answers: Vec<_> = (0..SEEDS)
        .into_par_iter()
        .map(|seed| {
            against_nominal(&world.runs(3, 12.0, &Noise::of_a_wam(), 4000 + seed)).diagnosis
        })
        .collect();
    let (mut count, mut whole, mut of_noise) = (0, 0, 0);
    for answer in &answers {
        for (j, level) in LEVELS.iter().enumerate() {
            let words = format!("FR02 Coulomb friction at {}", answer.joints[j].name);
            let Some(found) = finding(answer, &words) else { continue };
            let e = &found.parameters[0];
            let holds = |[low, high]: [f64; 2]| usize::from((low..=high).contains(level));
            count += 1;
            whole += holds(e.ci95);
            of_noise += holds(e.noise95);
        }
    }
    let text = format!("{count} sizes: {whole} hold, {of_noise} of noise alone");
    println!("{text}");
    assert!(count >= 35, "{text}");
    assert!(whole as f64 >= LEAST * count as f64, "{text}");
    // The logs are such that noise alone is too little.
    assert!((of_noise as f64) < LEAST * count as f64, "{text}");
}
