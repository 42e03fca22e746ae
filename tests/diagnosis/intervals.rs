//! Coverage of the 95 per cent intervals.

use checks::synthetic::Noise;
use rayon::prelude::*;

use crate::world::{World, against_nominal, finding, sign};

const LOGS: u64 = 80;

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
            estimates.iter().filter(|e| (e.ci95[0]..=e.ci95[1]).contains(&truth)).count() as f64;
        let mean = estimates.iter().map(|e| e.value).sum::<f64>() / count;
        let half = estimates.iter().map(|e| 0.5 * (e.ci95[1] - e.ci95[0])).sum::<f64>() / count;
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
